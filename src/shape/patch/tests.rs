//! The parts of the search by themselves, and how much work it ever is.

extern crate std;

use std::vec::Vec;
use std::{print, println};

use super::net::{Extent, Net, Pair, Way, cross};
use super::search::{PIECES_MAX, Root, Search};
use crate::fixed_point::Q16;
use crate::scalar::{Number, Real, Scalar};

/// Marsaglia's xorshift (2003).
struct Random(u64);

impl Random {
    fn within(&mut self, low: f64, high: f64) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        low + (high - low) * ((self.0 >> 11) as f64 / (1_u64 << 53) as f64)
    }
}

fn net<T: Real>(mut place: impl FnMut(f64, f64) -> [f64; 2]) -> Net<T> {
    let mut net = Net([[[T::ZERO; 2]; 4]; 4]);
    for (j, row) in net.0.iter_mut().enumerate() {
        for (i, point) in row.iter_mut().enumerate() {
            *point = place(i as f64 / 3.0, j as f64 / 3.0).map(T::from_f64);
        }
    }
    net
}

fn error<T: Real>() -> T {
    T::EPSILON * T::from_i32(4)
}

fn search<T: Real>(net: &Net<T>) -> (Vec<Root<T>>, u16) {
    let mut search = Search::new(net, T::EPSILON, None);
    let roots = std::iter::from_fn(|| search.next()).collect();
    (roots, search.pieces())
}

/// The control points of s² and of s³, at the parameters of those of s.
fn square(s: f64) -> f64 {
    s * (3.0 * s - 1.0) / 2.0
}

fn cube(s: f64) -> f64 {
    if s < 1.0 { 0.0 } else { 1.0 }
}

/// The net moved so that a pair of parameters is on the ray.
fn through<T: Real>(net: &Net<T>, at: Pair<f64>) -> Net<T> {
    let place = net.place(at.map(T::from_f64)).at;
    Net(net.0.map(|row| row.map(|[x, y]| [x - place[0], y - place[1]])))
}

fn wild<T: Real>(random: &mut Random) -> Net<T> {
    net(|_, _| [0; 2].map(|_| random.within(-1.0, 1.0)))
}

#[test]
fn parts_of_a_net_are_parts_of_the_patch() {
    let mut random = Random(7);
    for _ in 0..100 {
        let whole = wild::<f64>(&mut random);
        for way in [Way::U, Way::V] {
            let (mut low, mut high) = (whole, whole);
            low.halve(&mut high, way);
            let [s, t] = [random.within(0.0, 1.0), random.within(0.0, 1.0)];
            let at = |s: f64| if way == Way::U { [s, t] } else { [t, s] };
            for (piece, from) in [(low, 0.0), (high, 0.5)] {
                let (found, exact) = (piece.place(at(s)), whole.place(at(from + s * 0.5)));
                for i in 0..2 {
                    assert!((found.at[i] - exact.at[i]).abs() < 1e-14);
                }
            }
        }
    }
}

#[test]
fn facing_is_told_only_where_it_is_certain() {
    let mut random = Random(11);
    let mut told = 0;
    for _ in 0..2000 {
        let bent = random.within(0.0, 0.5);
        let whole = net::<f64>(|u, v| {
            [u + bent * random.within(-1.0, 1.0), v + bent * random.within(-1.0, 1.0)]
        });
        let Some(facing) = whole.facing(error()) else {
            continue;
        };
        told += 1;
        let place = |random: &mut Random| [0; 2].map(|_| random.within(0.0, 1.0));
        for _ in 0..20 {
            let (a, b) = (whole.place(place(&mut random)), whole.place(place(&mut random)));
            assert!(cross(a.du, b.dv) * f64::from(facing) > 0.0);
        }
    }
    assert!(told > 200 && told < 1900, "{told}");
    // Three quarters of a ring: du and dv never agree, yet two ends of it can come to one place.
    let turn = |s: f64| Real::sin_cos(core::f64::consts::PI * 1.5 * s);
    let ring = net::<f64>(|u, v| [turn(u).0 * (1.0 + v), turn(u).1 * (1.0 + v)]);
    assert_eq!(ring.facing(error()), None);
}

#[test]
fn a_side_that_is_a_point_is_no_obstacle() {
    let fan = net::<f64>(|u, v| [v * (u + 0.5), v * (1.5 - u)]);
    assert!(fan.facing(error()).is_some());
    let (roots, pieces) = search(&fan);
    // The ray goes through that very point.
    assert!(roots.iter().all(|root| root.at[1] < 1e-10) && !roots.is_empty());
    assert!(pieces < 128, "{pieces}");
}

#[test]
fn what_is_seen_edge_on_has_no_extent() {
    let flat = net::<f64>(|u, v| [u + 0.3 * v - 0.4, 2.0 * (u + 0.3 * v - 0.4)]);
    assert_eq!(flat.extent(error()), Extent::Line);
    let (roots, pieces) = search(&flat);
    assert!(roots.is_empty() && pieces == 1);
    assert_eq!(net::<f64>(|_, _| [0.0; 2]).extent(error()), Extent::Point);
}

/// Nets that are hard in their own way, with the ray through a point where it hurts.
fn hard<T: Real>(random: &mut Random, kind: u32) -> Net<T> {
    let [a, b, c] = [0; 3].map(|_| random.within(-1.0, 1.0));
    match kind {
        // Tangential along a whole line of the patch, within rounding.
        0 => net(|u, v| {
            let fold = square(v) - 0.8 * v + 0.16;
            [u - 0.5 + a * (v - 0.4), fold + (b - 0.5) * 4e-16]
        }),
        // Through a point where the patch folds.
        1 => {
            let whole = wild::<T>(random);
            let mut at = [0.5; 2];
            for _ in 0..40 {
                // Down to where du and dv agree, by the slope of their area along u.
                let area = |at: Pair<f64>| {
                    let place = whole.place(at.map(T::from_f64));
                    cross(place.du, place.dv).to_f64()
                };
                let slope = (area([at[0] + 1e-6, at[1]]) - area(at)) / 1e-6;
                at[0] = Number::clamp(at[0] - area(at) / slope, 0.0, 1.0);
            }
            through(&whole, at)
        }
        // All directions vanish at a corner, which is on the ray.
        2 => net(|u, v| [cube(u) + a * square(v), cube(v) + b * square(u)]),
        // A curve: the patch is seen along its rulings.
        3 => net(|u, _| [u - 0.5, (square(u) - u * 0.8 + 0.15) * c]),
        // A side that is nearly a point.
        4 => net(|u, v| {
            let noise = [0; 2].map(|_| random.within(-1e-16, 1e-16));
            [v * (u + 0.5) + noise[0], v * (1.5 - u) + noise[1]]
        }),
        // Tangential at a point where the patch is bent the other way on either side.
        5 => net(|u, v| {
            let (cubic, line) = (cube(u) - 1.5 * square(u) + 0.75 * u - 0.125, v - 0.5);
            [cubic + a * line, square(u) - u + 0.25 + b * line]
        }),
        // Edge on, but for rounding.
        6 => net(|u, v| {
            let x = (u - 0.5) + a * (v - 0.5) + square(u) * v * b;
            [x, x * c + random.within(-1e-16, 1e-16)]
        }),
        // Twice around the ray.
        7 => net(|u, v| {
            let (x, y) = (1.0 - square(u) * 2.0 * (1.0 + v), u * (1.0 - v) + a * 0.1);
            [x * b + y * c, y * b - x * c]
        }),
        // Nearly edge on, by some roundings to some million of them.
        8 => {
            let width = T::EPSILON.to_f64() * Real::exp(random.within(-1.0, 14.0));
            net(|u, v| {
                let x = (u - 0.5) + a * (v - 0.5) + square(u) * v * b;
                [x, x * c + random.within(-width, width)]
            })
        }
        _ => wild(random),
    }
}

fn effort<T: Real>(name: &str, nets: u32) {
    print!("{name}: most pieces looked at");
    for kind in 0..10 {
        let mut random = Random(u64::from(kind) + 99);
        let (mut most, mut found) = (0, 0);
        for _ in 0..nets {
            let (roots, pieces) = search(&hard::<T>(&mut random, kind));
            most = most.max(pieces);
            found = found.max(roots.len());
            let is_met = matches!(kind, 2 | 4);
            assert!(!is_met || !roots.is_empty(), "{name}, kind {kind}: a point is lost");
        }
        print!(" {most} ({found} roots)");
        assert!(most <= PIECES_MAX / 4, "{name}, kind {kind}: {most}");
    }
    println!();
}

#[test]
fn the_effort_is_bounded() {
    effort::<f32>("f32", 2000);
    effort::<f64>("f64", 2000);
    effort::<<Q16 as Scalar>::Wide>("fixed point", 100);
}

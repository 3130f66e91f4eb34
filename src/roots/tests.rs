//! Roots against arithmetic of a thousand bits: the exact values of the polynomial at and between
//! them.

use core::cell::Cell;
use std::vec::Vec;

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;

use super::*;
use crate::fixed_point::Wide;
use crate::scalar::Number;

extern crate std;

type Big = FBig<HalfEven, 2>;

fn big(x: f64) -> Big {
    Big::try_from(x).unwrap().with_precision(1000).value()
}

fn magnitude(x: &Big) -> Big {
    if *x < Big::ZERO { -x.clone() } else { x.clone() }
}

/// Steele, Lea and Flood's SplitMix64 (2014).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.bits() >> 11) as f64 / (1_u64 << 53) as f64)
    }

    fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }
}

/// An exact polynomial, in ascending powers.
#[derive(Clone)]
struct Exact(Vec<Big>);

impl Exact {
    fn of<T: Real, const N: usize>(coefficients: &[T; N]) -> Self {
        Self(coefficients.iter().map(|c| big(c.to_f64())).collect())
    }

    /// `scale · (t − r₀)(t − r₁)…`.
    fn planted(roots: &[f64], scale: f64) -> Self {
        let mut c = std::vec![big(scale)];
        for &root in roots {
            let mut next = std::vec![Big::ZERO; c.len() + 1];
            for (i, c) in c.iter().enumerate() {
                next[i + 1] = next[i + 1].clone() + c;
                next[i] = next[i].clone() - c * big(root);
            }
            c = next;
        }
        Self(c)
    }

    fn rounded<T: Real, const N: usize>(&self) -> [T; N] {
        let mut c = [T::ZERO; N];
        for (c, exact) in c.iter_mut().zip(&self.0) {
            *c = T::from_f64(exact.to_f64().value());
        }
        c
    }

    /// From powers to Bernstein's basis of the same degree.
    fn bernstein(&self) -> Self {
        let n = self.0.len() - 1;
        let choose =
            |n: usize, k: usize| (0..k).fold(1.0, |p, i| p * (n - i) as f64 / (i + 1) as f64);
        let entry = |j: usize| {
            (0..=j)
                .fold(Big::ZERO, |sum, i| sum + &self.0[i] * big(choose(j, i)) / big(choose(n, i)))
        };
        Self((0..=n).map(entry).collect())
    }

    /// From Bernstein's basis to powers.
    fn power(&self) -> Self {
        let n = self.0.len() - 1;
        let choose =
            |n: usize, k: usize| (0..k).fold(1.0, |p, i| p * (n - i) as f64 / (i + 1) as f64);
        let entry = |j: usize| {
            let sign = |i: usize| if (i + j).is_multiple_of(2) { 1.0 } else { -1.0 };
            let part = |i: usize| &self.0[i] * big(sign(i) * choose(j, i) * choose(n, j));
            (0..=j).fold(Big::ZERO, |sum, i| sum + part(i))
        };
        Self((0..=n).map(entry).collect())
    }

    fn value(&self, t: &Big) -> Big {
        self.0.iter().rev().fold(Big::ZERO, |value, c| value * t + c)
    }

    /// The sum of the magnitudes of the terms.
    fn size(&self, t: &Big) -> Big {
        let t = magnitude(t);
        self.0.iter().rev().fold(Big::ZERO, |value, c| value * &t + magnitude(c))
    }

    fn raised(&self, by: &Big) -> Self {
        let mut c = self.0.clone();
        c[0] = c[0].clone() + by;
        Self(c)
    }
}

fn all<T: Real, const N: usize>(coefficients: &[T; N], ends: [T; 2]) -> Vec<f64> {
    let mut found = Vec::new();
    crossings(coefficients, ends, |t| found.push(t.to_f64()));
    found
}

fn all_bernstein<T: Real, const N: usize>(coefficients: &[T; N]) -> Vec<f64> {
    let mut found = Vec::new();
    bernstein_crossings(coefficients, |t| found.push(t.to_f64()));
    found
}

/// Checks what was found for an exact polynomial: strictly ascending, as many as the signs at the
/// ends demand, each a root within `noise` of its value; and wherever a change of sign could hide, near
/// the planted roots and all over, the sign is the one that the roots before tell, or the value is noise.
fn check(
    found: &[f64],
    exact: &Exact,
    planted: &[f64],
    [low, high]: [f64; 2],
    noise: impl Fn(&Big) -> Big,
) {
    assert!(found.windows(2).all(|pair| pair[0] < pair[1]), "{found:?} is not ascending");
    let negative = |t: f64| exact.value(&big(t)) < Big::ZERO;
    let is_noise = |t: f64| magnitude(&exact.value(&big(t))) <= noise(&big(t));
    for &t in found {
        assert!(low <= t && t <= high, "{found:?} beyond the ends");
        assert!(is_noise(t), "{found:?}: {t} is no root");
    }
    if is_noise(low) || is_noise(high) {
        // Rounding decides on which side of an end a root lies.
        return;
    }
    assert_eq!(found.len() % 2 == 1, negative(low) != negative(high), "{found:?}: parity");
    let mut places = planted.to_vec();
    places.extend(found);
    places.sort_by(f64::total_cmp);
    let between: Vec<f64> = places.windows(2).map(|pair| (pair[0] + pair[1]) / 2.0).collect();
    places.extend(between);
    places.extend((0..64).map(|n| low + (high - low) * f64::from(n) / 64.0));
    for t in places.into_iter().filter(|&t| low < t && t < high && !found.contains(&t)) {
        let told = negative(low) != (found.iter().filter(|&&root| root < t).count() % 2 == 1);
        assert!(told == negative(t) || is_noise(t), "{found:?}: wrong sign at {t}");
    }
}

/// Roots of every kind of neighbourhood: apart, in clusters, in pairs that nearly meet or just miss.
fn roots_of(random: &mut Random, degree: usize, near: f64) -> Vec<f64> {
    let mut roots: Vec<f64> = Vec::new();
    while roots.len() < degree {
        let t = match (random.below(3), roots.last()) {
            (0, Some(last)) => {
                last + near * [1.0, 0.1, 1e-2, 1e-3][random.below(4)] * random.within(-1.0, 1.0)
            }
            _ => random.within(-1.2, 1.2),
        };
        roots.push(t);
    }
    roots
}

fn planted<T: Real, const N: usize>(cases: u32, near: f64, epsilon: f64) {
    let mut random = Random(N as u64);
    let mut met = 0;
    for case in 0..cases {
        let degree = 1 + random.below(N - 1);
        let roots = roots_of(&mut random, degree, near);
        let scale =
            [1e-6, 1e-3, 1.0, 1e3, 1e6][case as usize % 5] * if case % 2 == 0 { 1.0 } else { -1.0 };
        let mut exact = Exact::planted(&roots, scale);
        if case % 3 == 0 && degree > 1 {
            // Pairs move apart, or away from the axis.
            exact = exact.raised(&big(scale * random.within(-1.0, 1.0) * near * near));
        }
        let c: [T; N] = exact.rounded();
        let rounded = Exact::of(&c);
        let found = all(&c, [-T::ONE, T::ONE]);
        met += found.len();
        check(&found, &rounded, &roots, [-1.0, 1.0], |t| rounded.size(t) * big(epsilon * 16.0));

        exact.0.resize(N, Big::ZERO);
        let c: [T; N] = exact.bernstein().rounded();
        let most = c.iter().fold(0.0, |most: f64, c| Number::max(most, c.to_f64().abs()));
        let exact = Exact::of(&c).power();
        let found = all_bernstein(&c);
        check(&found, &exact, &roots, [0.0, 1.0], |_| big(most * epsilon * 16.0));
    }
    assert!(met as u32 > cases / 2, "{met} roots");
}

#[test]
fn roots_are_those_of_exact_arithmetic() {
    for near in [0.5, 1e-2, 1e-5] {
        planted::<f32, 5>(300, near, f32::EPSILON.into());
        planted::<f32, 7>(200, near, f32::EPSILON.into());
        planted::<f64, 4>(200, near, f64::EPSILON);
        planted::<f64, 5>(300, near, f64::EPSILON);
        planted::<f64, 7>(300, near, f64::EPSILON);
    }
}

#[test]
fn the_wide_number_has_the_same_roots() {
    // Exact values that f64 holds, and roots told to its precision.
    planted::<Wide, 5>(100, 1e-2, f64::EPSILON);
    planted::<Wide, 7>(100, 1e-2, f64::EPSILON);
}

#[test]
fn touching_is_no_crossing() {
    // (t − 1)²(t + 2)², and the same upside down.
    for sign in [1.0, -1.0] {
        assert_eq!(all(&[4.0, -4.0, -3.0, 2.0, 1.0].map(|c: f64| c * sign), [-4.0, 4.0]), [0.0; 0]);
    }
    // t²(t − 1), t³, t⁶.
    assert_eq!(all(&[0.0, 0.0, -1.0, 1.0], [-2.0, 2.0]), [1.0]);
    assert_eq!(all(&[0.0_f32, 0.0, 0.0, 1.0], [-2.0, 2.0]), [0.0]);
    assert_eq!(all(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], [-2.0, 3.0]), [0.0; 0]);
    // Of Bernstein coefficients, (2u − 1)² both ways.
    assert_eq!(all_bernstein(&[1.0, -1.0, 1.0]), [0.0; 0]);
    assert_eq!(all_bernstein(&[-1.0, 1.0, -1.0]), [0.0; 0]);
}

#[test]
fn roots_at_the_ends_follow_the_sign_of_zero() {
    // 0 counts as positive: t is negative before it only, −t after it only.
    assert_eq!(all(&[0.0, 1.0], [-1.0, 0.0]), [0.0]);
    assert_eq!(all(&[0.0, 1.0], [0.0, 1.0]), [0.0; 0]);
    assert_eq!(all(&[0.0, -1.0], [0.0, 1.0]), [0.0]);
    assert_eq!(all(&[0.0, -1.0], [-1.0, 0.0]), [0.0; 0]);
    assert_eq!(all_bernstein(&[-1.0, 0.0]), [1.0]);
    assert_eq!(all_bernstein(&[0.0, 1.0]), [0.0; 0]);
    assert_eq!(all_bernstein(&[0.0, -1.0, -1.0, 1.0]).len(), 2);
}

#[test]
fn vanishing_coefficients_lower_the_degree() {
    assert_eq!(all(&[-1.0_f32, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0], [-9.0, 9.0]), [0.5]);
    assert_eq!(all(&[-1.0, 0.0, 4.0, 0.0, 0.0], [-9.0, 9.0]), [-0.5, 0.5]);
    assert_eq!(all(&[0.0; 7], [-9.0, 9.0]), [0.0; 0]);
    assert_eq!(all(&[-3.0; 1], [-9.0, 9.0]), [0.0; 0]);
    // A tiny leading coefficient puts the other roots far beyond the ends.
    assert_eq!(all(&[-1.0, 0.0, 4.0, 1e-300, 1e-300], [-9.0, 9.0]), [-0.5, 0.5]);
    assert_eq!(all_bernstein(&[0.0; 5]), [0.0; 0]);
    // Linear, raised in degree.
    assert_eq!(all_bernstein(&[-1.0, 0.0, 1.0, 2.0, 3.0]), [0.25]);
}

#[test]
fn size_does_not_matter() {
    let plain = [-3.0, 1.0, 19.0, -4.0, -12.0, 1.0, 1.0_f64];
    let bernstein = [-1.0, 3.0, -4.0, 5.0, -3.0, 1.0_f64];
    let (ends, roots, parameters) =
        ([-4.0, 4.0], all(&plain, [-4.0, 4.0]), all_bernstein(&bernstein));
    assert!(roots.len() >= 4 && parameters.len() >= 3);
    for factor in [1e-9_f64, 1e-300, 1e9, 1e300].map(|x| f64::from_bits(x.to_bits() >> 52 << 52)) {
        assert_eq!(all(&plain.map(|c| c * factor), ends), roots);
        assert_eq!(all_bernstein(&bernstein.map(|c| c * factor)), parameters);
    }
}

/// How often a function is evaluated on the way to its roots.
fn counted<T: Real, const N: usize>(coefficients: &[T; N], ends: [T; 2]) -> (u32, u32) {
    let (all, least) = (Cell::new(0), Cell::new(0));
    let mut roots = 0;
    let knots = turning_points(coefficients, ends);
    let f = |t: T| {
        all.set(all.get() + 1);
        power_value(coefficients, t)
    };
    crossings_between(knots.as_slice(), ends, f, |_| roots += 1);
    least.set(knots.as_slice().len() as u32 + 2);
    (all.get() - least.get(), roots)
}

#[test]
fn steps_are_bounded() {
    let (mut worst, mut sum, mut roots) = (0, 0, 0);
    // Multiple roots, where Newton's method creeps, and roots far below the bracket's size.
    for at in [0.0, 0.3, 1e-3, 1e-9, 1e-30, 1e-200] {
        for multiplicity in [1, 3, 5] {
            let exact = Exact::planted(&std::vec![at; multiplicity], 1.0);
            let (steps, one) = counted::<f64, 6>(&exact.rounded(), [-1.0, 1.0]);
            assert!(steps <= STEPS_MAX * one.max(1), "{steps} steps to {one} roots");
            worst = worst.max(steps);
            let (steps, _) = counted::<Wide, 6>(&exact.rounded(), [-Wide::ONE, Wide::ONE]);
            worst = worst.max(steps);
        }
    }
    // So slow a function that only bisection is left: it ends.
    let root = |t: f64| [if t < 1e-300 { -1.0 } else { 1.0 }, 0.0];
    let calls = Cell::new(0);
    crossings_between(
        &[],
        [-1.0, 1.0],
        |t| {
            calls.set(calls.get() + 1);
            root(t)
        },
        |_| (),
    );
    worst = worst.max(calls.get() - 2);
    assert!(worst <= STEPS_MAX && worst > STEPS_MAX / 2, "{worst} steps");
    let mut random = Random(3);
    for _ in 0..1000 {
        let exact = Exact::planted(&roots_of(&mut random, 4, 0.5), 1.0);
        let (steps, found) = counted::<f64, 5>(&exact.rounded(), [-1.0, 1.0]);
        (sum, roots) = (sum + steps, roots + found);
    }
    // Ordinary roots take a few.
    assert!(sum <= roots * 12, "{sum} steps to {roots} roots");
}

/// A curve that comes back to 0 at an end changes its sign before; once the end was taken for the place.
#[test]
fn an_end_at_zero_is_not_the_change_of_sign() {
    let one = |curve: &[f64; 3], expected: f64| {
        let found = all_bernstein(curve);
        found.len() == 1 && (found[0] - expected).abs() <= 1e-15
    };
    // (1 − u)·(9u − 6), and u·(3 − 9u).
    assert!(one(&[-6.0, 1.5, 0.0], 2.0 / 3.0));
    assert!(one(&[0.0, 1.5, -6.0], 1.0 / 3.0));
    assert_eq!(all_bernstein(&[-1.0, 0.0]), [1.0]);
    assert_eq!(all_bernstein(&[0.0, -1.0]), [0.0]);
}

#[test]
fn the_bound_on_evaluations_is_the_sum_over_the_chain() {
    assert_eq!(evaluations_max(1), STEPS_MAX + 2);
    assert_eq!(evaluations_max(2), 3 * STEPS_MAX + 5);
    assert!(evaluations_max(DEGREE_MAX as u32) <= 21 * (STEPS_MAX + 1) + 6);
}

//! Implicit solids against dense scans of their formulas, under stress: any ray, rays that graze,
//! far rays, thin shells, tiny and huge solids; and rays that start on the surface.
//!
//! `cargo test --test solids implicit -- --nocapture` prints the tables. "wrong" counts rays with another
//! number of spans than the scan has; "margin" is by how much, in ε of the size or in steps of the
//! format, the level of the formula has to be moved until the scan agrees; "off" is the greatest
//! distance of a boundary from the surface and "steep" the greatest error of t where the ray makes more than
//! 17 degrees with the surface, both over the size of the box, in fixed point in steps.
//! `NOSTRAY_RAYS=100000` asks for more rays of each kind.
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

use crate::oracle::field::{Aim, Builder, Field, Subject, Tally, is_float, vector};
use crate::oracle::starts::Starts;
use crate::oracle::{Random, length};
use nostray::shape::program::*;
use nostray::{Affine, Form, Q16, Q32, Scalar};

/// How many rays of each kind, unless the environment asks for more.
fn rays(few: u32) -> u32 {
    std::env::var("NOSTRAY_RAYS").map_or(few, |rays| rays.parse().expect("a number of rays"))
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Ball,
    Torus,
    /// The same surface as a polynomial.
    Quartic,
    Gyroid,
    /// A thin shell about it.
    Shell,
    /// Three balls, joined smoothly.
    Smooth,
    Tangle,
    Superellipsoid,
    /// A hollow ball with a wall of a thousandth.
    Bubble,
    /// A ball less another, both by formulas.
    Bite,
}

const KINDS: [Kind; 10] = [
    Kind::Ball,
    Kind::Torus,
    Kind::Quartic,
    Kind::Gyroid,
    Kind::Shell,
    Kind::Smooth,
    Kind::Tangle,
    Kind::Superellipsoid,
    Kind::Bubble,
    Kind::Bite,
];

const SQUARES: [u8; 8] = [X, SQUARE, Y, SQUARE, ADD, Z, SQUARE, ADD];

/// The distance from the point of three numbers.
fn distance(x: u8, y: u8, z: u8) -> Vec<u8> {
    let [x, y, z] = [[X, NUMBER, x], [Y, NUMBER, y], [Z, NUMBER, z]];
    let part = |[axis, number, index]: [u8; 3]| [axis, number, index, SUB, SQUARE];
    [&part(x)[..], &part(y), &[ADD], &part(z), &[ADD, ROOT]].concat()
}

/// A formula with its numbers, as the format has them.
#[derive(Clone, Debug)]
struct Formula {
    kind: Kind,
    numbers: Vec<f64>,
}

impl Formula {
    fn new<S: Scalar>(kind: Kind) -> Self {
        let numbers = match kind {
            Kind::Ball => vec![1.0],
            Kind::Torus => vec![1.0, 0.25],
            Kind::Quartic => vec![0.9375, 4.0, 0.25],
            Kind::Gyroid => vec![1.75],
            Kind::Shell => vec![1.75, 0.1],
            Kind::Smooth => vec![0.5, -0.4, 0.1, 0.5, 0.3],
            Kind::Tangle => vec![5.0, 11.8, 1.0 / 16.0],
            Kind::Superellipsoid => vec![2.5, 1.6],
            Kind::Bubble => vec![1.0, 0.001],
            Kind::Bite => vec![0.7, 0.0, 0.2, 0.8, 1.0],
        };
        Self { kind, numbers: numbers.into_iter().map(|x| S::from_f64(x).to_f64()).collect() }
    }

    fn code(&self) -> Vec<u8> {
        let wave = |a: u8, b: u8| [a, NUMBER, 0, MUL, SIN, b, NUMBER, 0, MUL, COS, MUL];
        let gyroid = || [&wave(X, Y)[..], &wave(Y, Z), &[ADD], &wave(Z, X), &[ADD]].concat();
        match self.kind {
            Kind::Ball => [&SQUARES[..], &[NUMBER, 0, SUB]].concat(),
            Kind::Torus => vec![
                X, SQUARE, Z, SQUARE, ADD, ROOT, NUMBER, 0, SUB, SQUARE, Y, SQUARE, ADD, ROOT,
                NUMBER, 1, SUB,
            ],
            Kind::Quartic => [
                &SQUARES[..],
                &[NUMBER, 0, ADD, SQUARE, X, SQUARE, Z, SQUARE, ADD, NUMBER, 1, MUL, SUB],
                &[NUMBER, 2, MUL],
            ]
            .concat(),
            Kind::Gyroid => gyroid(),
            Kind::Shell => [&gyroid()[..], &[ABS, NUMBER, 1, SUB]].concat(),
            Kind::Smooth => [
                &distance(0, 1, 2)[..],
                &distance(1, 0, 2),
                &[SMOOTH_MIN, 4],
                &distance(2, 2, 0),
                &[SMOOTH_MIN, 4, NUMBER, 3, SUB],
            ]
            .concat(),
            Kind::Tangle => {
                let quartic = |axis: u8| [axis, SQUARE, COPY, 0, NUMBER, 0, SUB, MUL];
                [
                    &quartic(X)[..],
                    &quartic(Y),
                    &[ADD],
                    &quartic(Z),
                    &[ADD, NUMBER, 1, ADD, NUMBER, 2, MUL],
                ]
                .concat()
            }
            Kind::Superellipsoid => vec![
                X, REAL_POWER, 0, Y, REAL_POWER, 0, ADD, REAL_POWER, 1, Z, POWER, 4, ADD, NUMBER,
                0, NUMBER, 0, DIV, SUB,
            ],
            Kind::Bubble => [&SQUARES[..], &[ROOT, NUMBER, 0, SUB, ABS, NUMBER, 1, SUB]].concat(),
            Kind::Bite => {
                [&SQUARES[..], &[NUMBER, 4, SUB, NUMBER, 3], &distance(0, 1, 2), &[SUB, MAX]]
                    .concat()
            }
        }
    }
}

impl Field for Formula {
    fn value(&self, [x, y, z]: [f64; 3]) -> f64 {
        let n = &self.numbers;
        let from = |a: usize, b: usize, c: usize| length([x - n[a], y - n[b], z - n[c]]);
        let gyroid = || {
            let [x, y, z] = [x * n[0], y * n[0], z * n[0]];
            x.sin() * y.cos() + y.sin() * z.cos() + z.sin() * x.cos()
        };
        let smooth = |a: f64, b: f64, k: f64| {
            let h = (k - (a - b).abs()).max(0.0) / k;
            a.min(b) - h * h * k / 4.0
        };
        let square = x * x + y * y + z * z;
        match self.kind {
            Kind::Ball => square - n[0],
            Kind::Torus => x.hypot(z).mul_add(1.0, -n[0]).hypot(y) - n[1],
            Kind::Quartic => ((square + n[0]).powi(2) - n[1] * (x * x + z * z)) * n[2],
            Kind::Gyroid => gyroid(),
            Kind::Shell => gyroid().abs() - n[1],
            Kind::Smooth => {
                smooth(smooth(from(0, 1, 2), from(1, 0, 2), n[4]), from(2, 2, 0), n[4]) - n[3]
            }
            Kind::Tangle => {
                let quartic = |x: f64| x.powi(4) - n[0] * x * x;
                (quartic(x) + quartic(y) + quartic(z) + n[1]) * n[2]
            }
            Kind::Superellipsoid => {
                (x.abs().powf(n[0]) + y.abs().powf(n[0])).powf(n[1]) + z.powi(4) - 1.0
            }
            Kind::Bubble => (square.sqrt() - n[0]).abs() - n[1],
            Kind::Bite => (square - n[4]).max(n[3] - from(0, 1, 2)),
        }
    }

    fn corners(&self) -> [[f64; 3]; 2] {
        let half = match self.kind {
            Kind::Gyroid | Kind::Shell => 1.5,
            Kind::Torus | Kind::Quartic => 1.375,
            Kind::Tangle => 2.25,
            Kind::Superellipsoid => 1.125,
            _ => 1.25,
        };
        [[-half; 3], [half; 3]]
    }

    fn plant<S: Scalar>(&self, builder: &mut Builder<S>, map: &Affine<S>) {
        let numbers: Vec<S> = self.numbers.iter().map(|&x| S::from_f64(x)).collect();
        let [min, max] = self.corners().map(vector::<S>);
        let polynomial = matches!(self.kind, Kind::Ball | Kind::Quartic | Kind::Tangle);
        let spans = if polynomial { None } else { Some(16) };
        let form = Form::Implicit { min, max, code: &self.code(), numbers: &numbers, spans };
        builder.leaf(form, map, 0).expect("a legal solid");
    }
}

/// A solid of some size, often turned, anywhere near the origin.
fn subject<S: Scalar>(kind: Kind, random: &mut Random) -> Subject<S, Formula> {
    let (scale, reach) = if is_float::<S>() {
        (random.decades(-4.0, 4.0), 3.0)
    } else {
        (random.decades(-0.5, 1.5), 20.0)
    };
    let turned = random.bits() & 1 == 0;
    let turns = [0; 3].map(|_| if turned { random.within(0.0, 360.0) } else { 0.0 });
    let place = random.cube().map(|x| x * scale * reach);
    Subject::new(Formula::new::<S>(kind), if turned { scale } else { 1.0 }, turns, place)
}

fn measure<S: Scalar>(kind: Kind, aim: Aim, rays: u32) -> Tally {
    let mut random = Random::new(kind as u64 * 10 + aim as u64);
    let mut tally = Tally::default();
    while tally.rays < rays {
        let subject = subject::<S>(kind, &mut random);
        for _ in 0..16 {
            if let Some(ray) = subject.ray(&mut random, aim) {
                tally.take(&subject, ray, 1000);
            }
        }
    }
    tally
}

/// What may be measured: the share of wrong counts, their margin, and errors.
#[derive(Clone, Copy)]
struct Limit {
    wrong: f64,
    margin: f64,
    error: f64,
}

fn table<S: Scalar>(aim: Aim, rays: u32, limit: Limit) {
    Tally::heading::<S>(&format!("{aim:?}"));
    for kind in KINDS {
        let tally = measure::<S>(kind, aim, rays);
        tally.show(&format!("{kind:?}"));
        let name = format!("{} {kind:?} {aim:?}", S::NAME);
        assert!(tally.spans > rays / 5, "{name}: {} spans of {rays} rays", tally.spans);
        assert!(f64::from(tally.wrong) <= limit.wrong * f64::from(rays), "{name}: wrong");
        assert!(tally.margin <= limit.margin, "{name}: a margin of {}", tally.margin);
        assert!(tally.geo.max(tally.steep) <= limit.error, "{name}: errors");
    }
}

#[test]
fn every_span_of_f64_is_found() {
    let limit = Limit { wrong: 0.0, margin: 0.0, error: 4e-15 };
    table::<f64>(Aim::Random, rays(150), limit);
    table::<f64>(Aim::Grazing, rays(150), limit);
    table::<f64>(Aim::Far, rays(100), limit);
}

/// A ray that passes within a few ε of the surface may go either way.
#[test]
fn every_span_of_f32_is_found() {
    let limit = Limit { wrong: 0.0, margin: 0.0, error: 4e-6 };
    table::<f32>(Aim::Random, rays(150), limit);
    table::<f32>(Aim::Far, rays(100), limit);
    table::<f32>(Aim::Grazing, rays(150), Limit { wrong: 0.1, margin: 16.0, error: 1e-5 });
}

#[test]
fn fixed_point_is_exact_to_its_steps() {
    let limit = Limit { wrong: 0.01, margin: 1.0, error: 1.0 };
    for aim in [Aim::Random, Aim::Grazing] {
        table::<Q16>(aim, rays(60), limit);
        table::<Q32>(aim, rays(60), limit);
    }
}

fn starts<S: Scalar>(rays: u32) {
    let [rays_, met, lost, points, wrong] = ["rays", "met", "lost", "points", "wrong"];
    println!("{:29} {rays_:>7} {met:>5} {lost:>5} {points:>9} {wrong:>6}", "starts");
    for kind in KINDS {
        let mut random = Random::new(kind as u64);
        let mut starts = Starts::default();
        while starts.rays < rays {
            let subject = subject::<S>(kind, &mut random);
            for _ in 0..16 {
                let convex = matches!(kind, Kind::Ball | Kind::Superellipsoid);
                starts.take(&subject, &mut random, convex);
            }
        }
        starts.show::<S>(&format!("{kind:?}"));
        let name = format!("{} {kind:?}", S::NAME);
        assert_eq!(starts.met, 0, "{name}: rays that meet the surface they leave");
        assert_eq!(starts.lost, 0, "{name}: rays inward that do not come out");
        // Along the surface a bend of rounding reaches far.
        assert!(starts.wrong <= starts.points / 1000, "{name}: {} wrong points", starts.wrong);
    }
}

#[test]
fn no_ray_meets_the_surface_it_starts_on_and_none_loses_the_far_side() {
    starts::<f32>(rays(300));
    starts::<f64>(rays(300));
    starts::<Q16>(rays(60));
    starts::<Q32>(rays(60));
}

/// What is asked for up to some point of a ray is what all of it has there.
#[test]
fn boundaries_up_to_a_point_are_those_of_the_whole_ray() {
    fn compare<S: Scalar>(rays: u32) {
        let mut random = Random::new(12);
        let mut shorter = 0;
        for n in 0..rays {
            let subject = subject::<S>(KINDS[n as usize % KINDS.len()], &mut random);
            let Some(ray) = subject.ray(&mut random, Aim::Random) else { continue };
            let all: Vec<S> = subject.spans(ray, None).into_iter().flatten().collect();
            let Some(&last) = all.last() else { continue };
            for t in [all[0], all[all.len() / 2], last].map(S::next_down) {
                let some = subject.spans_until(ray, t);
                let up_to = |list: &[S]| list.iter().copied().filter(|&end| end <= t).collect();
                let [expected, found]: [Vec<S>; 2] = [up_to(&all), up_to(&some)];
                assert_eq!(expected, found, "{:?} up to {t}", subject.field.kind);
                shorter += u32::from(some.len() < all.len());
            }
        }
        assert!(shorter > rays / 20, "{shorter} rays were shorter");
    }
    compare::<f32>(600);
    compare::<f64>(600);
    compare::<Q16>(60);
    compare::<Q32>(60);
}

/// Where there are more spans than were declared, the last one is filled up to the last exit.
#[test]
fn spans_beyond_those_declared_are_joined() {
    let plant = |spans: u16| {
        let mut builder = Builder::<f64>::new();
        builder.material(nostray::Material::matte(nostray::Rgb::WHITE)).expect("room");
        let corner = nostray::glam::DVec3::splat(10.0);
        let code = [X, SIN];
        let spans = Some(spans);
        let form = Form::Implicit { min: -corner, max: corner, code: &code, numbers: &[], spans };
        builder.leaf(form, &Affine::identity(), 0).expect("a legal solid");
        builder
    };
    let ends = |spans: u16| -> Vec<f64> {
        let builder = plant(spans);
        let vacant = nostray::Boundary {
            t: 0.0,
            node: 0,
            face: 0,
            passage: nostray::Passage::Touch,
            inverted: false,
        };
        let mut buffer = [vacant; 16];
        let [origin, dir] = [[-20.0, 0.0, 0.0], [1.0, 0.0, 0.0]].map(nostray::glam::DVec3::from);
        let scene = builder.scene().expect("a legal scene");
        let spans = scene.spans(0, nostray::Ray { origin, dir }, &mut buffer).expect("room");
        spans.boundaries.iter().map(|b| b.t - 20.0).collect()
    };
    let all = ends(8);
    assert_eq!(all.len(), 8, "{all:?}");
    assert_eq!(ends(4), all);
    assert_eq!(ends(2), [all[0], all[1], all[2], all[7]]);
    assert_eq!(ends(1), [all[0], all[7]]);
}

#[test]
fn what_is_no_solid_is_refused() {
    let refused = |code: &[u8], numbers: &[f64], max: f64, spans: Option<u16>| {
        let mut builder = Builder::<f64>::new();
        builder.material(nostray::Material::matte(nostray::Rgb::WHITE)).expect("room");
        let [min, max] = [[-1.0; 3], [1.0, max, 1.0]].map(nostray::glam::DVec3::from);
        let form = Form::Implicit { min, max, code, numbers, spans };
        builder.leaf(form, &Affine::identity(), 0).map_err(|error| error.to_string())
    };
    let ball = [&SQUARES[..], &[NUMBER, 0, SUB]].concat();
    assert_eq!(refused(&ball, &[1.0], 1.0, None), Ok(()));
    for (result, part) in [
        (refused(&ball, &[1.0], -2.0, None), "node 0: max lies below"),
        (refused(&ball, &[1.0], f64::NAN, None), "node 0: max is not a finite number"),
        (refused(&ball, &[f64::INFINITY], 1.0, None), "node 0: numbers is not a finite number"),
        (refused(&ball, &[], 1.0, None), "node 0: byte 8 of the program names a number"),
        (refused(&[X, Y], &[], 1.0, None), "node 0: byte 2 of the program leaves more than one"),
        (refused(&ball, &[1.0], 1.0, Some(0)), "node 0: spans must be greater than 0"),
        (refused(&[X, SIN], &[], 1.0, None), "node 0: spans must be given"),
        (refused(&[X; 200], &[], 1.0, None), "node 0: byte 8 of the program needs more room"),
    ] {
        let message = result.expect_err("a bad solid was taken");
        assert!(message.starts_with(part), "{part:?} in {message:?}");
    }
}

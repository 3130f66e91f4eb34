//! Blobs against dense scans of their fields, under stress: any ray, rays that graze, far rays, thin
//! necks, cylinders, components that take away, tiny and huge solids; and rays that start on the surface.
//!
//! `cargo test --test solids blob -- --nocapture` prints the tables. "wrong" counts rays with another
//! number of spans than the scan has; "margin" is by how much, in ε of the size or in steps of the
//! format, the surface has to be moved until the scan agrees; "off" is the greatest
//! distance of a boundary from the surface and "steep" the greatest error of t where the ray makes more than
//! 17 degrees with the surface, both over the size of the box, in fixed point in steps.
//! `NOSTRAY_RAYS=100000` asks for more rays of each kind.
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

use crate::oracle::Random;
use crate::oracle::field::{Aim, Builder, Field, Subject, Tally, array, is_float, vector};
use crate::oracle::starts::Starts;
use nostray::{Affine, Form, Metaball, Q16, Q32, Scalar};

/// How many rays of each kind, unless the environment asks for more.
fn rays(few: u32) -> u32 {
    std::env::var("NOSTRAY_RAYS").map_or(few, |rays| rays.parse().expect("a number of rays"))
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// One ball.
    Ball,
    /// One cylinder with round ends.
    Capsule,
    /// Two balls in one place, the smaller of them taking away: a hollow ball.
    Hollow,
    /// Two balls whose neck is barely there.
    Neck,
    /// The same, barely not.
    Gap,
    /// Five balls in some places.
    Cluster,
    /// Four cylinders in some places.
    Rods,
    /// Balls and cylinders of either sign.
    Mixed,
    /// Many small ones in a row within a large one that takes away.
    Chain,
}

const KINDS: [Kind; 9] = [
    Kind::Ball,
    Kind::Capsule,
    Kind::Hollow,
    Kind::Neck,
    Kind::Gap,
    Kind::Cluster,
    Kind::Rods,
    Kind::Mixed,
    Kind::Chain,
];

/// A component in double precision.
#[derive(Clone, Copy, Debug)]
struct Part {
    ends: [[f64; 3]; 2],
    radius: f64,
    strength: f64,
}

/// A field with its threshold, as the format has them.
#[derive(Clone, Debug)]
struct Sum {
    parts: Vec<Part>,
    threshold: f64,
}

/// Where the components of a blob are in the tables, in its own coordinates.
fn stored<S: Scalar>(subject: &Subject<S, Sum>) -> Sum {
    let scene = subject.builder.scene().expect("a legal scene");
    let tables = scene.parts().tables;
    let ends = tables.points.chunks(2).map(|ends| [0, 1].map(|i: usize| array::<S>(ends[i])));
    let numbers = tables.numbers[1..].chunks(2).map(|pair| [0, 1].map(|i: usize| pair[i].to_f64()));
    let part =
        |(ends, [radius, strength]): ([[f64; 3]; 2], [f64; 2])| Part { ends, radius, strength };
    Sum { parts: ends.zip(numbers).map(part).collect(), threshold: tables.numbers[0].to_f64() }
}

fn ball(center: [f64; 3], radius: f64, strength: f64) -> Part {
    Part { ends: [center; 2], radius, strength }
}

fn parts(kind: Kind, random: &mut Random) -> Vec<Part> {
    let place = |random: &mut Random, size: f64| random.cube().map(|x| x * size);
    let some = |random: &mut Random, sign: f64| {
        let (center, radius) = (place(random, 0.8), random.within(0.4, 1.0));
        ball(center, radius, sign * random.within(0.6, 2.0))
    };
    let rod = |random: &mut Random, sign: f64| {
        let ends = [place(random, 0.9), place(random, 0.9)];
        let (radius, strength) = (random.within(0.2, 0.7), sign * random.within(0.8, 2.0));
        Part { ends, radius, strength }
    };
    // At half way the two fields add up to half a unit.
    let half = (1.0 - 0.5_f64).sqrt();
    match kind {
        Kind::Ball => vec![ball(place(random, 0.5), 1.0, 1.0)],
        Kind::Capsule => vec![rod(random, 1.0)],
        Kind::Hollow => vec![ball([0.0; 3], 1.5, 1.0), ball([0.0; 3], 1.0, -0.95)],
        Kind::Neck | Kind::Gap => {
            let more = random.decades(-5.0, -2.0) * if kind == Kind::Neck { -1.0 } else { 1.0 };
            let x = half * (1.0 + more);
            vec![ball([-x, 0.0, 0.0], 1.0, 1.0), ball([x, 0.0, 0.0], 1.0, 1.0)]
        }
        Kind::Cluster => (0..5).map(|_| some(random, 1.0)).collect(),
        Kind::Rods => (0..4).map(|_| rod(random, 1.0)).collect(),
        Kind::Mixed => {
            let signs = [1.0, -1.0, 1.0];
            let balls = signs.map(|sign| some(random, sign));
            let rods = signs.map(|sign| rod(random, sign));
            balls.into_iter().chain(rods).collect()
        }
        Kind::Chain => {
            let links = (0..7).map(|i| {
                let x = -1.2 + 0.4 * f64::from(i);
                ball([x, random.within(-0.1, 0.1), 0.0], random.within(0.2, 0.45), 1.5)
            });
            links.chain([ball([0.0; 3], 1.5, -0.25)]).collect()
        }
    }
}

impl Sum {
    fn new<S: Scalar>(kind: Kind, random: &mut Random) -> Self {
        let held = |x: f64| S::from_f64(x).to_f64();
        loop {
            let mut parts = parts(kind, random);
            for part in &mut parts {
                part.ends = part.ends.map(|end| end.map(held));
                (part.radius, part.strength) = (held(part.radius), held(part.strength));
            }
            let threshold = held(match kind {
                Kind::Gap | Kind::Neck => 0.5,
                Kind::Hollow => 0.2,
                _ => 0.4,
            });
            let sum = Self { parts, threshold };
            let seen = |part: &Part| {
                let [x, y, z] = part.ends[0];
                sum.value([x, y, z]).min(sum.value([x + 0.7 * part.radius, y, z])) < 0.0
            };
            if sum.parts.iter().any(seen) {
                return sum;
            }
        }
    }
}

impl Part {
    fn field(&self, p: [f64; 3]) -> f64 {
        let [a, b] = self.ends;
        let (mut along, mut square) = (0.0, 0.0);
        for i in 0..3 {
            along += (p[i] - a[i]) * (b[i] - a[i]);
            square += (b[i] - a[i]) * (b[i] - a[i]);
        }
        let share = if square > 0.0 { (along / square).clamp(0.0, 1.0) } else { 0.0 };
        let away: f64 = (0..3).map(|i| (p[i] - a[i] - share * (b[i] - a[i])).powi(2)).sum();
        let height = 1.0 - away / (self.radius * self.radius);
        if height > 0.0 { self.strength * height * height } else { 0.0 }
    }
}

impl Field for Sum {
    fn value(&self, p: [f64; 3]) -> f64 {
        let radius = self.parts.iter().map(|part| part.radius).fold(f64::MAX, f64::min);
        let field: f64 = self.parts.iter().map(|part| part.field(p)).sum();
        (self.threshold - field) * radius / 2.0
    }

    fn corners(&self) -> [[f64; 3]; 2] {
        let around = |sign: f64| {
            [0, 1, 2].map(|i: usize| {
                let ends = self
                    .parts
                    .iter()
                    .flat_map(|part| part.ends.map(|end| sign * end[i] + part.radius));
                sign * ends.fold(f64::MIN, f64::max)
            })
        };
        [around(-1.0), around(1.0)]
    }

    fn plant<S: Scalar>(&self, builder: &mut Builder<S>, map: &Affine<S>) {
        let components: Vec<Metaball<S>> = self
            .parts
            .iter()
            .map(|part| Metaball {
                ends: part.ends.map(vector::<S>),
                radius: S::from_f64(part.radius),
                strength: S::from_f64(part.strength),
            })
            .collect();
        let threshold = S::from_f64(self.threshold);
        builder
            .leaf(Form::Blob { threshold, components: &components }, map, 0)
            .expect("a legal solid");
    }
}

/// A solid of some size, often turned, anywhere near the origin.
fn subject<S: Scalar>(kind: Kind, random: &mut Random) -> Subject<S, Sum> {
    let (scale, reach) = if is_float::<S>() {
        (random.decades(-4.0, 4.0), 3.0)
    } else {
        (random.decades(-0.5, 1.5), 20.0)
    };
    let turned = random.bits() & 1 == 0;
    let turns = [0; 3].map(|_| if turned { random.within(0.0, 360.0) } else { 0.0 });
    let place = random.cube().map(|x| x * scale * reach);
    let mut subject = Subject::new(Sum::new::<S>(kind, random), scale, turns, place);
    subject.field = stored(&subject);
    subject.scale = 1.0;
    subject
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
        assert!(tally.spans > rays / 20, "{name}: {} spans of {rays} rays", tally.spans);
        assert!(f64::from(tally.wrong) <= limit.wrong * f64::from(rays), "{name}: wrong");
        assert!(tally.margin <= limit.margin, "{name}: a margin of {}", tally.margin);
        assert!(tally.geo.max(tally.steep) <= limit.error, "{name}: errors");
    }
}

#[test]
fn every_span_of_f64_is_found() {
    let limit = Limit { wrong: 0.0, margin: 0.0, error: 4e-14 };
    table::<f64>(Aim::Random, rays(80), limit);
    table::<f64>(Aim::Grazing, rays(80), limit);
    table::<f64>(Aim::Far, rays(80), limit);
}

/// A ray that passes within a few ε of the surface may go either way.
#[test]
fn every_span_of_f32_is_found() {
    let limit = Limit { wrong: 0.0, margin: 0.0, error: 1e-5 };
    table::<f32>(Aim::Random, rays(80), limit);
    table::<f32>(Aim::Far, rays(80), limit);
    table::<f32>(Aim::Grazing, rays(100), Limit { wrong: 0.1, margin: 16.0, error: 1e-5 });
}

#[test]
fn fixed_point_is_exact_to_its_steps() {
    let limit = Limit { wrong: 0.01, margin: 1.0, error: 1.0 };
    for aim in [Aim::Random, Aim::Grazing] {
        table::<Q16>(aim, rays(40), limit);
        table::<Q32>(aim, rays(40), limit);
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
                let convex = matches!(kind, Kind::Ball | Kind::Capsule);
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
    starts::<f32>(rays(200));
    starts::<f64>(rays(200));
    starts::<Q16>(rays(40));
    starts::<Q32>(rays(40));
}

/// What is asked for of a part of a ray is what all of it has there, and so is the first boundary.
#[test]
fn parts_of_a_ray_have_the_boundaries_of_the_whole() {
    fn compare<S: Scalar>(rays: u32) {
        let (mut random, mut compared) = (Random::new(12), 0);
        for n in 0..rays {
            let subject = subject::<S>(KINDS[n as usize % KINDS.len()], &mut random);
            let Some(ray) = subject.ray(&mut random, Aim::Random) else { continue };
            let all: Vec<S> = subject.spans(ray, None).into_iter().flatten().collect();
            let Some(&last) = all.last() else { continue };
            let scene = subject.builder.scene().expect("a legal scene");
            for t in [all[0], all[all.len() / 2], last].map(S::next_down) {
                let some = subject.spans_until(ray, t);
                let up_to = |list: &[S]| list.iter().copied().filter(|&end| end <= t).collect();
                let [expected, found]: [Vec<S>; 2] = [up_to(&all), up_to(&some)];
                assert_eq!(expected, found, "up to {t}");
                compared += 1;
            }
            // Without a list, and by one.
            let vacant = nostray::Boundary {
                t: S::ZERO,
                node: 0,
                face: 0,
                passage: nostray::Passage::Touch,
                inverted: false,
            };
            let hit = scene.nearest(ray, &mut [vacant; 64]).expect("room");
            let mut buffer = [vacant; 64];
            let listed = scene.spans(0, ray, &mut buffer).expect("room");
            assert_eq!(hit.map(|hit| hit.boundary), listed.boundaries.first().copied());
        }
        assert!(compared > rays / 3, "{compared} parts");
    }
    compare::<f32>(400);
    compare::<f64>(400);
    compare::<Q16>(60);
    compare::<Q32>(60);
}

#[test]
fn what_is_no_blob_is_refused() {
    fn refused<S: Scalar>(threshold: f64, parts: &[Part]) -> Result<(), String> {
        let component = |part: &Part| Metaball {
            ends: part.ends.map(vector::<S>),
            radius: S::from_f64(part.radius),
            strength: S::from_f64(part.strength),
        };
        let components: Vec<Metaball<S>> = parts.iter().map(component).collect();
        let mut builder = Builder::<S>::new();
        builder.material(nostray::Material::matte(nostray::Rgb::WHITE)).expect("room");
        let form = Form::Blob { threshold: S::from_f64(threshold), components: &components };
        builder.leaf(form, &Affine::identity(), 0).map_err(|error| error.to_string())
    }
    let one = ball([0.0; 3], 1.0, 1.0);
    let nan = f64::NAN;
    // A segment without length is a ball.
    assert_eq!(refused::<f64>(0.5, &[one, ball([1.0, 0.0, 0.0], 1.0, -1.0)]), Ok(()));
    assert_eq!(refused::<Q16>(0.5, &[one]), Ok(()));
    for (result, message) in [
        (refused::<f64>(0.5, &[]), "components has no extent"),
        (refused::<f64>(0.5, &[Part { radius: 0.0, ..one }]), "radius must be greater than 0"),
        (refused::<f64>(0.5, &[Part { radius: -1.0, ..one }]), "radius must be greater than 0"),
        (refused::<f64>(0.5, &[Part { radius: nan, ..one }]), "radius is not a finite number"),
        (refused::<f64>(0.5, &[Part { radius: 1e130, ..one }]), "radius is beyond the range"),
        (refused::<f64>(0.5, &[ball([nan; 3], 1.0, 1.0)]), "components is not a finite number"),
        (refused::<f64>(0.5, &[Part { strength: nan, ..one }]), "strength is not a finite number"),
        (refused::<f64>(0.5, &[Part { strength: 1e130, ..one }]), "strength is beyond the range"),
        (refused::<f64>(0.5, &[Part { strength: -1.0, ..one }]), "strength must be greater than 0"),
        (refused::<f64>(0.0, &[one]), "threshold must be greater than 0"),
        (refused::<f64>(nan, &[one]), "threshold is not a finite number"),
        (refused::<f32>(1e-9, &[one]), "threshold must be large enough"),
        (refused::<Q16>(0.5, &[ball([9000.0, 0.0, 0.0], 1.0, 1.0)]), "center is beyond the range"),
        (refused::<Q32>(0.5, &[Part { radius: 1e9, ..one }]), "radius is beyond the range"),
        // It would not be where it was said to be.
        (
            refused::<f32>(0.5, &[ball([1e4, 0.0, 0.0], 1e-3, 1.0), one]),
            "radius must be greater than 0",
        ),
    ] {
        let found = result.expect_err("a bad solid was taken");
        assert!(found.starts_with(&format!("node 0: {message}")), "{message:?} in {found:?}");
    }
}

#[test]
fn components_add_up() {
    // Half way between two that reach each other's centres: 2·(1 − ¼)².
    let value = |threshold: f64| {
        let parts = [ball([0.0; 3], 1.0, 1.0), ball([1.0, 0.0, 0.0], 1.0, 1.0)];
        Sum { parts: parts.to_vec(), threshold }.value([0.5, 0.0, 0.0])
    };
    assert_eq!(value(1.125), 0.0);
    let hit = |threshold: f64| {
        let parts = vec![ball([0.0; 3], 1.0, 1.0), ball([1.0, 0.0, 0.0], 1.0, 1.0)];
        let subject = Subject::<f64, Sum>::new(Sum { parts, threshold }, 1.0, [0.0; 3], [0.0; 3]);
        let [origin, dir] = [[0.5, -3.0, 0.0], [0.0, 1.0, 0.0]].map(nostray::glam::DVec3::from);
        subject.spans(nostray::Ray { origin, dir }, None).len()
    };
    assert_eq!([hit(1.125 - 1e-12), hit(1.125 + 1e-12)], [1, 0]);
}

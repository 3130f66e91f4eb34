//! The error of the solids' boundaries against exact arithmetic, under stress: rays from up
//! to 10⁷ radii away and more, silhouettes, edges, tiny and huge solids, short and long directions.
//!
//! `cargo test --test solids accuracy -- --nocapture` prints the tables. "wrong" counts decisions
//! (hit or miss) that differ from the exact one; "margin" is how far, in units of
//! ε·size, the solid has to grow or shrink until the exact decision is the same as ours for
//! all rays; "ulp" is the greatest error of t in units in the last place, and "geo" the greatest
//! |t error|·|dir|/size. A chord shorter than that unit is given as one; then only its entry is
//! measured. Solids are exact as the user gave them; a row "stored" takes them from
//! the rounded placement instead.
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

use crate::oracle::subject::{Kind, Plan, ROUND, Subject};
use crate::oracle::table::{Limit, Row, Size, Table};
use crate::oracle::{Float, Path, Random, Real, Solid, along, array, length, point, ulp, vector};
use nostray::{Affine, Axis, Form, Ray, Vector};

/// A ray at a point, from so many sizes away, 10⁻³ to 10³ long.
fn aimed<S: Float>(random: &mut Random, target: [f64; 3], size: f64, distance: f64) -> Ray<S> {
    let dir = random.direction();
    let origin = along(target, -distance * size, dir);
    let speed = random.decades(-3.0, 3.0);
    Ray { origin: vector::<S>(origin), dir: vector::<S>(dir.map(|x| x * speed)) }
}

/// Radii from 10⁻⁴ to 10⁴ and centres within three of them.
fn stand(random: &mut Random) -> (f64, [f64; 3]) {
    let size = random.decades(-4.0, 4.0);
    (size, random.cube().map(|x| x * size * 3.0))
}

/// Rays whose distance from the axis or centre is 1 ± `spread` of what touches, against the
/// given solid and the stored one.
fn silhouette<S: Float>(
    kind: Kind,
    distance: f64,
    rays: u32,
    spread: impl Fn(&mut Random) -> f64,
) -> [Row; 2] {
    let mut random = Random::new(kind as u64 * 1000 + distance.log10() as u64);
    let [mut given, mut stored] = [Row::default(), Row::default()];
    while given.rays < rays {
        let (size, center) = stand(&mut random);
        let plan = Plan::<S>::random(kind, &mut random, size, center);
        let target = along(center, size * 0.9, random.ball());
        let ray = aimed::<S>(&mut random, target, size, distance);
        let touching = plan.exact(&Real::from(1.0)).touching_factor(&Path::of(&ray)).to_f64();
        let factor = touching / (1.0 + spread(&mut random));
        if !(factor > 0.05 && factor < 20.0) {
            continue;
        }
        let subject = plan.build(factor);
        let whole = factor.max(1.0) * subject.size;
        let size = Size { decision: if kind.is_scaled() { factor } else { whole }, whole };
        given.take(&subject, &subject.given, size, ray);
        if subject.place.is_some() {
            stored.take(&subject, &subject.stored, size, ray);
        }
    }
    [given, stored]
}

fn show(table: &mut Table, kind: Kind, what: &str, [given, stored]: &[Row; 2], limit: Limit) {
    given.show(table, &format!("{kind:?}{what}"), limit);
    if stored.rays > 0 {
        stored.show(table, &format!("{kind:?}{what}, stored"), limit);
    }
}

/// How near to a silhouette a decision may be wrong, in ε·size. The direction of an axis and
/// the scales of an ellipsoid are rounded when the scene is built; with half axes of 1 : 1000
/// that weighs more.
fn margin_of(kind: Kind) -> f64 {
    match kind {
        Kind::Sphere | Kind::Cylinder => 1.0,
        Kind::Cone | Kind::Frustum => 2.0,
        Kind::Splinter => 16.0,
        _ => 4.0,
    }
}

fn silhouettes<S: Float>(rays: u32, distances: &[f64]) {
    let mut table = Table::new::<S>("impact R(1 ± 0.01)");
    for kind in ROUND {
        for &distance in distances {
            let rows = silhouette::<S>(kind, distance, rays, |random| random.within(-0.01, 0.01));
            let limit = Limit { margin: margin_of(kind), ulp: f64::INFINITY, geo: f64::INFINITY };
            show(&mut table, kind, &format!(" at {distance:e}"), &rows, limit);
        }
    }
}

fn grazing<S: Float>(rays: u32) {
    let mut table = Table::new::<S>("impact R(1 ± 1e-7..1e-1)");
    for kind in ROUND {
        let rows =
            silhouette::<S>(kind, 10.0, rays, |random| random.decades(-7.0, -1.0) * random.sign());
        let geo = S::EPSILON.to_f64().sqrt() * 4.0;
        show(
            &mut table,
            kind,
            "",
            &rows,
            Limit { margin: margin_of(kind), ulp: f64::INFINITY, geo },
        );
        let most = rays / 50;
        assert!(rows[0].wrong <= most, "{kind:?}: {} of {rays} wrong", rows[0].wrong);
    }
}

/// Rays at a point well inside, from `low` to `high` sizes away.
fn inside<S: Float>(rays: u32, [low, high]: [f64; 2], limit: Limit) {
    let mut table = Table::new::<S>(&format!("well inside, from {low:e} to {high:e}"));
    for kind in ROUND {
        let mut random = Random::new(kind as u64 * 777 + high.log10() as u64);
        let [mut given, mut stored] = [Row::default(), Row::default()];
        while given.rays < rays {
            let (size, center) = stand(&mut random);
            let subject = Plan::<S>::random(kind, &mut random, size, center).build(1.0);
            let target =
                along(center, size * if kind.is_scaled() { 1e-3 } else { 0.2 }, random.ball());
            let away = random.decades(low.log10(), high.log10());
            let ray = aimed::<S>(&mut random, target, size, away);
            let size = Size { decision: size, whole: size };
            given.take(&subject, &subject.given, size, ray);
            if subject.place.is_some() {
                stored.take(&subject, &subject.stored, size, ray);
            }
        }
        show(&mut table, kind, "", &[given, stored], limit);
    }
}

#[test]
fn silhouettes_f32() {
    silhouettes::<f32>(1500, &[1e1, 1e3, 1e5, 1e7]);
    grazing::<f32>(3000);
}

#[test]
fn silhouettes_f64() {
    silhouettes::<f64>(300, &[1e1, 1e7, 1e14]);
    grazing::<f64>(500);
}

#[test]
fn boundaries_f32() {
    let near = Limit { margin: 4.0, ulp: f64::INFINITY, geo: 1e-5 };
    inside::<f32>(2000, [0.01, 100.0], near);
    inside::<f32>(2000, [1e4, 1e7], Limit { margin: 4.0, ulp: 0.6, geo: f64::INFINITY });
}

#[test]
fn boundaries_f64() {
    let near = Limit { margin: 4.0, ulp: f64::INFINITY, geo: 2e-14 };
    inside::<f64>(500, [0.01, 100.0], near);
    inside::<f64>(500, [1e4, 1e14], Limit { margin: 4.0, ulp: 0.6, geo: f64::INFINITY });
}

/// The ways in which a ray is laid at a box.
#[derive(Clone, Copy, Debug)]
enum Aim {
    Inside,
    Far,
    /// Along one axis, often in the plane of a side.
    Parallel,
    /// In the plane of a side, otherwise oblique.
    InFace,
    /// At a point of an edge, rounded.
    Edge,
    /// Through a point of an edge or a corner, exactly.
    ExactEdge,
}

/// A ray of that kind; coordinates of `ExactEdge` are small whole numbers and their halves.
fn at_box<S: Float>(random: &mut Random, aim: Aim, min: S::Vec3, max: S::Vec3) -> Ray<S> {
    let (low, high) = (array::<S>(min), array::<S>(max));
    let size = length(along(high, -1.0, low));
    let corner = [0, 1, 2].map(|i| if random.bits() & 1 == 0 { low[i] } else { high[i] });
    let middle = [0, 1, 2].map(|i| random.within(low[i], high[i]));
    let axis = random.below(3);
    let on_edge = [0, 1, 2].map(|i| if i == axis { middle[i] } else { corner[i] });
    let place = |v: [f64; 3]| vector::<S>(v);
    let mut ray = aimed::<S>(random, middle, size, 2.0);
    match aim {
        Aim::Inside => {}
        Aim::Far => {
            let distance = random.decades(1.0, 7.0);
            ray = aimed::<S>(random, middle, size, distance);
        }
        Aim::Parallel => {
            let pick =
                [0, 1, 2].map(|i| if random.bits() & 1 == 0 { middle[i] } else { corner[i] });
            let step = [0, 1, 2].map(|i| if i == axis { random.sign() } else { 0.0 });
            ray.origin = place(along(pick, -size, step));
            ray.dir = place(step);
            let side = place(pick).to_array();
            let origin = ray.origin.to_array();
            let exact = [0, 1, 2].map(|i| if i == axis { origin[i] } else { side[i] });
            ray.origin = S::Vec3::from_array(exact);
        }
        Aim::InFace => {
            let (mut origin, mut dir) = (array::<S>(ray.origin), array::<S>(ray.dir));
            (origin[axis], dir[axis]) = (corner[axis], 0.0);
            (ray.origin, ray.dir) = (place(origin), place(dir));
        }
        Aim::Edge => ray = aimed::<S>(random, on_edge, size, 3.0),
        Aim::ExactEdge => {
            let whole = |random: &mut Random| random.below(41) as f64 - 20.0;
            let dir = [0; 3].map(|_| whole(random) / 4.0);
            let target = on_edge.map(|x| (x * 2.0).round() / 2.0);
            ray.origin = place(along(target, -whole(random), dir));
            ray.dir = if dir == [0.0; 3] { ray.dir } else { place(dir) };
        }
    }
    ray
}

fn boxes<S: Float>(rays: u32) {
    let mut table = Table::new::<S>("box");
    for aim in [Aim::Inside, Aim::Far, Aim::Parallel, Aim::InFace, Aim::Edge, Aim::ExactEdge] {
        let mut random = Random::new(aim as u64);
        let mut row = Row::default();
        while row.rays < rays {
            let (size, center) = match aim {
                Aim::ExactEdge => (4.0, [0.0; 3]),
                _ => stand(&mut random),
            };
            let half = [0; 3].map(|_| match aim {
                Aim::ExactEdge => 1.0 + random.below(8) as f64,
                _ => size * random.within(0.1, 1.0),
            });
            let (min, max) =
                (vector::<S>(along(center, -1.0, half)), vector::<S>(along(center, 1.0, half)));
            let given = Solid::Cuboid { min: point::<S>(min), max: point::<S>(max) };
            let subject = Subject::new(Form::Box { min, max }, &Affine::identity(), given, size);
            let ray = at_box::<S>(&mut random, aim, min, max);
            row.take(&subject, &subject.given, Size { decision: size, whole: size }, ray);
        }
        row.show(
            &mut table,
            &format!("{aim:?}"),
            Limit { margin: 0.0, ulp: 2.0, geo: f64::INFINITY },
        );
        assert_eq!(row.wrong, 0, "{aim:?}");
    }
}

#[test]
fn boxes_f32() {
    boxes::<f32>(5000);
}

#[test]
fn boxes_f64() {
    boxes::<f64>(2000);
}

fn turned_boxes<S: Float>(rays: u32) {
    let mut table = Table::new::<S>("box, turned");
    let mut random = Random::new(5);
    let [mut given, mut stored] = [Row::default(), Row::default()];
    while given.rays < rays {
        let (size, center) = stand(&mut random);
        let mut map = Affine::<S>::identity();
        for axis in Axis::ALL {
            map = map.then(&Affine::rotate(axis, S::from_f64(random.within(0.0, 360.0))));
        }
        let map = map.then(&Affine::translate(vector::<S>(center)));
        let half = vector::<S>([0; 3].map(|_| size * random.within(0.1, 1.0)));
        let exact = Solid::Placed {
            rows: crate::oracle::inverse_rows(&map),
            offset: point::<S>(map.offset),
            inside: Box::new(Solid::Cuboid { min: point::<S>(-half), max: point::<S>(half) }),
        };
        let subject = Subject::new(Form::Box { min: -half, max: half }, &map, exact, size);
        let target = along(center, size * 0.7, random.ball());
        let distance = random.decades(0.0, 2.0);
        let ray = aimed::<S>(&mut random, target, size, distance);
        let size = Size { decision: size, whole: size };
        given.take(&subject, &subject.given, size, ray);
        stored.take(&subject, &subject.stored, size, ray);
    }
    let limit = Limit { margin: 4.0, ulp: f64::INFINITY, geo: f64::INFINITY };
    given.show(&mut table, "turned", limit);
    stored.show(&mut table, "turned, stored", limit);
}

#[test]
fn boxes_turned() {
    turned_boxes::<f32>(5000);
    turned_boxes::<f64>(1000);
}

/// The error of a plane in units of its bound, ulp(t) + 2·ε·reach/|n·d| with the reach of
/// the point hit and of the plane itself.
fn planes<S: Float>(rays: u32, oblique: bool) {
    let mut random = Random::new(6);
    let (mut most, mut hits) = (0.0_f64, 0);
    for _ in 0..rays {
        let size = random.decades(-4.0, 4.0);
        let mut normal = random.direction().map(|x| x * 2.0);
        if !oblique {
            normal = [0.0, random.within(0.5, 2.0), 0.0];
        }
        let (normal, offset) = (vector::<S>(normal), S::from_f64(size * random.within(-3.0, 3.0)));
        let given = Solid::Half { normal: point::<S>(normal), offset: Real::of(offset) };
        let subject =
            Subject::new(Form::Plane { normal, offset }, &Affine::identity(), given, size);
        let (target, distance) = (random.ball().map(|x| x * size), random.decades(0.0, 7.0));
        let mut ray = aimed::<S>(&mut random, target, size, distance);
        if random.bits() & 3 == 0 {
            // Nearly in the plane.
            let (n, d) = (array::<S>(normal), array::<S>(ray.dir));
            let (speed, square) = ([0, 1, 2].map(|i| n[i] * d[i]).iter().sum::<f64>(), length(n));
            let rest = 1.0 - random.decades(-4.0, 0.0);
            ray.dir = vector::<S>(along(d, -rest * speed / (square * square), n));
        }
        let path = Path::of(&ray);
        let truth = subject.given.span(&path, &Real::from(0.0)).expect("never parallel");
        let found = subject.span(ray).expect("never parallel");
        for (t, exact) in found.into_iter().zip(&truth) {
            let rounded = exact.to_f64();
            if rounded.abs() > 1e300 {
                assert_eq!(t, rounded.signum() * f64::INFINITY);
                continue;
            }
            let hit = along(array::<S>(ray.origin), rounded, array::<S>(ray.dir));
            let height = crate::oracle::dot(&path.dir, &point::<S>(normal)).abs().to_f64();
            let n = length(array::<S>(normal));
            let reach = length(hit) * n + offset.to_f64().abs();
            let bound = ulp::<S>(rounded) + 2.0 * S::EPSILON.to_f64() * reach / height;
            let error = (Real::from(t) - exact).abs().to_f64();
            most = most.max(error / bound);
            hits += 1;
        }
    }
    println!("{}: plane, oblique {oblique}: {most:.3} of its bound", S::NAME);
    assert_eq!(hits, rays);
    assert!(most <= 1.0, "{most} of the bound");
}

#[test]
fn plane_errors() {
    for oblique in [false, true] {
        planes::<f32>(10_000, oblique);
        planes::<f64>(3_000, oblique);
    }
}

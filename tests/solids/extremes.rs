//! Every legal solid and ray gives finite or infinite numbers, never something that is not a
//! number, and the right decision where exact arithmetic leaves no doubt: rays along axes,
//! through tips, in the planes of caps and sides, with vanishing components.
//!
//! On a boundary the convention is: a ray in a flat face is inside, one that touches a curved
//! side or an edge is outside.
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

use crate::oracle::subject::Subject;
use crate::oracle::{Float, Path, Random, Real, Solid, along, array, length, point, vector};
use nostray::{Affine, Form, Ray, Shape};

fn ray<S: Float>(origin: [f64; 3], dir: [f64; 3]) -> Ray<S> {
    Ray { origin: vector::<S>(origin), dir: vector::<S>(dir) }
}

/// A cylinder or frustum between (0, −h, 0) and (0, h, 0).
fn upright<S: Float>([base, top]: [f64; 2], half: f64) -> Subject<S> {
    let [base_radius, top_radius] = [base, top].map(S::from_f64);
    let ends = [[0.0, -half, 0.0], [0.0, half, 0.0]].map(vector::<S>);
    let form = if base == top && base != 3.0 {
        Form::Cylinder { base: ends[0], top: ends[1], radius: base_radius }
    } else {
        Form::Cone { base: ends[0], base_radius, top: ends[1], top_radius }
    };
    let radii = [base_radius, top_radius].map(Real::of);
    let given = Solid::Tube { ends: ends.map(point::<S>), radii };
    Subject::new(form, &Affine::identity(), given, base.max(top).max(half))
}

fn cuboid<S: Float>(min: [f64; 3], max: [f64; 3]) -> Subject<S> {
    let [min, max] = [min, max].map(vector::<S>);
    let given = Solid::Cuboid { min: point::<S>(min), max: point::<S>(max) };
    let size = length(array::<S>(max - min));
    Subject::new(Form::Box { min, max }, &Affine::identity(), given, size)
}

fn sphere<S: Float>(radius: f64) -> Subject<S> {
    let (center, radius) = (vector::<S>([0.0; 3]), S::from_f64(radius));
    let given = Solid::Ball { center: point::<S>(center), radius: Real::of(radius) };
    Subject::new(Form::Sphere { center, radius }, &Affine::identity(), given, radius.to_f64())
}

/// The span is the exact one up to `tolerance` sizes.
fn agrees<S: Float>(subject: &Subject<S>, ray: Ray<S>, tolerance: f64) {
    let truth = subject.given.span(&Path::of(&ray), &Real::from(0.0));
    let truth = truth.map(|ends| ends.map(|t| t.to_f64()));
    let found = subject.span(ray);
    let what = format!("{:?} {ray:?}: {found:?} for {truth:?}", subject.shape);
    let (Some(found), Some(truth)) = (found, truth) else {
        assert!(found.is_none() && truth.is_none(), "{what}");
        return;
    };
    let speed = length(array::<S>(ray.dir));
    for (t, exact) in found.into_iter().zip(truth) {
        if exact.abs() > 1e300 {
            assert_eq!(t, exact.signum() * f64::INFINITY, "{what}");
        } else {
            let reach = subject.size + exact.abs() * speed;
            assert!((t - exact).abs() * speed <= tolerance * reach, "{what}");
        }
    }
}

/// Rays whose numbers are such that nothing has to be rounded: decisions are exact.
fn exact_cases<S: Float>() {
    let tolerance = S::EPSILON.to_f64() * 8.0;
    let tubes = [[2.0, 2.0], [3.0, 3.0], [2.0, 0.0], [0.0, 2.0], [2.0, 1.0], [1.0, 2.0]];
    let values = [-2.0, -1.0, -0.0, 0.0, 1.0, 2.0, 3.0];
    let mut subjects: Vec<_> = tubes.map(|radii| upright::<S>(radii, 2.0)).into();
    subjects.push(sphere(2.0));
    subjects.push(cuboid([-2.0, -1.0, -2.0], [2.0, 2.0, 1.0]));
    for subject in &subjects {
        for x in values {
            for y in values {
                for z in [-1.0, 0.0, 2.0] {
                    for dir in 1..27 {
                        let dir = [dir % 3, dir / 3 % 3, dir / 9].map(|i| [0.0, 1.0, -1.0][i]);
                        let flat = matches!(subject.shape, Shape::Box(_));
                        if !flat && dir.iter().all(|&v| v != 0.0) {
                            // A third has to be rounded.
                            continue;
                        }
                        agrees(subject, ray([x, y, z], dir), tolerance);
                        agrees(subject, ray([x, y, z], dir.map(|v| v * -0.25)), tolerance);
                    }
                }
            }
        }
    }
}

#[test]
fn rays_on_boundaries_are_decided_exactly() {
    exact_cases::<f32>();
    exact_cases::<f64>();
}

#[test]
fn vanishing_components_count_as_parallel() {
    let denormal = f64::from(f32::from_bits(1));
    for tiny in [denormal, -denormal, 1e-39, -1e-39] {
        let block = cuboid::<f32>([-1.0; 3], [1.0; 3]);
        for x in [-1.0, 0.0, 1.0] {
            assert_eq!(block.span(ray([x, 0.0, 5.0], [tiny, 0.0, -1.0])), Some([4.0, 6.0]));
            assert_eq!(block.span(ray([x, 5.0, x], [tiny, -1.0, tiny])), Some([4.0, 6.0]));
        }
        assert_eq!(block.span(ray([1.5, 0.0, 5.0], [tiny, 0.0, -1.0])), None);
        for radii in [[1.0, 1.0], [3.0, 3.0], [1.0, 0.0], [0.0, 1.0]] {
            let tube = upright::<f32>(radii, 1.0);
            for y in [-1.0, 0.0] {
                agrees(&tube, ray([0.25, y, 5.0], [0.0, 0.0, -1.0]), 1e-6);
                let [t, _] = tube.span(ray([0.25, y, 5.0], [tiny, tiny, -1.0])).unwrap_or([0.0; 2]);
                assert!(t < 5.0);
            }
            let [enter, exit] = tube.span(ray([0.25, 5.0, 0.0], [tiny, -1.0, 0.0])).expect("a hit");
            assert!(enter < exit && enter >= 4.0 && exit <= 6.0);
        }
        let plane: Form<'_, f32> =
            Form::Plane { normal: vector::<f32>([0.0, 1.0, 0.0]), offset: 1.0 };
        let normal = [0.0, 1.0, 0.0].map(Real::from);
        let half = Solid::Half { normal, offset: Real::from(1.0) };
        let plane = Subject::<f32>::new(plane, &Affine::identity(), half, 1.0);
        let whole = Some([f64::NEG_INFINITY, f64::INFINITY]);
        assert_eq!(plane.span(ray([0.0, 1.0, 0.0], [1.0, tiny, 0.0])), whole);
        assert_eq!(plane.span(ray([0.0, 2.0, 0.0], [1.0, tiny, 0.0])), None);
    }
}

/// Close to the tip of a cone the error follows the distance from the tip.
fn tips<S: Float>() {
    let mut random = Random::new(8);
    let eps = S::EPSILON.to_f64();
    let mut errors = Vec::new();
    for n in 0..4000 {
        let radii = if n % 2 == 0 { [1.0, 0.0] } else { [0.0, 1.0] };
        let half = random.decades(-1.0, 1.0);
        let cone = upright::<S>(radii, half);
        let tip = [0.0, if n % 2 == 0 { half } else { -half }, 0.0];
        let target = along(tip, random.decades(-9.0, -2.0), random.direction());
        let dir = random.direction();
        let ray = ray::<S>(along(target, -3.0, dir), dir);
        let path = Path::of(&ray);
        let truth = cone.given.span(&path, &Real::from(0.0));
        let found = cone.span(ray);
        if found.is_some() != truth.is_some() {
            let grow = if found.is_some() { 16.0 * eps } else { -16.0 * eps };
            let doubtful = cone.given.span(&path, &Real::from(grow)).is_some();
            assert_eq!(doubtful, found.is_some(), "{ray:?}");
        } else if let (Some(found), Some(truth)) = (found, truth) {
            for (t, exact) in found.into_iter().zip(truth) {
                errors.push((t - exact.to_f64()).abs() / eps);
            }
        }
    }
    errors.sort_by(f64::total_cmp);
    let [most, all] = [errors[errors.len() * 99 / 100], errors[errors.len() - 1]];
    println!("{}: near a tip {most:.1} ε at p99, {all:.1} ε at most", S::NAME);
    // Few rays are nearly parallel to the side.
    assert!(most < 32.0 && all < 1e4, "{most} ε, {all} ε");
}

#[test]
fn tips_are_sharp() {
    tips::<f32>();
    tips::<f64>();
}

/// The least and the greatest legal lengths, in every combination.
fn limits<S: Float>() {
    let mut random = Random::new(9);
    let (least, most) = (S::LENGTH_MIN.to_f64(), S::COORD_MAX.to_f64());
    let lengths = [least, most, 1.0];
    let mut spans = 0;
    for radius in lengths {
        let mut subjects = vec![sphere::<S>(radius)];
        for half in lengths {
            // A cone must not be flatter than its number format can tell.
            let legal = half >= radius * S::EPSILON.to_f64();
            let half = (half * 0.5).max(least);
            subjects.push(upright::<S>([radius; 2], half));
            if legal {
                subjects.push(upright::<S>([radius, 0.0], half));
                subjects.push(upright::<S>([0.0, radius], half));
                subjects.push(upright::<S>([radius, (radius * 0.5).max(least)], half));
            }
            subjects.push(cuboid::<S>([-radius, -half, -radius], [radius, half, radius]));
        }
        for subject in &subjects {
            for _ in 0..300 {
                let away = [least, 1.0, most][random.below(3)];
                let origin = random.cube().map(|x| x * away);
                let mut dir = if random.bits() & 1 == 0 {
                    random.direction()
                } else {
                    along([0.0; 3], -1.0 / away, origin)
                };
                if random.bits() & 3 == 0 {
                    dir[random.below(3)] = 0.0;
                }
                if dir == [0.0; 3] {
                    continue;
                }
                if let Some([enter, exit]) = subject.span(ray(origin, dir)) {
                    assert!(!enter.is_nan() && !exit.is_nan() && enter <= exit);
                    spans += 1;
                }
            }
        }
    }
    assert!(spans > 1000, "{spans} spans");
}

#[test]
fn lengths_at_their_limits() {
    limits::<f32>();
    limits::<f64>();
}

/// The smallest and the largest solids are as exact as any.
fn scales<S: Float>() {
    let mut random = Random::new(10);
    for size in [S::LENGTH_MIN.to_f64(), S::COORD_MAX.to_f64()] {
        let subjects = [
            sphere::<S>(size),
            upright::<S>([size; 2], size),
            upright::<S>([size, 0.0], size),
            upright::<S>([(0.5 * size).max(S::LENGTH_MIN.to_f64()), size], size),
            cuboid::<S>([-size; 3], [size; 3]),
        ];
        for subject in &subjects {
            for _ in 0..200 {
                let target = random.ball().map(|x| x * size * 0.3);
                let dir = random.direction();
                let origin = along(target, -5.0 * size, dir);
                let speed = random.decades(-3.0, 3.0);
                let dir = dir.map(|x| x * speed);
                assert!(
                    subject.span(ray(origin, dir)).is_some(),
                    "{:?} {origin:?} {dir:?}",
                    subject.shape
                );
                agrees(subject, ray(origin, dir), S::EPSILON.to_f64() * 8.0);
            }
        }
    }
}

#[test]
fn errors_do_not_depend_on_scale() {
    scales::<f32>();
    scales::<f64>();
}

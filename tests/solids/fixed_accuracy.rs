//! Intersections in fixed point against exact arithmetic, over the legal range: errors in steps of
//! the format, and decisions that are wrong farther than one step from the silhouette.
//!
//! `cargo test --test solids fixed_accuracy -- --nocapture` prints the table.
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

use crate::oracle::{Path, Point, Random, Real, Solid, along};
use nostray::ray::{Line, Start};
use nostray::shape::{Sight, Tables};
use nostray::{
    Affine, Boundary, Fixed, Form, Material, Passage, Plane, Q16, Q32, Ray, Real as _, Rgb, Scalar,
    SceneBuilder, Shape, Vector,
};

/// A format in fixed point, with the exact value of its numbers.
trait Exact: Scalar {
    /// One over the step.
    const STEPS: f64;
    fn real(self) -> Real;
    fn real_unit(unit: Self::Unit) -> Real;
}

/// `bits · 2^−fraction`, which f64 could not hold in one piece.
fn exact(bits: i64, fraction: i32) -> Real {
    let (high, low) = ((bits >> 32) as f64, (bits & 0xffff_ffff) as f64);
    (Real::from(high) * Real::from(4_294_967_296.0) + Real::from(low))
        / Real::from(f64::powi(2.0, fraction))
}

impl Exact for Q16 {
    const STEPS: f64 = 65_536.0;
    fn real(self) -> Real {
        exact(self.to_bits().into(), 16)
    }
    fn real_unit(unit: Self::Unit) -> Real {
        exact(unit.to_bits().into(), 30)
    }
}

impl Exact for Q32 {
    const STEPS: f64 = 4_294_967_296.0;
    fn real(self) -> Real {
        exact(self.to_bits(), 32)
    }
    fn real_unit(unit: Self::Unit) -> Real {
        exact(unit.to_bits(), 62)
    }
}

fn vector<S: Scalar>(v: [f64; 3]) -> S::Vec3 {
    S::Vec3::from_array(v.map(S::from_f64))
}

fn point<S: Exact>(v: S::Vec3) -> Point {
    v.to_array().map(S::real)
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Sphere,
    Box,
    Plane,
    Cylinder,
    Cone,
    Frustum,
}

/// A solid in fixed point beside its exact twin.
struct Subject<S: Exact> {
    builder: SceneBuilder<S, Fixed<1, 1, 1, 1>>,
    solid: Solid,
}

impl<S: Exact> Subject<S> {
    fn new(kind: Kind, random: &mut Random, center: [f64; 3], size: f64) -> Self {
        let middle = vector::<S>(center);
        let [a, b, c] = [0; 3].map(|_| S::from_f64(size * random.within(0.2, 1.0)));
        let up = S::Vec3::new(S::ZERO, b, S::ZERO);
        let (base, top) = (middle - up, middle + up);
        let ends = [point::<S>(base), point::<S>(top)];
        let tip = if kind == Kind::Cone { S::ZERO } else { c };
        let (form, solid) = match kind {
            Kind::Sphere => (
                Form::Sphere { center: middle, radius: a },
                Solid::Ball { center: point::<S>(middle), radius: a.real() },
            ),
            Kind::Box => {
                let half = S::Vec3::new(a, b, c);
                let (min, max) = (middle - half, middle + half);
                (
                    Form::Box { min, max },
                    Solid::Cuboid { min: point::<S>(min), max: point::<S>(max) },
                )
            }
            Kind::Plane => {
                let normal = vector::<S>(random.direction());
                let offset = S::from_f64(random.within(-1.0, 1.0) * size);
                // The exact twin is taken from what is stored, below.
                (
                    Form::Plane { normal, offset },
                    Solid::Half { normal: ends[0].clone(), offset: a.real() },
                )
            }
            Kind::Cylinder => (
                Form::Cylinder { base, top, radius: a },
                Solid::Tube { ends, radii: [a.real(), a.real()] },
            ),
            Kind::Cone | Kind::Frustum => (
                Form::Cone { base, base_radius: a, top, top_radius: tip },
                Solid::Tube { ends, radii: [a.real(), tip.real()] },
            ),
        };
        let mut builder = SceneBuilder::new();
        let material = builder.material(Material::matte(Rgb::WHITE)).expect("room");
        builder.leaf(form, &Affine::identity(), material).expect("a legal solid");
        let scene = builder.scene().expect("a legal scene");
        let solid = match scene.parts().nodes.first() {
            Some(nostray::Node::Leaf(nostray::Leaf { shape: Shape::Plane(plane), .. })) => {
                let Plane { normal, offset } = *plane;
                let normal = normal.to_array().map(S::real_unit);
                Solid::Half { normal, offset: offset.real() }
            }
            _ => solid,
        };
        Self { builder, solid }
    }

    /// The boundaries ahead.
    fn ends(&self, ray: Ray<S>) -> (bool, Vec<S>) {
        let vacant =
            Boundary { t: S::ZERO, node: 0, face: 0, passage: Passage::Touch, inverted: false };
        let mut buffer = [vacant; 2];
        let scene = self.builder.scene().expect("a legal scene");
        let spans = scene.spans(0, ray, &mut buffer).expect("room");
        (spans.inside, spans.boundaries.iter().map(|b| b.t).collect())
    }
}

/// A ray towards the solid from as far as the format allows; half of them graze it.
fn ray<S: Exact>(random: &mut Random, center: [f64; 3], size: f64, reach: f64) -> Ray<S> {
    let limit = S::COORD_MAX.to_f64();
    let away = size * random.decades(-1.0, f64::log10(reach / size).max(-0.9));
    let origin = along(center, away, random.direction()).map(|x| x.clamp(-limit, limit));
    let aim = if random.bits() & 1 == 0 { random.ball() } else { random.direction() };
    let target = along(center, size * (1.0 + random.decades(-7.0, -0.5) * random.sign()), aim);
    let wide = along(target, -1.0, origin).map(S::Wide::from_f64);
    Ray { origin: vector::<S>(origin), dir: S::steer(S::WideVec::from_array(wide)).0 }
}

/// The worst error in steps, the hits, and how many decisions were wrong beyond one step.
fn measure<S: Exact>(kind: Kind, rays: u32) -> (f64, u32, u32) {
    let mut random = Random::new(7);
    let limit = S::COORD_MAX.to_f64();
    let (mut worst, mut hits, mut wrong) = (0.0_f64, 0, 0);
    for _ in 0..rays / 8 {
        let size = random.decades(-2.5, f64::log10(limit) - 1.0);
        let center = random.cube().map(|x| x * limit * 0.5 * random.decades(-3.0, 0.0));
        let subject = Subject::<S>::new(kind, &mut random, center, size);
        for _ in 0..8 {
            let ray = ray::<S>(&mut random, center, size, limit);
            let dir = ray.dir.to_array().map(S::real_unit);
            let path = Path { origin: point::<S>(ray.origin), dir };
            let (inside, found) = subject.ends(ray);
            let ahead = |grow: f64| -> (bool, Vec<Real>) {
                let span = subject.solid.span(&path, &Real::from(grow / S::STEPS));
                let beyond = |t: &&Real| t.sign() > 0 && t.to_f64() < S::FAR.to_f64();
                let inside = span.as_ref().is_some_and(|[a, b]| a.sign() <= 0 && b.sign() > 0);
                (inside, span.iter().flatten().filter(beyond).cloned().collect())
            };
            let (truly, exact) = ahead(0.0);
            if found.len() == exact.len() && inside == truly {
                hits += u32::from(!exact.is_empty());
                for (t, exact) in found.iter().zip(&exact) {
                    let error = (t.real() - exact).abs().to_f64() * S::STEPS;
                    worst = worst.max(error);
                }
            } else {
                let explained = [-1.0, 1.0].into_iter().any(|grow| {
                    let (truly, exact) = ahead(grow);
                    found.len() == exact.len() && inside == truly
                });
                wrong += u32::from(!explained);
            }
        }
    }
    (worst, hits, wrong)
}

fn table<S: Exact>(rays: u32) {
    for (kind, limit) in [
        (Kind::Sphere, 1.0),
        (Kind::Box, 2.0),
        (Kind::Plane, 2.0),
        (Kind::Cylinder, 4.0),
        (Kind::Cone, 4.0),
        (Kind::Frustum, 4.0),
    ] {
        let (worst, hits, wrong) = measure::<S>(kind, rays);
        let name = format!("{kind:?}");
        println!("{} {name:10} {rays} rays, {hits} hits: {worst:.3} steps, {wrong} wrong", S::NAME);
        assert!(hits > rays / 5, "{name}: {hits} hits of {rays}");
        assert!(worst <= limit, "{} {name}: {worst} steps", S::NAME);
        assert_eq!(wrong, 0, "{} {name}: wrong beyond one step of the silhouette", S::NAME);
    }
}

#[test]
fn q16_is_exact_to_its_steps() {
    table::<Q16>(20_000);
}

#[test]
fn q32_is_exact_to_its_steps() {
    table::<Q32>(20_000);
}

/// A ray from a surface inward ends on the solid's far side, one outward never meets it again.
fn secondary<S: Exact>(kind: Kind, rays: u32) {
    let mut random = Random::new(11);
    let limit = S::COORD_MAX.to_f64();
    let mut started = 0;
    for _ in 0..rays {
        let size = random.decades(-2.0, f64::log10(limit) - 1.0);
        let center = random.cube().map(|x| x * limit * 0.5 * random.decades(-3.0, 0.0));
        let subject = Subject::<S>::new(kind, &mut random, center, size);
        let scene = subject.builder.scene().expect("a legal scene");
        let Some(&nostray::Node::Leaf(leaf)) = scene.parts().nodes.first() else {
            panic!("one leaf");
        };
        let vacant =
            Boundary { t: S::ZERO, node: 0, face: 0, passage: Passage::Touch, inverted: false };
        let ray = ray::<S>(&mut random, center, size, limit);
        let Some(hit) = scene.nearest(ray, &mut [vacant; 2]).expect("room") else {
            continue;
        };
        started += 1;
        let contact = scene.contact(ray, &hit).expect("of this scene");
        let normal = contact.normal.to_array().map(|n| S::widen_unit(n).to_f64());
        for inward in [true, false] {
            // Anywhere on one side, often along the surface.
            let lift = if inward { -1.0 } else { 1.0 } * random.decades(-6.0, 0.5);
            let aside = random.direction();
            let along_normal: f64 = (0..3).map(|i| aside[i] * normal[i]).sum();
            let dir = [0, 1, 2].map(|i| aside[i] + normal[i] * (lift - along_normal));
            let dir = S::unit(S::WideVec::from_array(dir.map(S::Wide::from_f64)));
            let face = hit.boundary.face;
            let start = Start { node: 0, face, inward, local: contact.local };
            let line = Line::new(Ray { origin: contact.position, dir }, Some(start));
            let start = line.start.as_ref();
            let place = None;
            let mut spans = Vec::new();
            let sight = Sight { line: &line, place, start, tables: &Tables::EMPTY };
            leaf.shape.spans(&sight, |span| spans.push((span.enter.t, span.exit.t)));
            match (inward, &spans[..]) {
                (false, []) => {}
                (true, [(enter, exit)]) => {
                    assert!(*enter == S::ZERO && *exit > S::ZERO, "{kind:?}: {spans:?}");
                }
                _ => panic!("{} {kind:?}, inward {inward}: {spans:?}", S::NAME),
            }
        }
    }
    assert!(started > rays / 5, "{kind:?}: {started} hits");
}

#[test]
fn no_ray_meets_the_surface_it_starts_on_and_none_loses_the_far_side() {
    for kind in [Kind::Sphere, Kind::Box, Kind::Plane, Kind::Cylinder, Kind::Cone, Kind::Frustum] {
        secondary::<Q16>(kind, 20_000);
        secondary::<Q32>(kind, 20_000);
    }
}

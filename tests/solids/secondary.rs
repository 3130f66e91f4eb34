//! Rays that start on a surface: they never meet that surface again by rounding, and never
//! lose the far side of the solid; where they leave it is as exact as the start.
//!
//! `cargo test --test solids secondary -- --nocapture` prints the errors.
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

use crate::oracle::subject::{Kind, Plan, Subject};
use crate::oracle::{
    Float, Path, Random, Real, Solid, along, array, inverse_rows, length, point, vector,
};
use nostray::ray::Start;
use nostray::{Affine, Axis, Boundary, Form, Passage, Ray, Shape, Tables, Vector};

#[derive(Clone, Copy, Debug)]
enum Body {
    Round(Kind),
    Box,
    TurnedBox,
    Plane,
}

const BODIES: [Body; 11] = [
    Body::Round(Kind::Sphere),
    Body::Round(Kind::Ellipsoid),
    Body::Round(Kind::Cylinder),
    Body::Round(Kind::OrientedCylinder),
    Body::Round(Kind::Cone),
    Body::Round(Kind::OrientedCone),
    Body::Round(Kind::Frustum),
    Body::Round(Kind::OrientedFrustum),
    Body::Box,
    Body::TurnedBox,
    Body::Plane,
];

fn subject<S: Float>(body: Body, random: &mut Random) -> Subject<S> {
    let size = random.decades(-4.0, 4.0);
    let center = random.cube().map(|x| x * size * 3.0);
    match body {
        Body::Round(kind) => Plan::<S>::random(kind, random, size, center).build(1.0),
        Body::Box | Body::TurnedBox => {
            let half = vector::<S>([0; 3].map(|_| size * random.within(0.1, 1.0)));
            let mut map = Affine::identity();
            if matches!(body, Body::TurnedBox) {
                for axis in Axis::ALL {
                    let degrees = S::from_f64(random.within(0.0, 360.0));
                    map = map.then(&Affine::rotate(axis, degrees));
                }
                map = map.then(&Affine::translate(vector::<S>(center)));
            }
            let given = Solid::Placed {
                rows: inverse_rows(&map),
                offset: point::<S>(map.offset),
                inside: Box::new(Solid::Cuboid { min: point::<S>(-half), max: point::<S>(half) }),
            };
            Subject::new(Form::Box { min: -half, max: half }, &map, given, size)
        }
        Body::Plane => {
            let normal = vector::<S>(random.direction());
            let offset = S::from_f64(size * random.within(-1.0, 1.0));
            let given = Solid::Half { normal: point::<S>(normal), offset: Real::of(offset) };
            Subject::new(Form::Plane { normal, offset }, &Affine::identity(), given, size)
        }
    }
}

/// A point of a surface.
struct Contact<S: Float> {
    face: u32,
    local: S::Vec3,
    position: S::Vec3,
    normal: S::Vec3,
}

impl<S: Float> Contact<S> {
    fn at(subject: &Subject<S>, near: S::Vec3, face: u32) -> Self {
        let local = subject.shape.snap(near, face, &Tables::EMPTY);
        let normal = subject.shape.normal(local, face, &Tables::EMPTY);
        let (position, normal) = match &subject.place {
            Some(place) => (place.point(local), place.normal(normal)),
            None => (local + subject.shape.centre(), normal),
        };
        Self { face, local, position, normal: normal.normalize() }
    }

    /// Where a random ray from outside or inside meets the solid.
    fn hit(subject: &Subject<S>, random: &mut Random) -> Option<Self> {
        let center = match &subject.place {
            Some(place) => place.anchor,
            None => subject.shape.centre(),
        };
        let near = |by: f64, random: &mut Random| {
            along(array::<S>(center), subject.size * by, random.ball())
        };
        let (origin, target) = (near(4.0, random), near(0.8, random));
        let dir = along(target, -1.0, origin);
        let dir = vector::<S>(dir.map(|x| x / length(dir)));
        let ray = Ray { origin: vector::<S>(origin), dir };
        let scene = subject.builder.scene().expect("a legal scene");
        let vacant =
            Boundary { t: S::ZERO, node: 0, face: 0, passage: Passage::Touch, inverted: false };
        let hit = scene.nearest(ray, &mut [vacant; 2]).expect("room for one leaf")?;
        let contact = scene.contact(ray, &hit).expect("of this scene");
        let face = hit.boundary.face;
        Some(Self {
            face,
            local: contact.local,
            position: contact.position,
            normal: contact.normal,
        })
    }

    /// On a random face, often within rounding of its edge, rim or tip.
    fn random(subject: &Subject<S>, random: &mut Random) -> Self {
        let edge = |random: &mut Random, half: f64| {
            let near = random.sign() * half * (1.0 - random.decades(-9.0, -1.0) * random.sign());
            if random.bits() & 1 == 0 { near } else { random.within(-half, half) }
        };
        let (face, near) = match subject.shape {
            Shape::Sphere(ball) => (0, random.direction().map(|x| x * ball.radius.to_f64())),
            Shape::Plane(_) => (0, random.ball().map(|x| x * subject.size)),
            Shape::Box(cuboid) => {
                let half = array::<S>((cuboid.max - cuboid.min) * S::HALF);
                let middle = array::<S>((cuboid.max + cuboid.min) * S::HALF);
                let offset = half.map(|h| edge(random, h));
                (random.below(6) as u32, along(middle, 1.0, offset))
            }
            Shape::Cylinder(_) | Shape::Cone(_) => {
                let (half, radius) = match subject.shape {
                    Shape::Cylinder(c) => (c.half_height.to_f64(), [c.radius.to_f64(); 2]),
                    Shape::Cone(c) => {
                        (c.half_height.to_f64(), [c.base_radius, c.top_radius].map(S::to_f64))
                    }
                    _ => unreachable!(),
                };
                let face = random.below(3) as u32;
                let face = if face > 0 && radius[face as usize - 1] == 0.0 { 0 } else { face };
                let across = edge(random, radius[0].max(radius[1]));
                let [x, _, z] = random.direction();
                let size = x.hypot(z);
                (face, [x / size * across, edge(random, half), z / size * across])
            }
            _ => panic!("no twin here"),
        };
        Self::at(subject, vector::<S>(near), face)
    }

    /// Checks normal and texture coordinates; how far the position lies from the exact surface,
    /// in ε·`reach`.
    fn check(&self, subject: &Subject<S>, reach: f64) -> f64 {
        let normal = array::<S>(self.normal);
        let eps = S::EPSILON.to_f64();
        assert!((length(normal) - 1.0).abs() <= 2.0 * eps, "normal of length {}", length(normal));
        let uv = subject.shape.uv(self.local, self.face, &Tables::EMPTY).map(S::to_f64);
        let bounded = !matches!(subject.shape, Shape::Plane(_));
        for x in uv {
            assert!(x.is_finite());
            assert!(!bounded || (-4.0 * eps..=1.0 + 4.0 * eps).contains(&x), "uv {uv:?}");
        }
        // An ellipsoid grows in its own coordinates.
        let scaled = matches!(subject.shape, Shape::Sphere(_)) && subject.place.is_some();
        let grown = if scaled { reach / subject.size } else { reach };
        let holds = |height: f64, grow: f64| {
            let lifted = self.lifted(height * reach);
            let span = subject.given.span(&lifted, &Real::from(grow * grown));
            span.is_some_and(|[enter, exit]| enter.sign() <= 0 && exit.sign() >= 0)
        };
        assert!(!holds(0.01, 0.0), "the normal {normal:?} does not look outward");
        let surface = |margin: &f64| holds(0.0, margin * eps) && !holds(0.0, -margin * eps);
        MARGINS.into_iter().find(surface).unwrap_or(f64::INFINITY)
    }

    /// A ray along the normal, from so far above the surface.
    fn lifted(&self, height: f64) -> Path {
        let normal = point::<S>(self.normal);
        let shift = crate::oracle::scaled(&normal, &Real::from(-height));
        Path { origin: crate::oracle::sub(&point::<S>(self.position), &shift), dir: normal }
    }
}

const MARGINS: [f64; 8] = [0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 64.0];

#[derive(Default)]
struct Errors {
    random: Vec<f64>,
    grazing: Vec<f64>,
    position: f64,
}

fn percentile(errors: &mut [f64]) -> f64 {
    errors.sort_by(f64::total_cmp);
    errors[errors.len() * 99 / 100]
}

/// A direction from the surface and whether it is taken to go inward.
fn leaving<S: Float>(random: &mut Random, contact: &Contact<S>, grazing: bool) -> (S::Vec3, bool) {
    let (normal, mut dir) = (array::<S>(contact.normal), random.direction());
    if grazing {
        let tilt = (0..3).map(|i| dir[i] * normal[i]).sum::<f64>();
        dir = along(dir, random.decades(-8.0, -1.0) * random.sign() - tilt, normal);
    }
    let dir = vector::<S>(dir.map(|x| x / length(dir)));
    let cosine = contact.normal.dot(dir).to_f64();
    // Where rounding leaves it open, the tracer's own word decides.
    let open = cosine.abs() < 2.0 * S::EPSILON.to_f64();
    (dir, if open { random.bits() & 1 == 0 } else { cosine < 0.0 })
}

/// The error of an exit, for the best of starts that lie within 2 ε·size of the position:
/// nearer than that no position can be told from the surface.
fn exit_error<S: Float>(this: &Subject<S>, contact: &Contact<S>, ray: &Ray<S>, exit: f64) -> f64 {
    let unit = S::EPSILON.to_f64() * (this.size + length(array::<S>(contact.position)));
    let mut least = f64::INFINITY;
    for height in [0.0, -0.5, 0.5, -1.0, 1.0, -2.0, 2.0] {
        let path = Path { dir: Path::of(ray).dir, ..contact.lifted(height * unit) };
        let span = this.given.span(&path, &Real::from(0.0));
        let truth = span.map_or(0.0, |[_, exit]| exit.to_f64().max(0.0));
        least = least.min((exit - truth).abs());
    }
    least
}

fn starts<S: Float>(body: Body, rays: u32) -> Errors {
    let mut random = Random::new(99);
    let mut errors = Errors::default();
    let mut this = subject::<S>(body, &mut random);
    for n in 0..rays {
        if n % 16 == 0 {
            this = subject::<S>(body, &mut random);
        }
        let hit = if n % 4 < 2 { Contact::hit(&this, &mut random) } else { None };
        let contact = hit.unwrap_or_else(|| Contact::random(&this, &mut random));
        let reach = this.size + length(array::<S>(contact.position));
        let grazing = n % 2 == 0;
        let (dir, inward) = leaving(&mut random, &contact, grazing);
        let ray = Ray { origin: contact.position, dir };
        let start = Start { node: 0, face: contact.face, inward, local: contact.local };
        let Some([enter, exit]) = this.span_from(ray, Some(start)) else {
            assert!(!inward, "{body:?}: a lost exit");
            continue;
        };
        assert!(inward, "{body:?}: a hit on the surface that the ray leaves");
        assert!(enter == 0.0 && exit > 0.0, "{body:?}: {enter}..{exit}");
        assert!(exit.is_finite() || matches!(body, Body::Plane), "{body:?}: no exit");
        if n % 160 < 4 && exit.is_finite() {
            errors.position = errors.position.max(contact.check(&this, reach));
            let cosine = contact.normal.dot(dir).to_f64();
            if cosine < -16.0 * S::EPSILON.to_f64() {
                let error = exit_error(&this, &contact, &ray, exit) / reach;
                if grazing { &mut errors.grazing } else { &mut errors.random }.push(error);
            }
        }
    }
    errors
}

fn bodies<S: Float>(rays: u32) {
    println!("{}: exit error over size, p99, random and grazing; start in ε·size", S::NAME);
    for body in BODIES {
        let mut errors = starts::<S>(body, rays);
        if matches!(body, Body::Plane) {
            continue;
        }
        let [random, grazing] = [&mut errors.random, &mut errors.grazing].map(|e| percentile(e));
        let name = format!("{body:?}");
        println!("{name:24} {random:9.2e} {grazing:9.2e} {:9.2}", errors.position);
        let eps = S::EPSILON.to_f64();
        assert!(random <= 24.0 * eps, "{name}: {random:e} at random");
        assert!(grazing <= 2.0 * eps.sqrt(), "{name}: {grazing:e} grazing");
        assert!(errors.position <= 8.0, "{name}: starts {} off the surface", errors.position);
    }
}

#[test]
fn starts_f32() {
    bodies::<f32>(100_000);
}

#[test]
fn starts_f64() {
    bodies::<f64>(20_000);
}

//! The error of every solid's boundaries against exact arithmetic, under stress: rays from up
//! to 10⁷ radii away, silhouettes, tiny and huge solids, short and long directions.
//!
//! `cargo test --test accuracy -- --nocapture` prints the table. "Wrong" counts decisions
//! (hit or miss) that differ from the exact one; "margin" is how far, in units of
//! ε·size, the solid has to grow or shrink until the exact decision is the same as ours for
//! all rays; "ulp" is the greatest error of t in units in the last place, and "geo" the greatest
//! |t error|·|dir|/size.
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]

mod oracle;

use nostray::ray::Line;
use nostray::shape::Sight;
use nostray::{Affine, Axis, Fixed, Form, Placement, Ray, Scalar, SceneBuilder, Shape, Vector};
use oracle::{Path, Point, Random, Real, Solid, along, inverse_rows, length, point, ulp, vector};

/// A leaf, and its exact twins: from the numbers that the user gave, and from those that the
/// leaf stores.
struct Subject<S: Scalar> {
    shape: Shape<S>,
    place: Option<Placement<S>>,
    given: Solid,
    stored: Solid,
    /// The greatest radius or half extent.
    size: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Sphere,
    Ellipsoid,
    /// Half axes from 1 to 1000.
    Splinter,
    Cylinder,
    OrientedCylinder,
    Cone,
    OrientedCone,
    Frustum,
    OrientedFrustum,
}

const ROUND: [Kind; 9] = [
    Kind::Sphere,
    Kind::Ellipsoid,
    Kind::Splinter,
    Kind::Cylinder,
    Kind::OrientedCylinder,
    Kind::Cone,
    Kind::OrientedCone,
    Kind::Frustum,
    Kind::OrientedFrustum,
];

/// A round solid whose radii are still to be multiplied.
#[derive(Clone)]
struct Plan<S: Scalar> {
    kind: Kind,
    ends: [S::Vec3; 2],
    radii: [f64; 2],
    map: Affine<S>,
    size: f64,
}

impl<S: Scalar> Plan<S> {
    fn random(kind: Kind, random: &mut Random, size: f64, center: [f64; 3]) -> Self {
        let half = size * random.decades(-0.5, 0.5);
        let axis = match kind {
            Kind::Cylinder | Kind::Cone | Kind::Frustum => [0.0, half * random.sign(), 0.0],
            _ => random.direction().map(|x| x * half),
        };
        let ends = [along(center, -1.0, axis), along(center, 1.0, axis)].map(vector::<S>);
        let radii = match kind {
            Kind::Cone | Kind::OrientedCone if random.bits() & 1 == 0 => [0.0, size],
            Kind::Cone | Kind::OrientedCone => [size, 0.0],
            Kind::Frustum | Kind::OrientedFrustum => {
                [size * random.within(0.1, 1.0), size * random.within(0.1, 1.0)]
            }
            Kind::Ellipsoid | Kind::Splinter => [1.0; 2],
            _ => [size; 2],
        };
        let (low, steps) = if kind == Kind::Splinter { (-3.0, 2) } else { (-0.7, 1) };
        let mut map = Affine::identity();
        if kind == Kind::Ellipsoid || kind == Kind::Splinter {
            let mut scales = [size; 3];
            for scale in scales.iter_mut().take(steps) {
                *scale *= random.decades(low, 0.0);
            }
            map = Affine::scale(vector::<S>(scales));
            for axis in Axis::ALL {
                map = map.then(&Affine::rotate(axis, S::from_f64(random.within(0.0, 360.0))));
            }
            map = map.then(&Affine::translate(vector::<S>(center)));
        }
        Self { kind, ends, radii, map, size }
    }

    fn exact(&self, factor: &Real) -> Solid {
        let [base, top] = self.radii.map(|r| Real::of(S::from_f64(r)) * factor);
        let zero = || Real::from(0.0);
        match self.kind {
            Kind::Sphere => {
                let ends = self.ends.map(oracle::array::<S>);
                let center = vector::<S>(along(ends[0], 1.0, ends[1]).map(|x| x / 2.0));
                Solid::Ball { center: point::<S>(center), radius: base }
            }
            Kind::Ellipsoid | Kind::Splinter => Solid::Placed {
                rows: inverse_rows(&self.map),
                offset: point::<S>(self.map.offset),
                inside: Box::new(Solid::Ball { center: [zero(), zero(), zero()], radius: base }),
            },
            _ => Solid::Tube { ends: self.ends.map(point::<S>), radii: [base, top] },
        }
    }

    fn build(&self, factor: f64) -> Subject<S> {
        let [base_radius, top_radius] = self.radii.map(|r| S::from_f64(r * factor));
        let mut rounded = self.clone();
        rounded.radii = [base_radius, top_radius].map(S::to_f64);
        let given = rounded.exact(&Real::from(1.0));
        let [base, top] = self.ends;
        let form = match self.kind {
            Kind::Sphere => {
                let Solid::Ball { center, .. } = &given else { unreachable!() };
                let center = vector::<S>(center.clone().map(|x| x.to_f64()));
                Form::Sphere { center, radius: base_radius }
            }
            Kind::Ellipsoid | Kind::Splinter => {
                Form::Sphere { center: S::Vec3::ZERO, radius: base_radius }
            }
            Kind::Cylinder | Kind::OrientedCylinder => {
                Form::Cylinder { base, top, radius: base_radius }
            }
            _ => Form::Cone { base, base_radius, top, top_radius },
        };
        Subject::new(form, &self.map, given, self.size)
    }
}

impl<S: Scalar> Subject<S> {
    fn new(form: Form<'_, S>, map: &Affine<S>, given: Solid, size: f64) -> Self {
        let mut builder = SceneBuilder::<S, Fixed<1, 1, 1, 1>>::new();
        let material =
            builder.material(nostray::Material::matte(nostray::Rgb::WHITE)).expect("room");
        builder.leaf(form, map, material).expect("a legal solid");
        let scene = builder.scene().expect("a legal scene");
        let Some(nostray::Node::Leaf(leaf)) = scene.parts().nodes.first() else {
            panic!("one leaf");
        };
        let place = scene.parts().placements.first().copied();
        let stored = stored::<S>(&leaf.shape, place.as_ref());
        Self { shape: leaf.shape, place, given, stored, size }
    }

    /// The one span of a convex solid.
    fn span(&self, ray: Ray<S>) -> Option<[f64; 2]> {
        let line = Line::new(ray, None);
        let sight = Sight { line: &line, place: self.place.as_ref(), start: None, points: &[] };
        let mut found = None;
        self.shape.spans(&sight, |span| {
            assert!(found.is_none(), "a convex solid has one span");
            let ends = [span.enter.t.to_f64(), span.exit.t.to_f64()];
            assert!(ends[0] <= ends[1], "a span {ends:?}");
            found = Some(ends);
        });
        found
    }
}

fn stored<S: Scalar>(shape: &Shape<S>, place: Option<&Placement<S>>) -> Solid {
    let real = Real::of::<S>;
    let tube = |center: S::Vec3, half: S, radii: [S; 2]| {
        let [x, y, z] = point::<S>(center);
        let end = |y: Real| -> Point { [x.clone(), y, z.clone()] };
        let ends = [end(&y - real(half)), end(&y + real(half))];
        Solid::Tube { ends, radii: radii.map(real) }
    };
    let inside = match *shape {
        Shape::Sphere(s) => Solid::Ball { center: point::<S>(s.center), radius: real(s.radius) },
        Shape::Cylinder(c) => tube(c.center, c.half_height, [c.radius; 2]),
        Shape::Cone(c) => tube(c.center, c.half_height, [c.base_radius, c.top_radius]),
        Shape::Box(b) => Solid::Cuboid { min: point::<S>(b.min), max: point::<S>(b.max) },
        Shape::Plane(p) => Solid::Half { normal: point::<S>(p.normal), offset: real(p.offset) },
        Shape::Triangle(_) | Shape::Polygon(_) => panic!("no inside"),
    };
    match place {
        None => inside,
        Some(place) => Solid::Placed {
            rows: place.to_local.map(point::<S>),
            offset: point::<S>(place.anchor),
            inside: Box::new(inside),
        },
    }
}

/// What a class of rays showed.
#[derive(Default)]
struct Row {
    rays: u32,
    hits: u32,
    wrong: u32,
    /// In ε·size.
    margin: f64,
    ulp: f64,
    geo: f64,
}

const MARGINS: [f64; 12] =
    [0.0, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 64.0, 1024.0, 65536.0, f64::INFINITY];

impl Row {
    fn take<S: Scalar>(&mut self, subject: &Subject<S>, exact: &Solid, size: f64, ray: Ray<S>) {
        self.rays += 1;
        let path = Path::of(&ray);
        let found = subject.span(ray);
        let truth = exact.span(&path, &Real::from(0.0));
        self.hits += u32::from(truth.is_some());
        match (found, &truth) {
            (Some(found), Some(truth)) => self.measure(found, truth, size, ray),
            (None, None) => {}
            (found, _) => {
                self.wrong += 1;
                let sign = if found.is_some() { 1.0 } else { -1.0 };
                let unit = sign * S::EPSILON.to_f64() * size;
                let agrees = |margin: f64| {
                    exact.span(&path, &Real::from(margin * unit)).is_some() == found.is_some()
                };
                let margin = MARGINS.into_iter().find(|&m| m.is_infinite() || agrees(m));
                self.margin = self.margin.max(margin.unwrap_or(f64::INFINITY));
            }
        }
    }

    fn measure<S: Scalar>(&mut self, found: [f64; 2], truth: &[Real; 2], size: f64, ray: Ray<S>) {
        let speed = length(oracle::array::<S>(ray.dir));
        for (t, exact) in found.into_iter().zip(truth) {
            let rounded = exact.to_f64();
            if t.is_infinite() || rounded.abs() > 1e300 {
                assert!(t.is_infinite() && rounded.abs() > 1e300, "{t} for {rounded}");
                continue;
            }
            let error = (Real::from(t) - exact).abs().to_f64();
            self.ulp = self.ulp.max(error / ulp::<S>(rounded));
            self.geo = self.geo.max(error * speed / size);
        }
    }

    fn print(&self, name: &str) {
        let Self { rays, hits, wrong, margin, ulp, geo } = self;
        println!("{name:44} {rays:7} {hits:7} {wrong:6} {margin:9} {ulp:10.3e} {geo:10.3e}");
    }
}

fn heading(title: &str) {
    println!(
        "\n{title:44} {:>7} {:>7} {:>6} {:>9} {:>10} {:>10}",
        "rays", "hits", "wrong", "margin", "ulp", "geo"
    );
}

/// A ray at a point near a solid of this size, from so many sizes away.
fn aimed<S: Scalar>(random: &mut Random, target: [f64; 3], size: f64, distance: f64) -> Ray<S> {
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

/// Rays whose distance from the axis or centre is 1 ± `spread` of what touches.
fn silhouette<S: Scalar>(
    kind: Kind,
    distance: f64,
    spread: impl Fn(&mut Random) -> f64,
    rays: u32,
) -> [Row; 2] {
    let mut random = Random::new(kind as u64 * 1000 + distance.log10() as u64);
    let mut rows = [Row::default(), Row::default()];
    while rows[0].rays < rays {
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
        let size = match kind {
            Kind::Ellipsoid | Kind::Splinter => factor,
            _ => factor.max(1.0) * subject.size,
        };
        let [given, stored] = &mut rows;
        given.take(&subject, &subject.given, size, ray);
        stored.take(&subject, &subject.stored, size, ray);
    }
    rows
}

/// Rays at a point well inside.
fn inside<S: Scalar>(kind: Kind, distance: [f64; 2], rays: u32) -> [Row; 2] {
    let mut random = Random::new(kind as u64 * 777 + distance[1] as u64);
    let mut rows = [Row::default(), Row::default()];
    while rows[0].rays < rays {
        let (size, center) = stand(&mut random);
        let subject = Plan::<S>::random(kind, &mut random, size, center).build(1.0);
        let target = along(center, size * 0.2, random.ball());
        let away = random.decades(distance[0].log10(), distance[1].log10());
        let ray = aimed::<S>(&mut random, target, size, away);
        let [given, stored] = &mut rows;
        given.take(&subject, &subject.given, size, ray);
        stored.take(&subject, &subject.stored, size, ray);
    }
    rows
}

fn table<S: Scalar>(rays: u32) {
    heading(&format!("{}: impact R(1 ± 0.01)", S::NAME));
    for kind in ROUND {
        for distance in [1e1, 1e3, 1e5, 1e7] {
            let [given, stored] =
                silhouette::<S>(kind, distance, |random| random.within(-0.01, 0.01), rays);
            given.print(&format!("{kind:?} at {distance:e}"));
            stored.print(&format!("{kind:?} at {distance:e} stored"));
        }
    }
    heading(&format!("{}: grazing", S::NAME));
    for kind in ROUND {
        let [given, stored] =
            silhouette::<S>(kind, 10.0, |random| random.decades(-7.0, -1.0) * random.sign(), rays);
        given.print(&format!("{kind:?}"));
        stored.print(&format!("{kind:?} stored"));
    }
    heading(&format!("{}: inside", S::NAME));
    for kind in ROUND {
        for distance in [[0.01, 10.0], [10.0, 100.0], [1e4, 1e7]] {
            let [given, stored] = inside::<S>(kind, distance, rays);
            given.print(&format!("{kind:?} {distance:?}"));
            stored.print(&format!("{kind:?} {distance:?} stored"));
        }
    }
}

#[test]
fn round_solids() {
    table::<f32>(2000);
    table::<f64>(500);
}

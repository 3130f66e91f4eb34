//! Solids of the tracer beside their exact twins.
#![allow(dead_code, unreachable_pub, reason = "each test program uses a part of the oracle")]
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]

use nostray::ray::{Line, Start};
use nostray::shape::{Sight, Tables};
use nostray::{
    Affine, Axis, Fixed, Form, Material, Node, Placement, Ray, Rgb, SceneBuilder, Shape, Vector,
};

use super::{Float, Point, Random, Real, Solid, along, array, inverse_rows, point, vector};

/// A leaf, and its exact twins: from the numbers that the user gave, and from those that the
/// leaf stores.
pub struct Subject<S: Float> {
    pub builder: SceneBuilder<S, Fixed<1, 1, 1, 1>>,
    pub shape: Shape<S>,
    pub place: Option<Placement<S>>,
    pub given: Solid,
    pub stored: Solid,
    /// The greatest radius or half extent.
    pub size: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
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

pub const ROUND: [Kind; 9] = [
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

impl Kind {
    /// A ball whose half axes are in its placement.
    pub fn is_scaled(self) -> bool {
        matches!(self, Self::Ellipsoid | Self::Splinter)
    }
}

/// A round solid whose radii are still to be multiplied.
#[derive(Clone)]
pub struct Plan<S: Float> {
    pub kind: Kind,
    pub ends: [S::Vec3; 2],
    pub radii: [f64; 2],
    pub map: Affine<S>,
    pub size: f64,
}

impl<S: Float> Plan<S> {
    pub fn random(kind: Kind, random: &mut Random, size: f64, center: [f64; 3]) -> Self {
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

    pub fn exact(&self, factor: &Real) -> Solid {
        let [base, top] = self.radii.map(|r| Real::of(S::from_f64(r)) * factor);
        let zero = || Real::from(0.0);
        match self.kind {
            Kind::Sphere => {
                let ends = self.ends.map(array::<S>);
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

    pub fn build(&self, factor: f64) -> Subject<S> {
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

impl<S: Float> Subject<S> {
    pub fn new(form: Form<'_, S>, map: &Affine<S>, given: Solid, size: f64) -> Self {
        let mut builder = SceneBuilder::<S, Fixed<1, 1, 1, 1>>::new();
        let material = builder.material(Material::matte(Rgb::WHITE)).expect("room");
        builder.leaf(form, map, material).expect("a legal solid");
        let scene = builder.scene().expect("a legal scene");
        let Some(&Node::Leaf(leaf)) = scene.parts().nodes.first() else {
            panic!("one leaf");
        };
        let place = scene.parts().placements.first().copied();
        let stored = stored::<S>(&leaf.shape, place.as_ref());
        Self { builder, shape: leaf.shape, place, given, stored, size }
    }

    /// The one span of a convex solid.
    pub fn span(&self, ray: Ray<S>) -> Option<[f64; 2]> {
        self.span_from(ray, None)
    }

    /// The same for a ray that may start on the surface.
    pub fn span_from(&self, ray: Ray<S>, start: Option<Start<S>>) -> Option<[f64; 2]> {
        let line = Line::new(ray, start);
        let (place, start) = (self.place.as_ref(), line.start.as_ref());
        let sight = Sight { line: &line, place, start, tables: &Tables::EMPTY };
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

fn stored<S: Float>(shape: &Shape<S>, place: Option<&Placement<S>>) -> Solid {
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
        _ => panic!("no twin here"),
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

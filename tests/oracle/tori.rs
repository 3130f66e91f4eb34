//! Tori of the tracer beside their exact twins, and rays that are laid at them.
#![allow(dead_code, unreachable_pub, reason = "each test program uses a part of the oracle")]
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

use nostray::ray::{Line, Start};
use nostray::shape::{Sight, Tables};
use nostray::{
    Affine, Fixed, Form, Material, Node, Placement, Ray, Rgb, SceneBuilder, SceneError, Shape,
    Vector as _,
};

use super::exact::Exact;
use super::ring::Ring;
use super::{Random, Real, along, length};

/// A torus of the tracer beside its exact twin.
pub struct Subject<S: Exact> {
    pub builder: SceneBuilder<S, Fixed<1, 1, 1, 1>>,
    pub shape: Shape<S>,
    pub place: Option<Placement<S>>,
    pub twin: Ring,
    /// Rounded: where it is and how it lies.
    pub frame: Frame,
}

/// A torus in plain double precision, to aim at.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    pub center: [f64; 3],
    pub basis: [[f64; 3]; 3],
    pub major: f64,
    pub minor: f64,
}

impl Frame {
    /// What errors are told in: the greater radius.
    pub fn size(&self) -> f64 {
        self.major.max(self.minor)
    }

    pub fn world(&self, local: [f64; 3]) -> [f64; 3] {
        let [x, y, z] = self.basis;
        along(along(along(self.center, local[0], x), local[1], y), local[2], z)
    }

    pub fn turned(&self, local: [f64; 3]) -> [f64; 3] {
        Self { center: [0.0; 3], ..*self }.world(local)
    }

    /// A point at a distance from the circle in radii of the tube, and the normal there.
    pub fn near_tube(&self, random: &mut Random, radii: f64) -> [[f64; 3]; 2] {
        let [around, tube] = [0; 2].map(|_| random.within(0.0, std::f64::consts::TAU));
        let ((sin, cos), (up, out)) = (around.sin_cos(), tube.sin_cos());
        let rho = self.major + self.minor * radii * out;
        let point = self.world([rho * cos, self.minor * radii * up, rho * sin]);
        [point, self.turned([out * cos, up, out * sin])]
    }
}

/// A scene of one torus, if it is legal.
pub fn built<S: Exact>(
    center: [f64; 3],
    axis: [f64; 3],
    major: f64,
    minor: f64,
) -> Result<SceneBuilder<S, Fixed<1, 1, 1, 1>>, SceneError> {
    let form = Form::Torus {
        center: S::vector(center),
        axis: S::vector(axis),
        major: S::from_f64(major),
        minor: S::from_f64(minor),
    };
    let mut builder = SceneBuilder::new();
    let material = builder.material(Material::matte(Rgb::WHITE))?;
    builder.leaf(form, &Affine::identity(), material)?;
    Ok(builder)
}

impl<S: Exact> Subject<S> {
    /// An upright torus, or one about an axis.
    pub fn new(center: [f64; 3], axis: Option<[f64; 3]>, major: f64, minor: f64) -> Self {
        let builder = built::<S>(center, axis.unwrap_or([0.0, 1.0, 0.0]), major, minor)
            .expect("a legal torus");
        let scene = builder.scene().expect("a legal scene");
        let Some(&Node::Leaf(leaf)) = scene.parts().nodes.first() else {
            panic!("one leaf");
        };
        let Shape::Torus(torus) = leaf.shape else {
            panic!("a torus");
        };
        let place = scene.parts().placements.first().copied();
        let unit = |i: usize| [0, 1, 2].map(|j| Real::from(if i == j { 1.0 } else { 0.0 }));
        let rows = place.map_or([0, 1, 2].map(unit), |place| {
            place.to_local.map(|row| row.to_array().map(S::real_wide))
        });
        let center = place.map_or(torus.center, |place| place.anchor);
        let twin = Ring {
            offset: S::point(center),
            major: torus.major.real(),
            minor: torus.minor.real(),
            rows: rows.clone(),
        };
        let frame = Frame {
            center: center.to_array().map(S::to_f64),
            basis: rows.map(|row| row.map(|x| x.to_f64())),
            major: torus.major.to_f64(),
            minor: torus.minor.to_f64(),
        };
        Self { builder, shape: leaf.shape, place, twin, frame }
    }

    /// The ends of the spans along a line, and whether they keep the contract.
    pub fn ends(&self, ray: Ray<S>, start: Option<Start<S>>) -> Vec<S> {
        let line = Line::new(ray, start);
        let (place, start) = (self.place.as_ref(), line.start.as_ref());
        let sight = Sight { line: &line, place, start, tables: &Tables::EMPTY };
        let mut ends: Vec<S> = Vec::new();
        self.shape.spans(&sight, |span| ends.extend([span.enter.t, span.exit.t]));
        assert!(ends.windows(2).all(|pair| pair[0] < pair[1]), "{ends:?} along {ray:?}");
        if ends.last().is_some_and(|&end| end > S::ZERO) {
            let bounds = self.shape.bounds(place, &Tables::EMPTY);
            assert!(bounds.meets(&line, S::FAR), "bounds lose {ray:?}");
        }
        ends
    }
}

/// How thick the tube is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Ring,
    Thin,
    Horn,
    Spindle,
}

impl Kind {
    pub fn minor(self, random: &mut Random) -> f64 {
        match self {
            Self::Ring => random.within(0.05, 0.95),
            Self::Thin => 1e-4,
            Self::Horn => 1.0,
            Self::Spindle => random.within(1.05, 4.0),
        }
    }
}

/// How a ray is laid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Aim {
    /// At a point in or near the tube, from 0.01 to 100 radii away.
    Random,
    /// Along a tangent whose distance from the surface is 10⁻⁷ to 10⁻¹ of the tube.
    Grazing,
    /// Along a tangent within a hundredth of the tube.
    Silhouette,
    /// From far away.
    Far,
    /// In a plane across the axis, often the middle one.
    Plane,
    /// Along the axis, or beside it.
    Axis,
}

pub fn subject<S: Exact>(kind: Kind, turned: bool, random: &mut Random) -> Subject<S> {
    let (fixed, greatest) = (S::FRACTION.is_some(), S::COORD_MAX.to_f64().log10() - 1.0);
    let size = match (fixed, kind) {
        (false, _) => random.decades(-4.0, 4.0),
        (true, Kind::Thin) => random.decades(greatest - 1.0, greatest),
        (true, _) => random.decades(-1.0, greatest),
    };
    let center = random.cube().map(|x| x * size * if fixed { 1.0 } else { 3.0 });
    let axis = turned.then(|| random.direction());
    Subject::new(center, axis, size, size * kind.minor(random))
}

pub fn ray<S: Exact>(aim: Aim, random: &mut Random, frame: &Frame) -> Ray<S> {
    let size = frame.size();
    let graze = |random: &mut Random, lift: f64| {
        let [point, normal] = frame.near_tube(random, 1.0 + lift);
        let aside = random.direction();
        let up: f64 = (0..3).map(|i| aside[i] * normal[i]).sum();
        let dir = along(aside, -up, normal);
        (point, dir.map(|x| x / length(dir)))
    };
    let fixed = S::FRACTION.is_some();
    let mut away = random.decades(-2.0, if fixed { 0.5 } else { 2.0 });
    let (target, dir) = match aim {
        Aim::Random | Aim::Far => {
            if aim == Aim::Far && !fixed {
                away = random.decades(3.0, if S::EPSILON.to_f64() > 1e-9 { 7.0 } else { 14.0 });
            }
            let radii = random.within(0.0, 1.1);
            (frame.near_tube(random, radii)[0], random.direction())
        }
        Aim::Grazing => {
            let lift = random.decades(-7.0, -1.0) * random.sign();
            graze(random, lift)
        }
        Aim::Silhouette => {
            let lift = random.within(-0.01, 0.01);
            graze(random, lift)
        }
        Aim::Plane => {
            let height = if random.bits() & 1 == 0 { 0.0 } else { random.within(-1.0, 1.0) };
            let [x, z] = [0; 2].map(|_| random.within(-1.0, 1.0) * (frame.major + frame.minor));
            let angle = random.within(0.0, std::f64::consts::TAU);
            let dir = frame.turned([angle.cos(), 0.0, angle.sin()]);
            (frame.world([x, height * frame.minor, z]), dir)
        }
        Aim::Axis => {
            let radii = random.within(-1.1, 1.1) * if random.bits() & 1 == 0 { 1.0 } else { 0.01 };
            let rho = if radii.abs() < 0.1 { 0.0 } else { frame.major + frame.minor * radii };
            let angle = random.within(0.0, std::f64::consts::TAU);
            let target = frame.world([rho * angle.cos(), 0.0, rho * angle.sin()]);
            (target, frame.turned([0.0, random.sign(), 0.0]))
        }
    };
    let speed = random.decades(-3.0, 3.0);
    let (origin, dir) = (along(target, -away * size, dir), dir.map(|x| x * speed));
    let mut ray = S::ray(origin, dir);
    if aim == Aim::Far && !fixed {
        // Far enough for the rounding of the way itself to miss: aim again from where it starts.
        let from = ray.origin.to_array().map(S::to_f64);
        let way = along(target, -1.0, from);
        ray.dir = S::ray(origin, way.map(|x| x / length(way) * speed)).dir;
    }
    ray
}

pub const KINDS: [Kind; 4] = [Kind::Ring, Kind::Thin, Kind::Horn, Kind::Spindle];

pub const AIMS: [Aim; 6] =
    [Aim::Random, Aim::Grazing, Aim::Silhouette, Aim::Far, Aim::Plane, Aim::Axis];

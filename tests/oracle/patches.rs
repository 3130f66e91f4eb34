//! Sets of patches beside their exact control points, and rays at them.
#![allow(dead_code, unreachable_pub, reason = "each test program uses a part of the oracle")]
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

pub mod seen;

use nostray::ray::{Line, Start};
use nostray::shape::Sight;
use nostray::{Affine, Fixed, Form, Leaf, Material, Node, Ray, Rgb, Scalar, SceneBuilder, Vector};
use nostray_harness::document::Solid;
use nostray_harness::gallery::find;

use super::{Random, along, length};
use seen::{Net, Seen, cross, surface};

/// How many rays a row has: what `NOSTRAY_RAYS` says, or so many.
pub fn rays(default: u32) -> u32 {
    let asked = std::env::var("NOSTRAY_RAYS").ok();
    asked.map_or(default, |text| text.parse().expect("NOSTRAY_RAYS is a number"))
}

/// The control points of a set, in double precision.
#[derive(Clone)]
pub struct Plan {
    pub points: Vec<[f64; 3]>,
    pub patches: Vec<[u32; 16]>,
}

/// The sets that are tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A sheet with bumps.
    Gentle,
    /// Sixteen points anywhere in a cube.
    Wild,
    /// A sheet that is folded over itself.
    Folded,
    /// One side is a point.
    Fan,
    /// Newell's teapot.
    Teapot,
}

pub const KINDS: [Kind; 5] = [Kind::Gentle, Kind::Wild, Kind::Folded, Kind::Fan, Kind::Teapot];

impl Plan {
    pub fn random(kind: Kind, random: &mut Random) -> Self {
        if kind == Kind::Teapot {
            return Self::teapot();
        }
        let points = (0..16).map(|n| {
            let (u, v) = (f64::from(n % 4) / 3.0, f64::from(n / 4) / 3.0);
            let [x, y, z] = random.cube();
            match kind {
                Kind::Gentle => [2.0 * u - 1.0 + 0.2 * x, 0.7 * y, 2.0 * v - 1.0 + 0.2 * z],
                Kind::Folded => {
                    let back = if n % 4 == 1 {
                        1.5
                    } else if n % 4 == 2 {
                        -1.5
                    } else {
                        0.0
                    };
                    [2.0 * u - 1.0 + back + 0.2 * x, 0.7 * y, 2.0 * v - 1.0 + 0.2 * z]
                }
                Kind::Fan => {
                    let (sin, cos) = (u * 1.5).sin_cos();
                    [v * cos, 0.5 * v * v * y, v * sin]
                }
                _ => [x, y, z],
            }
        });
        Self { points: points.collect(), patches: vec![std::array::from_fn(|n| n as u32)] }
    }

    /// The teapot of the gallery.
    pub fn teapot() -> Self {
        let document = find("teapot").expect("in the gallery").document().expect("legal");
        let solids = document.objects.iter().map(|object| &object.solid);
        let teapot = solids.filter_map(|solid| match solid {
            Solid::Patches { points, patches } => Some((points, patches)),
            _ => None,
        });
        let (points, patches) = teapot.max_by_key(|(points, _)| points.len()).expect("a teapot");
        Self {
            points: points.iter().map(|point| point.0).collect(),
            patches: patches.iter().map(|patch| patch.0).collect(),
        }
    }
}

pub fn vector<S: Scalar>(v: [f64; 3]) -> S::Vec3 {
    S::Vec3::from_array(v.map(S::from_f64))
}

pub fn array<S: Scalar>(v: S::Vec3) -> [f64; 3] {
    v.to_array().map(S::to_f64)
}

/// A set of patches in a format, with its control points as that format has them.
pub struct Subject<S: Scalar> {
    pub builder: SceneBuilder<S, Fixed<1, 1, 1, 512, 512>>,
    pub nets: Vec<Net>,
    pub center: [f64; 3],
    /// Half the greatest extent.
    pub size: f64,
}

impl<S: Scalar> Subject<S> {
    pub fn new(plan: &Plan, size: f64, offset: [f64; 3]) -> Self {
        let place = |p: &[f64; 3]| vector::<S>(along(offset, size, *p));
        let points: Vec<_> = plan.points.iter().map(place).collect();
        let mut builder = SceneBuilder::new();
        let material = builder.material(Material::matte(Rgb::WHITE)).expect("room");
        let form = Form::Patches { points: &points, patches: &plan.patches };
        builder.leaf(form, &Affine::identity(), material).expect("legal patches");
        let nets = plan.patches.iter().map(|patch| {
            let mut net = [[[0.0; 3]; 4]; 4];
            for (n, &index) in patch.iter().enumerate() {
                net[n / 4][n % 4] = array::<S>(points[index as usize]);
            }
            net
        });
        let nets: Vec<Net> = nets.collect();
        let all = || nets.iter().flatten().flatten();
        let [low, high] = [f64::min, f64::max]
            .map(|pick| [0, 1, 2].map(|i| all().map(|p| p[i]).reduce(pick).expect("a point")));
        let center = along(low, 1.0, high).map(|x| x / 2.0);
        let half = along(high, -1.0, low).map(|x| x / 2.0);
        let size = half.into_iter().fold(0.0, f64::max);
        Self { nets, builder, center, size }
    }

    pub fn leaf(&self) -> Leaf<S> {
        let scene = self.builder.scene().expect("a legal scene");
        match scene.parts().nodes.first() {
            Some(&Node::Leaf(leaf)) => leaf,
            _ => panic!("one leaf"),
        }
    }

    /// The t and the face of every hit.
    pub fn hits(&self, ray: Ray<S>, start: Option<Start<S>>) -> Vec<(S, u32)> {
        let scene = self.builder.scene().expect("a legal scene");
        let line = Line::new(ray, start);
        let tables = &scene.parts().tables;
        let sight = Sight { line: &line, place: None, start: line.start.as_ref(), tables };
        let mut hits: Vec<(S, u32)> = Vec::new();
        self.leaf().shape.spans(&sight, |span| {
            assert!(
                span.enter == span.exit && hits.last().is_none_or(|last| last.0 < span.enter.t)
            );
            hits.push((span.enter.t, span.enter.face));
        });
        hits
    }

    /// The patches as the exact ray sees them, for all that it does not miss clearly.
    pub fn seen(&self, origin: [f64; 3], dir: [f64; 3]) -> impl Iterator<Item = (usize, Seen)> {
        let speed = length(dir);
        self.nets.iter().enumerate().filter_map(move |(patch, net)| {
            // The line's distance from the middle of the patch, against its radius.
            let points = || net.iter().flatten();
            let middle = points().fold([0.0; 3], |sum, p| along(sum, 1.0 / 16.0, *p));
            let radius = points().map(|p| length(along(*p, -1.0, middle))).fold(0.0, f64::max);
            let moment = cross(along(middle, -1.0, origin), dir);
            (length(moment) <= radius * speed * 1.001).then(|| (patch, Seen::new(net, origin, dir)))
        })
    }

    /// A point of the surface, du and dv.
    pub fn surface(&self, patch: usize, at: [f64; 2]) -> [[f64; 3]; 3] {
        surface(&self.nets[patch], at)
    }

    /// A ray from so many sizes away through a point, as the format has it.
    pub fn ray(&self, random: &mut Random, target: [f64; 3], dir: [f64; 3], far: f64) -> Ray<S> {
        let origin = vector::<S>(along(target, -far * self.size, dir));
        let speed = random.decades(-2.0, 2.0);
        let wide = along(target, -1.0, array::<S>(origin)).map(|x| x / (far * self.size) * speed);
        let wide = S::WideVec::from_array(wide.map(<S::Wide as nostray::Real>::from_f64));
        Ray { origin, dir: S::steer(wide).0 }
    }
}

/// The exact origin and direction of a ray.
pub fn exact<S: Scalar>(ray: &Ray<S>) -> ([f64; 3], [f64; 3]) {
    use nostray::Real as _;
    (array::<S>(ray.origin), ray.dir.to_array().map(|d| S::widen_unit(d).to_f64()))
}

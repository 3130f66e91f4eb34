//! Lathes of many kinds, each with its profile as the oracle knows it.
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]
#![allow(unreachable_pub, reason = "a module of a test program")]

use nostray::ray::{Line, Start};
use nostray::shape::Sight;
use nostray::{Affine, Fixed, Form, Material, Node, Ray, Rgb, SceneBuilder, Shape, Vector};

use crate::oracle::Random;
use crate::oracle::revolve::{Piece, Profile, Spot};
use crate::oracle::steps::Exact;

/// The kinds of profiles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Lines from axis to axis, some level, some upright.
    Turned,
    /// A ring of lines.
    Ring,
    /// A wall of lines, a thousandth thick.
    Bowl,
    /// Curves through points, from axis to axis.
    Vase,
    /// Curves in a ring.
    Tyre,
    /// Curves with control points all over.
    Wild,
}

pub const KINDS: [Kind; 6] =
    [Kind::Turned, Kind::Ring, Kind::Bowl, Kind::Vase, Kind::Tyre, Kind::Wild];

pub type Builder<S> = SceneBuilder<S, Fixed<1, 1, 1, 128>>;

pub struct Subject<S: Exact> {
    pub builder: Builder<S>,
    pub profile: Profile,
    pub center: S::Vec3,
    pub size: f64,
}

/// Points of a profile of this kind, about 1 in size.
pub fn points(kind: Kind, random: &mut Random) -> Vec<Spot> {
    let count = 3 + random.below(4);
    let coarse = |x: f64| (x * 16.0).round() / 16.0;
    match kind {
        Kind::Turned | Kind::Vase => {
            let mut spots = vec![[0.0, coarse(random.within(-1.0, -0.8))]];
            let mut y = -0.75;
            for _ in 0..count {
                let upright = random.below(4) == 0;
                let last = spots.last().expect("one")[0];
                let rho =
                    if upright && last > 0.0 { last } else { coarse(random.within(0.1, 1.0)) };
                if random.below(4) > 0 {
                    y += coarse(random.within(0.1, 0.4));
                }
                spots.push([rho.max(0.0625), y]);
            }
            spots.push([0.0, y + coarse(random.within(-0.2, 0.4))]);
            if random.bits() & 1 == 0 {
                spots.reverse();
            }
            spots
        }
        Kind::Ring | Kind::Tyre => {
            let (middle, height) = (random.within(0.6, 0.9), random.within(-0.3, 0.3));
            let around = if random.bits() & 1 == 0 { 1.0 } else { -1.0 };
            let mut spots: Vec<Spot> = (0..count)
                .map(|i| {
                    let angle = (i as f64 + random.within(0.0, 0.8)) * around / count as f64;
                    let (sin, cos) = (angle * std::f64::consts::TAU).sin_cos();
                    let radius = random.within(0.1, 0.5);
                    [coarse(middle + radius * cos), coarse(height + radius * sin)]
                })
                .collect();
            spots.push(spots[0]);
            spots
        }
        Kind::Bowl => {
            let thick = random.decades(-4.0, -1.0);
            let mut outer = vec![[0.0, -0.5]];
            for i in 0..count {
                let share = (i + 1) as f64 / count as f64;
                outer.push([share.sqrt(), -0.5 + share * share + random.within(-0.02, 0.02)]);
            }
            let inner = outer.iter().rev().map(|[rho, y]| [rho * (1.0 - thick), y + thick]);
            outer.iter().copied().chain(inner).collect()
        }
        Kind::Wild => {
            let mut spots = vec![[0.0, random.within(-1.0, 0.0)]];
            for _ in 0..3 * (1 + random.below(3)) {
                spots.push([random.within(-0.2, 1.0), random.within(-1.0, 1.0)]);
            }
            if let Some(last) = spots.last_mut() {
                last[0] = 0.0;
            }
            spots
        }
    }
}

impl<S: Exact> Subject<S> {
    /// A solid of this kind and size; another one where the first is refused.
    pub fn new(kind: Kind, random: &mut Random, size: f64, center: [f64; 3]) -> Self {
        loop {
            let spots: Vec<[S; 2]> = points(kind, random)
                .into_iter()
                .map(|spot| spot.map(|x| S::from_f64(x * size)))
                .collect();
            let profile = match kind {
                Kind::Turned | Kind::Ring | Kind::Bowl => nostray::Profile::Linear(&spots),
                Kind::Vase | Kind::Tyre => nostray::Profile::CatmullRom(&spots),
                Kind::Wild => nostray::Profile::Bezier(&spots),
            };
            let center = S::Vec3::from_array(center.map(S::from_f64));
            let mut builder = Builder::<S>::new();
            let material = builder.material(Material::matte(Rgb::WHITE)).expect("room");
            let form = Form::Lathe { center, profile };
            if builder.leaf(form, &Affine::identity(), material).is_ok() {
                return Self::of(builder, center);
            }
        }
    }

    pub fn of(builder: Builder<S>, center: S::Vec3) -> Self {
        let profile = {
            let scene = builder.scene().expect("a legal scene");
            let Some(Node::Leaf(leaf)) = scene.parts().nodes.first() else { panic!("one leaf") };
            let Shape::Lathe(lathe) = leaf.shape else { panic!("a lathe") };
            let spots: Vec<Spot> = scene
                .parts()
                .tables
                .points
                .iter()
                .map(|p| [p.x().to_f64(), p.y().to_f64()])
                .collect();
            let pieces = match lathe.curve {
                nostray::Curve::Lines => {
                    spots.windows(2).map(|w| Piece::Line([w[0], w[1]])).collect()
                }
                nostray::Curve::Cubics => spots
                    .windows(4)
                    .step_by(3)
                    .map(|w| Piece::Cubic([w[0], w[1], w[2], w[3]]))
                    .collect(),
            };
            Profile::new(pieces)
        };
        let size = profile.size();
        Self { builder, profile, center, size }
    }

    /// The spans along a ray, behind its origin too.
    pub fn spans(&self, ray: Ray<S>, start: Option<Start<S>>) -> Vec<[S; 2]> {
        let line = Line::new(ray, start);
        let scene = self.builder.scene().expect("a legal scene");
        let parts = scene.parts();
        let Some(Node::Leaf(leaf)) = parts.nodes.first() else { panic!("one leaf") };
        let sight =
            Sight { line: &line, place: None, start: line.start.as_ref(), tables: &parts.tables };
        let mut found = Vec::new();
        leaf.shape.spans(&sight, |span| found.push([span.enter.t, span.exit.t]));
        for pair in found.windows(2) {
            assert!(pair[0][1] < pair[1][0], "spans apart: {found:?}");
        }
        assert!(found.iter().all(|[enter, exit]| enter < exit), "{found:?}");
        assert!(found.len() <= leaf.shape.spans_max() as usize);
        found
    }
}

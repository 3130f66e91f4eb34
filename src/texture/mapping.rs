//! From a point in space to the coordinates that a pattern is drawn in.

use super::Spot;
use crate::needs;
use crate::scalar::{Axis, Number, Real, Scalar, Vector};

/// Which coordinates a pattern is drawn in. All but [`Solid`](Self::Solid) are of a surface: a
/// pattern there has two.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Mapping<S> {
    /// The three of space.
    #[default]
    Solid,
    /// The surface's own two.
    Uv,
    /// x and y: projected along z.
    Planar,
    /// Longitude about the y axis and latitude, each from 0 to 1: a ball around the origin.
    Spherical,
    /// The angle about the y axis from 0 to 1, and y.
    Cylindrical,
    /// The box from −1 to 1, unfolded: the two coordinates across the axis along which a point lies farthest
    /// out, each from 0 to 1 on a face.
    Cubic,
    /// The angle about the y axis and the angle around the tube, each from 0 to 1.
    Toroidal {
        /// The radius of the circle that the tube is around.
        major: S,
    },
}

/// Whose coordinates a mapping begins with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Space {
    /// The scene's: the pattern stands still where solids move.
    #[default]
    Scene,
    /// The shape's own, from its centre: the pattern moves with it.
    Shape,
}

/// What becomes of coordinates beyond 0 and 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// They are as they are: a pattern has no end. An image repeats.
    #[default]
    Endless,
    /// They begin anew.
    Repeat,
    /// They go back and forth.
    Mirror,
    /// They stay at 0 and 1.
    Clamp,
}

impl Wrap {
    /// A coordinate where it is drawn.
    pub fn fold<S: Scalar>(self, v: S) -> S {
        match self {
            Self::Endless => v,
            Self::Repeat => v - v.floor(),
            Self::Mirror => {
                let half = v * S::HALF;
                let back = half - half.floor();
                let twice = back + back;
                if twice > S::ONE { S::TWO - twice } else { twice }
            }
            Self::Clamp => v.clamp(S::ZERO, S::ONE),
        }
    }
}

/// The angle of (x, z) about the y axis as a fraction of a turn: in 0..1, so that both sides of the seam are one.
fn turn<S: Scalar>(x: S::Wide, z: S::Wide) -> S {
    let angle = z.atan2(x) / (S::Wide::PI * S::Wide::TWO) + S::Wide::HALF;
    let turn = S::narrow(angle);
    if turn < S::ONE { turn.max(S::ZERO) } else { S::ZERO }
}

/// The latitude of a point, from 0 at the south pole to 1 at the north pole; ½ of the centre.
fn latitude<S: Scalar>(p: S::WideVec) -> S {
    let length = p.length();
    if !(length > S::Wide::ZERO) {
        return S::HALF;
    }
    S::narrow(S::Wide::ONE - (p.y() / length).acos() / S::Wide::PI).clamp(S::ZERO, S::ONE)
}

/// The two coordinates on the face of a box that a point belongs to, as seen from outside.
fn unfolded<S: Scalar>(p: S::Vec3) -> [S; 2] {
    let [x, y, z] = p.map(Number::abs).to_array();
    let axis = if x >= y && x >= z {
        Axis::X
    } else if y >= z {
        Axis::Y
    } else {
        Axis::Z
    };
    let back = p.get(axis) < S::ZERO;
    let flip = |v: S, flip: bool| if flip { -v } else { v };
    let (u, v) = match axis {
        Axis::X => (flip(p.z(), !back), p.y()),
        Axis::Y => (p.x(), flip(p.z(), !back)),
        Axis::Z => (flip(p.x(), back), p.y()),
    };
    [u, v].map(|v| (v + S::ONE) * S::HALF)
}

impl<S: Scalar> Mapping<S> {
    /// A pattern has two coordinates.
    pub fn is_flat(&self) -> bool {
        *self != Self::Solid
    }

    /// The coordinates of a point; the third is 0 of those of a surface. [`Uv`](Self::Uv) is asked of the spot.
    pub fn coordinates(&self, p: S::Vec3, spot: &Spot<'_, S>) -> S::Vec3 {
        self.coordinates_for::<{ needs::ALL }>(p, spot)
    }

    /// The same on one of the solids that are needed.
    pub(super) fn coordinates_for<const NEEDS: u64>(
        &self,
        p: S::Vec3,
        spot: &Spot<'_, S>,
    ) -> S::Vec3 {
        let wide = S::widen_vec(p);
        let [u, v] = match *self {
            Self::Solid => return p,
            Self::Uv => spot.uv_for::<NEEDS>(),
            Self::Planar => [p.x(), p.y()],
            Self::Spherical => [turn::<S>(wide.x(), wide.z()), latitude::<S>(wide)],
            Self::Cylindrical => [turn::<S>(wide.x(), wide.z()), p.y()],
            Self::Cubic => unfolded::<S>(p),
            Self::Toroidal { major } => {
                let out = S::WideVec::new(wide.x(), S::Wide::ZERO, wide.z()).length();
                let around = turn::<S>(out - major.widen(), wide.y());
                [turn::<S>(wide.x(), wide.z()), around]
            }
        };
        S::Vec3::new(u, v, S::ZERO)
    }
}

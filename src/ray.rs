//! Rays, where they start, and what is computed of them once for all solids.

use crate::scalar::{Number, Scalar, Vector};

/// A half-line: `origin + t·dir` for t > 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray<S: Scalar> {
    /// Where it starts.
    pub origin: S::Vec3,
    /// Where it goes; t counts in lengths of this vector. In fixed point it is always of unit length.
    pub dir: S::Dir,
}

impl<S: Scalar> Ray<S> {
    /// The point at `t`.
    #[inline]
    pub fn at(&self, t: S) -> S::Vec3 {
        self.origin + S::along(self.dir, t)
    }
}

/// The surface that a secondary or shadow ray starts on.
///
/// The root of this surface at t = 0 is known, so it is divided out instead of being
/// avoided by an epsilon: no ray meets the surface it starts on again by rounding, and none
/// loses the far side of a thin solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start<S: Scalar> {
    /// The leaf, as an index into the scene's nodes.
    pub node: u32,
    /// Which of its faces.
    pub face: u32,
    /// The ray goes to the inner side of the leaf.
    pub inward: bool,
    /// The origin in the leaf's own coordinates, on the surface.
    pub local: S::Vec3,
}

/// A ray with everything that depends on its direction alone.
#[derive(Clone, Copy, Debug)]
pub struct Line<S: Scalar> {
    /// Where it starts.
    pub origin: S::Vec3,
    /// Where it goes.
    pub dir: S::Dir,
    /// `dir · dir`.
    pub dd: S::Wide,
    /// `1 / (dir · dir)`.
    pub inv_dd: S::Wide,
    /// `1 / dir`, coordinate by coordinate.
    pub inv_dir: [S::Inverse; 3],
    /// The surface it starts on.
    pub start: Option<Start<S>>,
    aim: S::Aim,
}

impl<S: Scalar> Line<S> {
    /// Prepares a ray that starts on the given surface, or in free space.
    #[inline]
    pub fn new(ray: Ray<S>, start: Option<Start<S>>) -> Self {
        let aim = S::aim(ray.dir);
        let dd = S::heading(ray.dir, &aim).length_squared();
        Self {
            origin: ray.origin,
            dir: ray.dir,
            dd,
            inv_dd: S::Wide::ONE / dd,
            inv_dir: ray.dir.to_array().map(S::reciprocal),
            start,
            aim,
        }
    }

    /// The direction, for long formulas.
    #[inline]
    pub fn heading(&self) -> S::WideVec {
        S::heading(self.dir, &self.aim)
    }

    /// About the parameter at which the ray is nearest to a point.
    #[inline]
    pub fn approach(&self, centre: S::Vec3) -> S {
        S::approach(self.origin, centre, self.dir, self.inv_dd)
    }

    /// The point at `k`, seen from `centre`, without cancellation.
    #[inline]
    pub fn recentred(&self, centre: S::Vec3, k: S) -> S::WideVec {
        S::recentre(self.origin, centre, self.dir, &self.aim, k)
    }

    /// What the rounding of [`recentred`](Self::recentred) took from its point.
    pub(crate) fn recentred_rest(&self, centre: S::Vec3, k: S) -> S::WideVec {
        S::recentre_rest(self.origin, centre, self.dir, &self.aim, k)
    }

    /// The ray's line may come within `radius` of `centre`. Never false where it does; what
    /// rounding may have added to the distance is allowed for.
    #[inline]
    pub fn may_pass(&self, centre: S::Vec3, radius: S) -> bool {
        S::may_pass(self.origin, centre, self.dir, self.inv_dd, radius)
    }
}

//! Boxes around solids, to skip what a ray cannot meet.

use crate::ray::Line;
use crate::scalar::{Scalar, Vector};

/// An axis-aligned box that holds a solid, rounding included. A bound may be infinite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds<S: Scalar> {
    /// The least coordinates.
    pub min: S::Vec3,
    /// The greatest coordinates.
    pub max: S::Vec3,
}

impl<S: Scalar> Bounds<S> {
    /// All of space.
    #[inline]
    pub fn everywhere() -> Self {
        Self { min: S::Vec3::splat(-S::FAR), max: S::Vec3::splat(S::FAR) }
    }

    /// No point at all.
    #[inline]
    pub fn nothing() -> Self {
        Self { min: S::Vec3::splat(S::FAR), max: S::Vec3::splat(-S::FAR) }
    }

    /// The box about `centre` that reaches `extent` to either side, widened by what rounding
    /// may have taken from either.
    pub fn about(centre: S::Vec3, extent: S::Vec3) -> Self {
        let widened = centre.zip(extent, |c, e| (c.abs() + e) * S::EPSILON * S::from_i32(16) + e);
        Self { min: centre - widened, max: centre + widened }
    }

    /// The box between two corners, widened by what rounding may have taken.
    pub fn between(min: S::Vec3, max: S::Vec3) -> Self {
        let slack = min.zip(max, |a, b| a.abs().max(b.abs()) * S::EPSILON * S::from_i32(16));
        Self { min: min - slack, max: max + slack }
    }

    /// The box around a set of points.
    pub fn around(points: &[S::Vec3]) -> Self {
        let tight =
            points.iter().fold(Self::nothing(), |all, &p| all.union(&Self { min: p, max: p }));
        Self::between(tight.min, tight.max)
    }

    /// The box around both.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        Self { min: self.min.zip(other.min, S::min), max: self.max.zip(other.max, S::max) }
    }

    /// What is in both.
    #[must_use]
    pub fn intersection(&self, other: &Self) -> Self {
        Self { min: self.min.zip(other.min, S::max), max: self.max.zip(other.max, S::min) }
    }

    /// No side is infinite.
    pub fn is_finite(&self) -> bool {
        self.min.is_finite() && self.max.is_finite()
    }

    /// The point is inside or on the box.
    pub fn contains(&self, p: S::Vec3) -> bool {
        let inside = |low: S, v: S, high: S| low <= v && v <= high;
        inside(self.min.x(), p.x(), self.max.x())
            && inside(self.min.y(), p.y(), self.max.y())
            && inside(self.min.z(), p.z(), self.max.z())
    }

    /// The ray may meet the box at some t in 0..=`t_max`. Never false where it does.
    ///
    /// Source: T. Ize, "Robust BVH Ray Traversal" (2013): the far side is widened by the
    /// rounding of the slab test.
    #[inline]
    pub fn meets(&self, line: &Line<S>, t_max: S) -> bool {
        let (mut enter, mut exit) = (S::ZERO, t_max);
        let mut slab = |min: S, max: S, origin: S, inv: S| {
            let (a, b) = ((min - origin) * inv, (max - origin) * inv);
            let (near, far) = if inv < S::ZERO { (b, a) } else { (a, b) };
            // A ray in the plane of a side gives 0·∞, which compares as neither.
            if near > enter {
                enter = near;
            }
            if far < exit {
                exit = far;
            }
        };
        slab(self.min.x(), self.max.x(), line.origin.x(), line.inv_dir.x());
        slab(self.min.y(), self.max.y(), line.origin.y(), line.inv_dir.y());
        slab(self.min.z(), self.max.z(), line.origin.z(), line.inv_dir.z());
        enter <= exit + exit * (S::EPSILON * S::from_i32(4))
    }
}

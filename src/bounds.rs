//! Boxes around solids, to skip what a ray cannot meet.

use crate::ray::Line;
use crate::scalar::{Real, Scalar, Vector};

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
        let widened = centre.zip(extent, |c, e| slack(c.abs() + e) + e);
        Self { min: centre - widened, max: centre + widened }
    }

    /// The box between two corners, widened by what rounding may have taken.
    pub fn between(min: S::Vec3, max: S::Vec3) -> Self {
        let slack = min.zip(max, |a, b| slack(a.abs().max(b.abs())));
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
        self.meets_between(line, [S::ZERO, t_max])
    }

    /// The same for the part of a ray's line between two t.
    #[inline]
    pub(crate) fn meets_between(&self, line: &Line<S>, [mut enter, mut exit]: [S; 2]) -> bool {
        let [x, y, z] = line.inv_dir;
        let mut slab = |min: S, max: S, origin: S, inv: S::Inverse| {
            if S::is_parallel(inv) {
                return min <= origin && origin <= max;
            }
            let (a, b) = (S::quotient(min, origin, inv), S::quotient(max, origin, inv));
            let (near, far) = if S::is_backward(inv) { (b, a) } else { (a, b) };
            enter = enter.max(near);
            exit = exit.min(far);
            true
        };
        slab(self.min.x(), self.max.x(), line.origin.x(), x)
            && slab(self.min.y(), self.max.y(), line.origin.y(), y)
            && slab(self.min.z(), self.max.z(), line.origin.z(), z)
            && enter <= exit + slack(exit.abs())
    }
}

/// More than rounding can have made of a number of this magnitude.
#[inline]
fn slack<S: Scalar>(magnitude: S) -> S {
    S::narrow(S::rounding(magnitude.widen()) * S::Wide::from_i32(16))
}

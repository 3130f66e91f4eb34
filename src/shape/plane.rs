//! The half-space below a plane.

use super::{Flaw, Primitive, Sight, Tables, check_direction, check_point, unplaced};
use crate::bounds::Bounds;
use crate::place::Placement;
use crate::scalar::{Axis, Number, Scalar, Vector};
use crate::span::Span;

/// The half-space `normal · p ≤ offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane<S: Scalar> {
    /// The outward normal; of any length but 0 in a float, of unit length in fixed point.
    pub normal: S::Dir,
    /// `normal · p` for a point of the plane.
    pub offset: S,
}

impl<S: Scalar> Plane<S> {
    /// The axis that the normal is parallel to, if any.
    #[inline]
    fn axis(&self) -> Option<Axis> {
        let [x, y, z] = self.normal.to_array().map(|v| v == S::Unit::ZERO);
        match (x, y, z) {
            (false, true, true) => Some(Axis::X),
            (true, false, true) => Some(Axis::Y),
            (true, true, false) => Some(Axis::Z),
            _ => None,
        }
    }

    /// The coordinate of a plane across an axis.
    fn level(&self, axis: Axis) -> S {
        S::narrow(self.offset.widen() / S::widen_unit(self.normal.get(axis)))
    }
}

impl<S: Scalar> Primitive<S> for Plane<S> {
    fn centre(&self) -> S::Vec3 {
        S::Vec3::ZERO
    }

    fn check(&self, placed: bool, _: &Tables<'_, S>) -> Result<(), Flaw> {
        unplaced(placed, "normal")?;
        check_direction::<S>(self.normal, "normal")?;
        check_point::<S>(S::Vec3::splat(self.offset), "offset")
    }

    fn bounds(&self, _: Option<&Placement<S>>, _: &Tables<'_, S>) -> Bounds<S> {
        let mut bounds: Bounds<S> = Bounds::everywhere();
        if let Some(axis) = self.axis() {
            let at = self.level(axis);
            let side: Bounds<S> = Bounds::between(S::Vec3::splat(at), S::Vec3::splat(at));
            if self.normal.get(axis) > S::Unit::ZERO {
                bounds.max = bounds.max.with(axis, side.max.get(axis));
            } else {
                bounds.min = bounds.min.with(axis, side.min.get(axis));
            }
        }
        bounds
    }

    /// (offset − n·o) / (n·d). Where the normal is not a unit vector along an axis, the products
    /// are taken without cancellation and t is solved a second time from the point found, so
    /// that the error follows the point hit and not the distance of the origin.
    #[inline]
    fn spans(&self, sight: &Sight<'_, S>, mut emit: impl FnMut(Span<S>)) {
        let line = sight.line;
        let mut span = Span::whole();
        if let Some(start) = sight.start {
            if start.inward {
                span.enter.t = S::ZERO;
                emit(span);
            }
            return;
        }
        let normal = S::widen_dir(self.normal);
        let oblique = normal.length_squared() != S::Wide::ONE || self.axis().is_none();
        let (offset, origin) = (self.offset.widen(), S::widen_vec(line.origin));
        let (speed, height) = if oblique {
            (S::dot_wide(normal, line.heading()), S::height(offset, normal, origin))
        } else {
            (normal.dot(line.heading()), offset - normal.dot(origin))
        };
        let inverse = S::Wide::ONE / speed;
        let mut t = height * inverse;
        if !inverse.is_finite() || !t.is_finite() {
            // Parallel.
            if height >= S::Wide::ZERO {
                emit(span);
            }
            return;
        }
        if oblique && S::REFINES {
            let found = S::narrow(t);
            let gap = S::height(offset, normal, line.recentred(S::Vec3::ZERO, found));
            t = found.widen() + gap * inverse;
        }
        if inverse > S::Wide::ZERO {
            span.exit.t = S::narrow(t);
        } else {
            span.enter.t = S::narrow(t);
        }
        emit(span);
    }

    fn snap(&self, local: S::WideVec, _: u32, _: &Tables<'_, S>) -> S::Vec3 {
        match self.axis() {
            Some(axis) => S::narrow_vec(local).with(axis, self.level(axis)),
            None => {
                let normal = S::widen_dir(self.normal);
                let gap = self.offset.widen() - normal.dot(local);
                S::narrow_vec(local + normal * (gap / normal.length_squared()))
            }
        }
    }

    fn normal(&self, _: S::Vec3, _: u32, _: &Tables<'_, S>) -> S::WideVec {
        S::widen_dir(self.normal)
    }

    /// Distances from the scene's origin along the two axes in the plane that
    /// [`Vector::basis`] gives.
    fn uv(&self, local: S::Vec3, _: u32, _: &Tables<'_, S>) -> [S; 2] {
        let (u, v) = S::widen_dir(self.normal).normalize().basis();
        [u, v].map(|axis| S::narrow(S::widen_vec(local).dot(axis)))
    }
}

//! The box.

use super::{Flaw, Primitive, Sight, check_point};
use crate::bounds::Bounds;
use crate::place::{Local, Placement};
use crate::scalar::{Axis, Scalar, Vector};
use crate::span::{End, Span};

/// A box between two corners, along the axes of its coordinates.
///
/// Faces 0 to 5 are −x, +x, −y, +y, −z, +z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid<S: Scalar> {
    /// The least coordinates.
    pub min: S::Vec3,
    /// The greatest coordinates.
    pub max: S::Vec3,
}

/// The axis of a face, and whether it is the upper one.
#[inline]
fn of_face(face: u16) -> (Axis, bool) {
    let axis = match face / 2 {
        0 => Axis::X,
        1 => Axis::Y,
        _ => Axis::Z,
    };
    (axis, face % 2 == 1)
}

impl<S: Scalar> Cuboid<S> {
    #[inline]
    fn side(&self, face: u16) -> (Axis, S) {
        let (axis, upper) = of_face(face);
        (axis, if upper { self.max.get(axis) } else { self.min.get(axis) })
    }

    /// The span within the slab of one axis, or `None` beside it.
    #[inline]
    fn slab(&self, axis: Axis, origin: S, dir: S, inv: S, start: Option<u16>) -> Option<Span<S>> {
        let (low_face, high_face) = match axis {
            Axis::X => (0, 1),
            Axis::Y => (2, 3),
            Axis::Z => (4, 5),
        };
        let (min, max) = (self.min.get(axis), self.max.get(axis));
        if dir == S::ZERO {
            let within = start.is_none_or(|face| face != low_face && face != high_face)
                && min <= origin
                && origin <= max;
            return within.then(Span::whole);
        }
        let end = |side: S, face: u16| {
            let t = if start == Some(face) { S::ZERO } else { (side - origin) * inv };
            End { t, face }
        };
        let (low, high) = (end(min, low_face), end(max, high_face));
        Some(if dir < S::ZERO {
            Span { enter: high, exit: low }
        } else {
            Span { enter: low, exit: high }
        })
    }
}

impl<S: Scalar> Primitive<S> for Cuboid<S> {
    const OPEN: bool = false;
    const SPANS_MAX: u16 = 1;

    fn centre(&self) -> S::Vec3 {
        S::Vec3::ZERO
    }

    fn check(&self, _: bool, _: &[S::Vec3]) -> Result<(), Flaw> {
        check_point::<S>(self.min, "min")?;
        check_point::<S>(self.max, "max")?;
        for axis in Axis::ALL {
            let extent = self.max.get(axis) - self.min.get(axis);
            if extent < S::ZERO {
                return Err(Flaw::Inverted("max"));
            } else if extent == S::ZERO {
                return Err(Flaw::Empty("max"));
            }
        }
        Ok(())
    }

    fn bounds(&self, place: Option<&Placement<S>>, _: &[S::Vec3]) -> Bounds<S> {
        let Some(place) = place else {
            return Bounds::between(self.min, self.max);
        };
        let centre = place.point((self.min + self.max) * S::HALF);
        let half = (self.max - self.min) * S::HALF;
        let [x, y, z] = place.to_world.map(|row| row.map(S::abs).dot(half));
        Bounds::about(centre, S::Vec3::new(x, y, z))
    }

    /// The common part of three slabs. In the scene's axes the reciprocals are the ray's own
    /// and the sides are taken as they are, so faces in one plane tie exactly.
    #[inline]
    fn spans(&self, sight: &Sight<'_, S>, mut emit: impl FnMut(Span<S>)) {
        let start = sight.start.map(|start| start.face);
        let (shift, origin, dir, inv) = match (sight.place, sight.start) {
            (None, _) => (S::ZERO, sight.line.origin, sight.line.dir, sight.line.inv_dir),
            (Some(place), None) => {
                let ray = Local::recentred(sight.line, Some(place), place.anchor);
                (ray.shift, ray.origin, ray.dir, ray.dir.map(|d| S::ONE / d))
            }
            (Some(place), Some(start)) => {
                let ray = Local::from_surface(sight.line, Some(place), start.local);
                (ray.shift, ray.origin, ray.dir, ray.dir.map(|d| S::ONE / d))
            }
        };
        let mut span = Span::whole();
        for axis in Axis::ALL {
            let (o, d, i) = (origin.get(axis), dir.get(axis), inv.get(axis));
            match self.slab(axis, o, d, i, start) {
                Some(slab) => span.clip(&slab),
                None => return,
            }
        }
        if span.is_open() {
            span.enter.t += shift;
            span.exit.t += shift;
            emit(span);
        }
    }

    fn snap(&self, local: S::Vec3, face: u16) -> S::Vec3 {
        let (axis, side) = self.side(face);
        local.zip(self.min, S::max).zip(self.max, S::min).with(axis, side)
    }

    fn normal(&self, _: S::Vec3, face: u16, _: &[S::Vec3]) -> S::Vec3 {
        let (axis, upper) = of_face(face);
        S::Vec3::ZERO.with(axis, if upper { S::ONE } else { -S::ONE })
    }

    /// The place on the face along the two axes after its own, each in 0..=1.
    fn uv(&self, local: S::Vec3, face: u16, _: &[S::Vec3]) -> [S; 2] {
        let (u, v) = (of_face(face).0.next(), of_face(face).0.next().next());
        [u, v].map(|axis| {
            let (min, max) = (self.min.get(axis), self.max.get(axis));
            (local.get(axis) - min) / (max - min)
        })
    }
}

//! The box.

use super::{Flaw, Primitive, Sight, Tables, check_point};
use crate::bounds::Bounds;
use crate::place::{Local, Placement};
use crate::ray::Line;
use crate::scalar::{Axis, Number, Real, Scalar, Vector};
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
fn of_face(face: u32) -> (Axis, bool) {
    let axis = match face / 2 {
        0 => Axis::X,
        1 => Axis::Y,
        _ => Axis::Z,
    };
    (axis, face % 2 == 1)
}

impl<S: Scalar> Cuboid<S> {
    #[inline]
    fn side(&self, face: u32) -> (Axis, S) {
        let (axis, upper) = of_face(face);
        (axis, if upper { self.max.get(axis) } else { self.min.get(axis) })
    }

    /// The span within the slab of one axis, or `None` beside it; `within` tells where a ray
    /// along the slab lies, else `to` where it meets a side. A ray in the plane of a side is within.
    #[inline]
    fn slab<T: Real>(
        &self,
        axis: Axis,
        [parallel, backward]: [bool; 2],
        within: impl Fn(S, S) -> bool,
        to: impl Fn(S) -> T,
    ) -> Option<Span<T>> {
        let (low_face, high_face) = faces(axis);
        let (min, max) = (self.min.get(axis), self.max.get(axis));
        if parallel {
            return within(min, max).then(Span::whole);
        }
        let low = End { t: to(min), face: low_face };
        let high = End { t: to(max), face: high_face };
        Some(if backward {
            Span { enter: high, exit: low }
        } else {
            Span { enter: low, exit: high }
        })
    }

    /// The part of a ray within the box, in the scene's axes, or `None` beside it.
    #[inline]
    fn crossing(&self, line: &Line<S>) -> Option<Span<S>> {
        let mut span = Span::whole();
        for (axis, inverse) in Axis::ALL.into_iter().zip(line.inv_dir) {
            let origin = line.origin.get(axis);
            let way = [S::is_parallel(inverse), S::is_backward(inverse)];
            let within = |min: S, max: S| min <= origin && origin <= max;
            let slab = self.slab(axis, way, within, |side| S::quotient(side, origin, inverse))?;
            span.clip(&slab);
        }
        Some(span)
    }

    /// The same in coordinates of its own, in the parameter of the local ray.
    #[inline]
    pub(super) fn placed_crossing(&self, ray: &Local<S>) -> Option<Span<S::Wide>> {
        let mut span = Span::whole();
        for axis in Axis::ALL {
            let origin = ray.origin.get(axis);
            let inverse = S::Wide::ONE / ray.dir.get(axis);
            let way = [!inverse.is_finite(), inverse < S::Wide::ZERO];
            let within = |min: S, max: S| min.widen() <= origin && origin <= max.widen();
            let slab = self.slab(axis, way, within, |side| (side.widen() - origin) * inverse)?;
            span.clip(&slab);
        }
        Some(span)
    }

    /// Whether the ray goes through more than an edge or a corner, decided exactly: it enters
    /// every slab before it leaves any.
    #[cold]
    fn is_crossed(&self, line: &Line<S>) -> bool {
        let end = |axis: Axis, upper: bool| {
            let side = if upper { self.max } else { self.min };
            (side.get(axis), line.origin.get(axis), line.dir.get(axis))
        };
        let zero = S::Unit::ZERO;
        let moving = || {
            let axes = Axis::ALL.into_iter().zip(line.inv_dir);
            axes.filter(|&(_, inverse)| !S::is_parallel(inverse)).map(|(axis, _)| axis)
        };
        moving().all(|a| {
            let enter = end(a, line.dir.get(a) < zero);
            moving().all(|b| a == b || S::precedes(enter, end(b, line.dir.get(b) > zero)))
        })
    }

    /// Where a ray from a point of the box meets the nearest side ahead, other than the face that
    /// it starts on; t may be 0 or less by rounding.
    #[inline]
    pub(super) fn way_out(&self, ray: &Local<S>, from: Option<u32>) -> End<S::Wide> {
        let mut exit = End { t: S::Wide::FAR, face: from.unwrap_or(0) };
        for axis in Axis::ALL {
            let (low_face, high_face) = faces(axis);
            let (o, d) = (ray.origin.get(axis), ray.dir.get(axis));
            let (side, ahead) = if d < S::Wide::ZERO {
                (self.min.get(axis), low_face)
            } else {
                (self.max.get(axis), high_face)
            };
            let t = (side.widen() - o) / d;
            if d != S::Wide::ZERO && Some(ahead) != from && t < exit.t {
                exit = End { t, face: ahead };
            }
        }
        exit
    }
}

/// The lower and the upper face of an axis.
#[inline]
const fn faces(axis: Axis) -> (u32, u32) {
    match axis {
        Axis::X => (0, 1),
        Axis::Y => (2, 3),
        Axis::Z => (4, 5),
    }
}

impl<S: Scalar> Primitive<S> for Cuboid<S> {
    fn centre(&self) -> S::Vec3 {
        S::Vec3::ZERO
    }

    fn check(&self, _: bool, _: &Tables<'_, S>) -> Result<(), Flaw> {
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

    fn bounds(&self, place: Option<&Placement<S>>, _: &Tables<'_, S>) -> Bounds<S> {
        let Some(place) = place else {
            return Bounds::between(self.min, self.max);
        };
        let centre = place.point((self.min + self.max) * S::HALF);
        let half = S::widen_vec((self.max - self.min) * S::HALF);
        let [x, y, z] = place.to_world.map(|row| S::narrow(row.map(Number::abs).dot(half)));
        Bounds::about(centre, S::Vec3::new(x, y, z))
    }

    /// The common part of three slabs. In the scene's axes the reciprocals are the ray's own
    /// and the sides are taken as they are, so faces in one plane tie exactly, and a ray
    /// through an edge is decided exactly.
    #[inline]
    fn spans(&self, sight: &Sight<'_, S>, mut emit: impl FnMut(Span<S>)) {
        let line = sight.line;
        if let Some(start) = sight.start {
            if start.inward {
                // It is never empty.
                let ray = Local::from_surface(line, sight.place, start.local);
                let End { t, face } = self.way_out(&ray, Some(start.face));
                let exit = End { t: S::narrow(t).max(S::TINY), face };
                emit(Span { enter: End { t: S::ZERO, face: start.face }, exit });
            }
            return;
        }
        if let Some(place) = sight.place {
            let ray = Local::recentred(line, Some(place), place.anchor);
            if let Some(span) = self.placed_crossing(&ray).filter(Span::is_open) {
                emit(span.map(|t| ray.arrive(t)));
            }
            return;
        }
        let Some(mut span) = self.crossing(line) else {
            return;
        };
        let (enter, exit) = (span.enter.t, span.exit.t);
        let reach = S::rounding(enter.abs().max(exit.abs()).widen());
        if (exit - enter).abs() <= S::narrow(reach * S::Wide::from_i32(16)) {
            if !self.is_crossed(line) {
                return;
            }
            span.exit.t = exit.max(enter);
            return emit(span);
        }
        if span.is_open() {
            emit(span);
        }
    }

    fn snap(&self, local: S::WideVec, face: u32, _: &Tables<'_, S>) -> S::Vec3 {
        let (axis, side) = self.side(face);
        S::narrow_vec(local).zip(self.min, S::max).zip(self.max, S::min).with(axis, side)
    }

    fn normal(&self, _: S::Vec3, face: u32, _: &Tables<'_, S>) -> S::WideVec {
        let (axis, upper) = of_face(face);
        S::WideVec::ZERO.with(axis, if upper { S::Wide::ONE } else { -S::Wide::ONE })
    }

    /// The place on the face along the two axes after its own, each in 0..=1.
    fn uv(&self, local: S::Vec3, face: u32, _: &Tables<'_, S>) -> [S; 2] {
        let (u, v) = (of_face(face).0.next(), of_face(face).0.next().next());
        [u, v].map(|axis| {
            let (min, max) = (self.min.get(axis), self.max.get(axis));
            (local.get(axis) - min) / (max - min)
        })
    }
}

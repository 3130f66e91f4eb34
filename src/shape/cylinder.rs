//! The finite cylinder with its caps.

use super::{Flaw, Primitive, Sight, Tables, check_centre, check_length, turn};
use crate::bounds::Bounds;
use crate::place::{Local, Placement};
use crate::scalar::{Axis, Number, Real, Scalar, Vector};
use crate::span::{End, Span};

/// The side face of a cylinder or cone.
pub(super) const SIDE: u32 = 0;
/// The cap at the lower end of the axis.
pub(super) const BASE: u32 = 1;
/// The cap at the upper end of the axis.
pub(super) const TOP: u32 = 2;

/// A cylinder about the local y axis, closed by caps. Faces: 0 the side, 1 the base (−y), 2 the top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder<S: Scalar> {
    /// The middle of the axis; zero for a placed cylinder.
    pub center: S::Vec3,
    /// Half the distance between the caps, greater than 0.
    pub half_height: S,
    /// The radius, greater than 0.
    pub radius: S,
}

impl<S: Scalar> Cylinder<S> {
    /// The span within the endless cylinder, or `None` beside it.
    #[inline]
    fn side(&self, ray: &Local<S>) -> Option<Span<S::Wide>> {
        let (l, d) = (ray.origin, ray.dir);
        let across = d.x().squared() + d.z().squared();
        if is_axial(across, ray.dd) {
            let square = self.radius.widen().squared() - (l.x().squared() + l.z().squared());
            return (square > S::Wide::ZERO).then(Span::whole);
        }
        let inverse = S::Wide::ONE / across;
        let middle = -(l.x() * d.x() + l.z() * d.z()) * inverse;
        let (x, z) = (l.x() + d.x() * middle, l.z() + d.z() * middle);
        let square = self.radius.widen().squared() - (x.squared() + z.squared());
        (square > S::Wide::ZERO).then(|| {
            let half = (square * inverse).sqrt();
            Span::of_face(SIDE, middle - half, middle + half)
        })
    }
}

impl<S: Scalar> Primitive<S> for Cylinder<S> {
    fn centre(&self) -> S::Vec3 {
        self.center
    }

    fn check(&self, placed: bool, _: &Tables<'_, S>) -> Result<(), Flaw> {
        check_centre::<S>(self.center, placed)?;
        check_length(self.half_height, "half_height")?;
        check_length(self.radius, "radius")
    }

    fn bounds(&self, place: Option<&Placement<S>>, _: &Tables<'_, S>) -> Bounds<S> {
        tube_bounds(place, self.center, self.half_height, self.radius)
    }

    /// A disc in the plane across the axis, solved like a ball, clipped by the caps. A ray
    /// within rounding of parallel to the axis is parallel.
    #[inline]
    fn spans(&self, sight: &Sight<'_, S>, mut emit: impl FnMut(Span<S>)) {
        if let Some(start) = sight.start {
            if start.inward {
                let ray = Local::from_surface(sight.line, sight.place, start.local);
                let side = if start.face == SIDE {
                    Some(other_root(&ray))
                } else {
                    self.side(&ray).map(|span| span.exit.t)
                };
                emit(tube_exit(&ray, self.half_height, start.face, side));
            }
            return;
        }
        let ray = Local::recentred(sight.line, sight.place, self.center);
        let (Some(side), Some(caps)) = (self.side(&ray), caps(&ray, self.half_height)) else {
            return;
        };
        emit_common(&ray, side, &caps, emit);
    }

    fn snap(&self, local: S::WideVec, face: u32, _: &Tables<'_, S>) -> S::Vec3 {
        snap_tube::<S>(local, face, self.half_height, self.radius.widen())
    }

    fn normal(&self, local: S::Vec3, face: u32, _: &Tables<'_, S>) -> S::WideVec {
        match face {
            SIDE => S::widen_vec(local.with(Axis::Y, S::ZERO)),
            BASE => S::WideVec::ZERO.with(Axis::Y, -S::Wide::ONE),
            _ => S::WideVec::ZERO.with(Axis::Y, S::Wide::ONE),
        }
    }

    /// The side: the angle as u, the height as v, both in 0..=1. A cap: its square in 0..=1.
    fn uv(&self, local: S::Vec3, face: u32, _: &Tables<'_, S>) -> [S; 2] {
        tube_uv(local, face, self.half_height, self.radius)
    }
}

/// A ray that goes along the y axis, as far as its direction can tell.
#[inline]
pub(super) fn is_axial<T: Real>(across: T, dd: T) -> bool {
    across <= dd * T::EPSILON.squared()
}

/// Where a ray that starts on the side and goes inward meets it again.
#[inline]
fn other_root<S: Scalar>(ray: &Local<S>) -> S::Wide {
    let (l, d) = (ray.origin, ray.dir);
    let across = d.x().squared() + d.z().squared();
    if is_axial(across, ray.dd) {
        return S::Wide::FAR;
    }
    ((l.x() * d.x() + l.z() * d.z()) * S::Wide::TWO).abs() / across
}

/// The span of a ray from a face of a round body to its inner side: it ends at the side, if it
/// meets that at all, or at a cap, and is never empty.
#[inline]
pub(super) fn tube_exit<S: Scalar>(
    ray: &Local<S>,
    half_height: S,
    face: u32,
    side: Option<S::Wide>,
) -> Span<S> {
    let (y, dy, half_height) = (ray.origin.y(), ray.dir.y(), half_height.widen());
    let mut exit = End { t: side.unwrap_or(S::Wide::ZERO), face: SIDE };
    let mut offer = |t: S::Wide, face: u32| {
        if t < exit.t {
            exit = End { t, face };
        }
    };
    if dy > S::Wide::ZERO && face != TOP {
        offer((half_height - y) / dy, TOP);
    } else if dy < S::Wide::ZERO && face != BASE {
        offer((-half_height - y) / dy, BASE);
    }
    let exit = End { t: S::narrow(exit.t).max(S::TINY), face: exit.face };
    Span { enter: End { t: S::ZERO, face }, exit }
}

/// Gives the common part of a side and its caps, in the ray's own parameter.
#[inline]
pub(super) fn emit_common<S: Scalar>(
    ray: &Local<S>,
    mut span: Span<S::Wide>,
    caps: &Span<S::Wide>,
    mut emit: impl FnMut(Span<S>),
) {
    span.clip(caps);
    if span.is_open() {
        emit(span.map(|t| ray.arrive(t)));
    }
}

/// The span between two caps across the y axis, or `None` beside them. A ray in the plane of a
/// cap is between them.
#[inline]
pub(super) fn caps<S: Scalar>(ray: &Local<S>, half_height: S) -> Option<Span<S::Wide>> {
    let (y, inverse) = (ray.origin.y(), S::Wide::ONE / ray.dir.y());
    let half_height = half_height.widen();
    if !inverse.is_finite() {
        return (y.abs() <= half_height).then(Span::whole);
    }
    let low = End { t: (-half_height - y) * inverse, face: BASE };
    let high = End { t: (half_height - y) * inverse, face: TOP };
    Some(if inverse < S::Wide::ZERO {
        Span { enter: high, exit: low }
    } else {
        Span { enter: low, exit: high }
    })
}

/// A box around a round body along the local y axis.
pub(super) fn tube_bounds<S: Scalar>(
    place: Option<&Placement<S>>,
    center: S::Vec3,
    half_height: S,
    radius: S,
) -> Bounds<S> {
    let Some(place) = place else {
        return Bounds::about(center, S::Vec3::new(radius, half_height, radius));
    };
    let [x, y, z] = place.to_world.map(|row| {
        let across = row.with(Axis::Y, S::Wide::ZERO).length();
        S::narrow(row.y().abs() * half_height.widen() + across * radius.widen())
    });
    Bounds::about(place.anchor, S::Vec3::new(x, y, z))
}

/// The point of the side at this height and angle, or of a cap at this place.
pub(super) fn snap_tube<S: Scalar>(
    local: S::WideVec,
    face: u32,
    half_height: S,
    radius: S::Wide,
) -> S::Vec3 {
    let flat = local.with(Axis::Y, S::Wide::ZERO);
    let distance = flat.length();
    let (y, flat) = match face {
        SIDE => {
            let flat = if distance > S::Wide::ZERO {
                flat * (radius / distance)
            } else {
                S::WideVec::ZERO.with(Axis::X, radius)
            };
            (S::narrow(local.y()).clamp(-half_height, half_height), flat)
        }
        _ => {
            let flat = if distance > radius { flat * (radius / distance) } else { flat };
            (if face == BASE { -half_height } else { half_height }, flat)
        }
    };
    S::narrow_vec(flat).with(Axis::Y, y)
}

/// Texture coordinates of a round body along the local y axis.
pub(super) fn tube_uv<S: Scalar>(local: S::Vec3, face: u32, half_height: S, radius: S) -> [S; 2] {
    if face == SIDE {
        let v = share(local.y(), half_height);
        [turn(local.x(), local.z()), v]
    } else {
        [share(local.x(), radius), share(local.z(), radius)]
    }
}

/// Where a number lies between `-half` and `half`, in 0..=1.
fn share<S: Scalar>(v: S, half: S) -> S {
    S::narrow((v.widen() / half.widen() + S::Wide::ONE) * S::Wide::HALF)
}

//! The finite cylinder with its caps.

use super::{Flaw, Primitive, Sight, check_centre, check_length, turn};
use crate::bounds::Bounds;
use crate::place::{Local, Placement};
use crate::scalar::{Scalar, Vector};
use crate::span::{End, Span};

/// The side face of a cylinder or cone.
pub(super) const SIDE: u16 = 0;
/// The cap at the lower end of the axis.
pub(super) const BASE: u16 = 1;
/// The cap at the upper end of the axis.
pub(super) const TOP: u16 = 2;

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
    fn side(&self, ray: &Local<S>) -> Option<Span<S>> {
        let (l, d) = (ray.origin, ray.dir);
        let across = d.x().squared() + d.z().squared();
        if is_axial(across, ray.dd) {
            let square = self.radius.squared() - (l.x().squared() + l.z().squared());
            return (square > S::ZERO).then(Span::whole);
        }
        let inverse = S::ONE / across;
        let middle = -(l.x() * d.x() + l.z() * d.z()) * inverse;
        let (x, z) = (l.x() + d.x() * middle, l.z() + d.z() * middle);
        let square = self.radius.squared() - (x.squared() + z.squared());
        (square > S::ZERO).then(|| {
            let half = (square * inverse).sqrt();
            Span::of_face(SIDE, middle - half, middle + half)
        })
    }
}

impl<S: Scalar> Primitive<S> for Cylinder<S> {
    const OPEN: bool = false;
    const SPANS_MAX: u16 = 1;

    fn centre(&self) -> S::Vec3 {
        self.center
    }

    fn check(&self, placed: bool, _: &[S::Vec3]) -> Result<(), Flaw> {
        check_centre::<S>(self.center, placed)?;
        check_length(self.half_height, "half_height")?;
        check_length(self.radius, "radius")
    }

    fn bounds(&self, place: Option<&Placement<S>>, _: &[S::Vec3]) -> Bounds<S> {
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

    fn snap(&self, local: S::Vec3, face: u16) -> S::Vec3 {
        snap_tube(local, face, self.half_height, self.radius)
    }

    fn normal(&self, local: S::Vec3, face: u16, _: &[S::Vec3]) -> S::Vec3 {
        match face {
            SIDE => S::Vec3::new(local.x(), S::ZERO, local.z()),
            BASE => S::Vec3::new(S::ZERO, -S::ONE, S::ZERO),
            _ => S::Vec3::new(S::ZERO, S::ONE, S::ZERO),
        }
    }

    /// The side: the angle as u, the height as v, both in 0..=1. A cap: its square in 0..=1.
    fn uv(&self, local: S::Vec3, face: u16, _: &[S::Vec3]) -> [S; 2] {
        tube_uv(local, face, self.half_height, self.radius)
    }
}

/// A ray that goes along the y axis, as far as its direction can tell.
#[inline]
pub(super) fn is_axial<S: Scalar>(across: S, dd: S) -> bool {
    across <= dd * S::EPSILON.squared()
}

/// Where a ray that starts on the side and goes inward meets it again.
#[inline]
fn other_root<S: Scalar>(ray: &Local<S>) -> S {
    let (l, d) = (ray.origin, ray.dir);
    let across = d.x().squared() + d.z().squared();
    if is_axial(across, ray.dd) {
        return S::FAR;
    }
    ((l.x() * d.x() + l.z() * d.z()) * S::TWO).abs() / across
}

/// The span of a ray from a face of a round body to its inner side: it ends at the side, if it
/// meets that at all, or at a cap, and is never empty.
#[inline]
pub(super) fn tube_exit<S: Scalar>(
    ray: &Local<S>,
    half_height: S,
    face: u16,
    side: Option<S>,
) -> Span<S> {
    let (y, dy) = (ray.origin.y(), ray.dir.y());
    let mut exit = End { t: side.unwrap_or(S::ZERO), face: SIDE };
    let mut offer = |t: S, face: u16| {
        if t < exit.t {
            exit = End { t, face };
        }
    };
    if dy > S::ZERO && face != TOP {
        offer((half_height - y) / dy, TOP);
    } else if dy < S::ZERO && face != BASE {
        offer((-half_height - y) / dy, BASE);
    }
    exit.t = exit.t.max(S::TINY);
    Span { enter: End { t: S::ZERO, face }, exit }
}

/// Gives the common part of a side and its caps, in the ray's own parameter.
#[inline]
pub(super) fn emit_common<S: Scalar>(
    ray: &Local<S>,
    mut span: Span<S>,
    caps: &Span<S>,
    mut emit: impl FnMut(Span<S>),
) {
    span.clip(caps);
    if span.is_open() {
        span.enter.t += ray.shift;
        span.exit.t += ray.shift;
        emit(span);
    }
}

/// The span between two caps across the y axis, or `None` beside them. A ray in the plane of a
/// cap is between them.
#[inline]
pub(super) fn caps<S: Scalar>(ray: &Local<S>, half_height: S) -> Option<Span<S>> {
    let (y, inverse) = (ray.origin.y(), S::ONE / ray.dir.y());
    if !inverse.is_finite() {
        return (y.abs() <= half_height).then(Span::whole);
    }
    let low = End { t: (-half_height - y) * inverse, face: BASE };
    let high = End { t: (half_height - y) * inverse, face: TOP };
    Some(if inverse < S::ZERO {
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
        let across = S::Vec3::new(row.x(), S::ZERO, row.z()).length();
        row.y().abs() * half_height + across * radius
    });
    Bounds::about(place.anchor, S::Vec3::new(x, y, z))
}

/// The point of the side at this height and angle, or of a cap at this place.
pub(super) fn snap_tube<S: Scalar>(
    local: S::Vec3,
    face: u16,
    half_height: S,
    radius: S,
) -> S::Vec3 {
    let flat = S::Vec3::new(local.x(), S::ZERO, local.z());
    let distance = flat.length();
    match face {
        SIDE => {
            let y = local.y().clamp(-half_height, half_height);
            let flat = if distance > S::ZERO {
                flat * (radius / distance)
            } else {
                S::Vec3::new(radius, S::ZERO, S::ZERO)
            };
            S::Vec3::new(flat.x(), y, flat.z())
        }
        _ => {
            let flat = if distance > radius { flat * (radius / distance) } else { flat };
            let y = if face == BASE { -half_height } else { half_height };
            S::Vec3::new(flat.x(), y, flat.z())
        }
    }
}

/// Texture coordinates of a round body along the local y axis.
pub(super) fn tube_uv<S: Scalar>(local: S::Vec3, face: u16, half_height: S, radius: S) -> [S; 2] {
    if face == SIDE {
        let v = (local.y() / half_height + S::ONE) * S::HALF;
        [turn(local.x(), local.z()), v]
    } else {
        let across = |v: S| (v / radius + S::ONE) * S::HALF;
        [across(local.x()), across(local.z())]
    }
}

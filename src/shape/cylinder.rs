//! The finite cylinder with its caps.

use super::sphere::from_start;
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

    /// In the plane across the axis, with D = a·r² − (x·dz − z·dx)², clipped by the caps.
    #[inline]
    fn spans(&self, sight: &Sight<'_, S>, mut emit: impl FnMut(Span<S>)) {
        let start = sight.start.map(|start| (start.face, start.inward));
        let ray = local(sight, self.center);
        let (l, d) = (ray.origin, ray.dir);
        let across = d.x().squared() + d.z().squared();
        let mut span = if let Some((SIDE, inward)) = start {
            if across == S::ZERO {
                return;
            }
            let other = ((l.x() * d.x() + l.z() * d.z()) * S::TWO).abs() / across;
            from_start(inward, other)
        } else if across == S::ZERO {
            if l.x().squared() + l.z().squared() >= self.radius.squared() {
                return;
            }
            Span::whole()
        } else {
            let moment = l.x() * d.z() - l.z() * d.x();
            let discriminant = self.radius.squared() * across - moment.squared();
            if !(discriminant > S::ZERO) {
                return;
            }
            let (root, inverse) = (discriminant.sqrt(), S::ONE / across);
            let middle = -(l.x() * d.x() + l.z() * d.z());
            Span::of_face(SIDE, (middle - root) * inverse, (middle + root) * inverse)
        };
        match caps(&ray, self.half_height, start) {
            Some(caps) => span.clip(&caps),
            None => return,
        }
        if span.is_open() {
            span.enter.t += ray.shift;
            span.exit.t += ray.shift;
            emit(span);
        }
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

/// The ray in the coordinates of a leaf with a centre, from its surface where it starts there.
#[inline]
pub(super) fn local<S: Scalar>(sight: &Sight<'_, S>, centre: S::Vec3) -> Local<S> {
    match sight.start {
        Some(start) => Local::from_surface(sight.line, sight.place, start.local),
        None => Local::recentred(sight.line, sight.place, centre),
    }
}

/// The span between two caps across the y axis, or `None` beside them.
#[inline]
pub(super) fn caps<S: Scalar>(
    ray: &Local<S>,
    half_height: S,
    start: Option<(u16, bool)>,
) -> Option<Span<S>> {
    let (y, dy) = (ray.origin.y(), ray.dir.y());
    let face = start.map(|(face, _)| face);
    if dy == S::ZERO {
        let within = face != Some(BASE) && face != Some(TOP) && y.abs() <= half_height;
        return within.then(Span::whole);
    }
    let inverse = S::ONE / dy;
    let end = |side: S, cap: u16| {
        let t = if face == Some(cap) { S::ZERO } else { (side - y) * inverse };
        End { t, face: cap }
    };
    let (low, high) = (end(-half_height, BASE), end(half_height, TOP));
    Some(if dy < S::ZERO {
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

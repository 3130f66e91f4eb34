//! The cone and the frustum with their caps.

use super::cylinder::{BASE, SIDE, TOP, caps, local, snap_tube, tube_bounds, tube_uv};
use super::sphere::from_start;
use super::{Flaw, Primitive, Sight, check_centre, check_length};
use crate::bounds::Bounds;
use crate::place::{Local, Placement};
use crate::scalar::{Scalar, Vector};
use crate::span::Span;

/// A frustum about the local y axis, closed by caps; a cone where one radius is 0.
/// Faces: 0 the side, 1 the base (−y), 2 the top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone<S: Scalar> {
    /// The middle of the axis; zero for a placed cone.
    pub center: S::Vec3,
    /// Half the distance between the caps, greater than 0.
    pub half_height: S,
    /// The radius at the lower end, at least 0.
    pub base_radius: S,
    /// The radius at the upper end, at least 0.
    pub top_radius: S,
}

impl<S: Scalar> Cone<S> {
    /// How much the radius grows per unit of height.
    #[inline]
    fn slope(&self) -> S {
        (self.top_radius - self.base_radius) / (self.half_height * S::TWO)
    }

    /// The radius at a height, continued in a straight line beyond the caps.
    #[inline]
    fn radius_at(&self, y: S) -> S {
        (self.base_radius + self.top_radius) * S::HALF + self.slope() * y
    }

    fn radius_max(&self) -> S {
        self.base_radius.max(self.top_radius)
    }

    /// The span inside the nappe that the frustum is cut from, or `None` beside it.
    #[inline]
    fn nappe(&self, ray: &Local<S>, start: Option<(u16, bool)>) -> Option<Span<S>> {
        let (l, d) = (ray.origin, ray.dir);
        let (m0, m1) = (self.radius_at(l.y()), self.slope() * d.y());
        let across = d.x().squared() + d.z().squared();
        let a = across - m1.squared();
        let b = l.x() * d.x() + l.z() * d.z() - m0 * m1;
        if let Some((SIDE, inward)) = start {
            // Outside of two roots a steep ray stays in its nappe for ever.
            let other = if a > S::ZERO { (b * S::TWO).abs() / a } else { S::FAR };
            return Some(from_start(inward, other));
        }
        let (px, pz) = (m0 * d.x() - m1 * l.x(), m0 * d.z() - m1 * l.z());
        let moment = l.x() * d.z() - l.z() * d.x();
        let discriminant = px.squared() + pz.squared() - moment.squared();
        if !(discriminant > S::ZERO) {
            return None;
        }
        let root = discriminant.sqrt();
        let c = l.x().squared() + l.z().squared() - m0.squared();
        // Both roots without cancellation: q/a and c/q.
        let q = if b < S::ZERO { root - b } else { -(root + b) };
        let (first, second) = (c / q, q / a);
        if a > S::ZERO {
            let (enter, exit) = (first.min(second), first.max(second));
            let radius = m0 + m1 * ((enter + exit) * S::HALF);
            (radius > S::ZERO).then(|| Span::of_face(SIDE, enter, exit))
        } else if a < S::ZERO {
            let (low, high) = (first.min(second), first.max(second));
            Some(if m1 > S::ZERO {
                Span::of_face(SIDE, high, S::FAR)
            } else {
                Span::of_face(SIDE, -S::FAR, low)
            })
        } else {
            // Parallel to a line of the side: one root.
            Some(if b > S::ZERO {
                Span::of_face(SIDE, -S::FAR, first)
            } else {
                Span::of_face(SIDE, first, S::FAR)
            })
        }
    }
}

impl<S: Scalar> Primitive<S> for Cone<S> {
    const OPEN: bool = false;
    const SPANS_MAX: u16 = 1;

    fn centre(&self) -> S::Vec3 {
        self.center
    }

    fn check(&self, placed: bool, _: &[S::Vec3]) -> Result<(), Flaw> {
        check_centre::<S>(self.center, placed)?;
        check_length(self.half_height, "half_height")?;
        for (radius, field) in [(self.base_radius, "base_radius"), (self.top_radius, "top_radius")]
        {
            // One end may be a point.
            if radius != S::ZERO {
                check_length(radius, field)?;
            }
        }
        if self.radius_max() == S::ZERO { Err(Flaw::Empty("base_radius")) } else { Ok(()) }
    }

    fn bounds(&self, place: Option<&Placement<S>>, _: &[S::Vec3]) -> Bounds<S> {
        tube_bounds(place, self.center, self.half_height, self.radius_max())
    }

    /// The quadric x² + z² = (m + s·y)² in the plane across the axis, with the discriminant as
    /// a sum of squares; the nappe that holds the frustum, clipped by the caps.
    #[inline]
    fn spans(&self, sight: &Sight<'_, S>, mut emit: impl FnMut(Span<S>)) {
        let start = sight.start.map(|start| (start.face, start.inward));
        let ray = local(sight, self.center);
        let (Some(mut span), Some(caps)) =
            (self.nappe(&ray, start), caps(&ray, self.half_height, start))
        else {
            return;
        };
        span.clip(&caps);
        if span.is_open() {
            span.enter.t += ray.shift;
            span.exit.t += ray.shift;
            emit(span);
        }
    }

    fn snap(&self, local: S::Vec3, face: u16) -> S::Vec3 {
        let radius = match face {
            SIDE => self.radius_at(local.y().clamp(-self.half_height, self.half_height)),
            BASE => self.base_radius,
            _ => self.top_radius,
        };
        snap_tube(local, face, self.half_height, radius.max(S::ZERO))
    }

    fn normal(&self, local: S::Vec3, face: u16, _: &[S::Vec3]) -> S::Vec3 {
        match face {
            SIDE => {
                let radius = self.radius_at(local.y());
                let side = S::Vec3::new(local.x(), -self.slope() * radius, local.z());
                if side == S::Vec3::ZERO {
                    // The apex looks along the axis.
                    let up = if self.slope() < S::ZERO { S::ONE } else { -S::ONE };
                    S::Vec3::new(S::ZERO, up, S::ZERO)
                } else {
                    side
                }
            }
            TOP => S::Vec3::new(S::ZERO, S::ONE, S::ZERO),
            _ => S::Vec3::new(S::ZERO, -S::ONE, S::ZERO),
        }
    }

    /// As a cylinder of the greater radius.
    fn uv(&self, local: S::Vec3, face: u16, _: &[S::Vec3]) -> [S; 2] {
        tube_uv(local, face, self.half_height, self.radius_max())
    }
}

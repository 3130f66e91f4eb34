//! The cone and the frustum with their caps.

use super::cylinder::{
    BASE, SIDE, TOP, caps, emit_common, is_axial, snap_tube, tube_bounds, tube_exit, tube_uv,
};
use super::{Flaw, Primitive, Sight, Tables, check_centre, check_length};
use crate::bounds::Bounds;
use crate::place::{Local, Placement};
use crate::scalar::{Axis, Number, Real, Scalar, Vector};
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

/// The line that sweeps out the side, as `rise·ρ = radius + growth·y` in the distance ρ from
/// the axis and the height y above the middle; the greater of |rise| and |growth| is 1, so that
/// neither flat nor slender cones overflow.
#[derive(Clone, Copy)]
struct Slant<S> {
    rise: S,
    growth: S,
    radius: S,
}

impl<S: Scalar> Cone<S> {
    #[inline]
    fn slant(&self) -> Slant<S::Wide> {
        let (base, top) = (self.base_radius.widen(), self.top_radius.widen());
        let (growth, rise) = (top - base, self.half_height.widen() * S::Wide::TWO);
        let (rise, growth) = if growth.abs() <= rise {
            (S::Wide::ONE, growth / rise)
        } else if growth > S::Wide::ZERO {
            (rise / growth, S::Wide::ONE)
        } else {
            (rise / -growth, -S::Wide::ONE)
        };
        Slant { rise, growth, radius: (base + top) * S::Wide::HALF * rise }
    }

    /// The radius at a height between the caps.
    fn radius_at(&self, y: S::Wide) -> S::Wide {
        let share = (y / self.half_height.widen() + S::Wide::ONE) * S::Wide::HALF;
        self.base_radius.widen() * (S::Wide::ONE - share) + self.top_radius.widen() * share
    }

    fn radius_max(&self) -> S {
        self.base_radius.max(self.top_radius)
    }

    /// The span inside the nappe that the frustum is cut from, or `None` beside it.
    #[inline]
    fn nappe(&self, ray: &Local<S>) -> Option<Span<S::Wide>> {
        let Slant { rise, growth, radius } = self.slant();
        let (l, d) = (ray.origin, ray.dir);
        let (m0, m1) = (radius + growth * l.y(), growth * d.y());
        let across = d.x().squared() + d.z().squared();
        let distance = l.x().squared() + l.z().squared();
        if is_axial(across, ray.dd) {
            let gap = rise * distance.sqrt() - m0;
            return if m1 == S::Wide::ZERO {
                (gap < S::Wide::ZERO).then(Span::whole)
            } else {
                Some(half_line(m1 > S::Wide::ZERO, gap / m1))
            };
        }
        let (px, pz) = (m0 * d.x() - m1 * l.x(), m0 * d.z() - m1 * l.z());
        let moment = (l.x() * d.z() - l.z() * d.x()) * rise;
        let discriminant = px.squared() + pz.squared() - moment.squared();
        let a = across * rise.squared() - m1.squared();
        // A ray steeper than the side always meets both nappes.
        if a >= S::Wide::ZERO && discriminant <= S::Wide::ZERO {
            return None;
        }
        let root = discriminant.sqrt() * rise;
        let b = (l.x() * d.x() + l.z() * d.z()) * rise.squared() - m0 * m1;
        let c = distance * rise.squared() - m0.squared();
        // Both roots without cancellation: q/a and c/q.
        let q = if b < S::Wide::ZERO { root - b } else { -(root + b) };
        if q == S::Wide::ZERO {
            // Through the tip.
            return (a < S::Wide::ZERO).then(|| half_line(m1 > S::Wide::ZERO, S::Wide::ZERO));
        }
        let (first, second) = (c / q, q / a);
        if a > S::Wide::ZERO {
            let (enter, exit) = (first.min(second), first.max(second));
            let radius = m0 + m1 * ((enter + exit) * S::Wide::HALF);
            (radius > S::Wide::ZERO).then(|| Span::of_face(SIDE, enter, exit))
        } else if a < S::Wide::ZERO {
            let upward = m1 > S::Wide::ZERO;
            let t = if upward { first.max(second) } else { first.min(second) };
            Some(half_line(upward, t))
        } else {
            // Parallel to a line of the side: one root.
            Some(half_line(b < S::Wide::ZERO, first))
        }
    }

    /// Where a ray that starts on the side and goes inward meets it again.
    #[inline]
    fn other_root(&self, ray: &Local<S>) -> S::Wide {
        let Slant { rise, growth, radius } = self.slant();
        let (l, d) = (ray.origin, ray.dir);
        let (m0, m1) = (radius + growth * l.y(), growth * d.y());
        let a = (d.x().squared() + d.z().squared()) * rise.squared() - m1.squared();
        let b = (l.x() * d.x() + l.z() * d.z()) * rise.squared() - m0 * m1;
        // A ray steeper than the side stays in its nappe for ever.
        if a > S::Wide::ZERO { (b * S::Wide::TWO).abs() / a } else { S::Wide::FAR }
    }
}

/// What lies after t, or before it.
#[inline]
fn half_line<T: Real>(after: bool, t: T) -> Span<T> {
    if after { Span::of_face(SIDE, t, T::FAR) } else { Span::of_face(SIDE, -T::FAR, t) }
}

impl<S: Scalar> Primitive<S> for Cone<S> {
    fn centre(&self) -> S::Vec3 {
        self.center
    }

    fn check(&self, placed: bool, _: &Tables<'_, S>) -> Result<(), Flaw> {
        check_centre::<S>(self.center, placed)?;
        check_length(self.half_height, "half_height")?;
        for (radius, field) in [(self.base_radius, "base_radius"), (self.top_radius, "top_radius")]
        {
            // One end may be a point.
            if radius != S::ZERO {
                check_length(radius, field)?;
            }
        }
        if self.radius_max() == S::ZERO {
            return Err(Flaw::Empty("base_radius"));
        }
        // Flatter than this it is a disc as far as the number format can tell.
        let growth = (self.top_radius - self.base_radius).abs();
        let flat = self.half_height.widen() < S::rounding(growth.widen());
        if flat { Err(Flaw::NotPositive("half_height")) } else { Ok(()) }
    }

    fn bounds(&self, place: Option<&Placement<S>>, _: &Tables<'_, S>) -> Bounds<S> {
        tube_bounds(place, self.center, self.half_height, self.radius_max())
    }

    /// The quadric of the side in the plane across the axis, with the discriminant as a sum of
    /// squares; the nappe that holds the frustum, clipped by the caps.
    #[inline]
    fn spans(&self, sight: &Sight<'_, S>, mut emit: impl FnMut(Span<S>)) {
        if let Some(start) = sight.start {
            if start.inward {
                let ray = Local::from_surface(sight.line, sight.place, start.local);
                let side = if start.face == SIDE {
                    Some(self.other_root(&ray))
                } else {
                    self.nappe(&ray).map(|span| span.exit.t)
                };
                emit(tube_exit(&ray, self.half_height, start.face, side));
            }
            return;
        }
        let ray = Local::recentred(sight.line, sight.place, self.center);
        let (Some(side), Some(caps)) = (self.nappe(&ray), caps(&ray, self.half_height)) else {
            return;
        };
        emit_common(&ray, side, &caps, emit);
    }

    fn snap(&self, local: S::WideVec, face: u32, _: &Tables<'_, S>) -> S::Vec3 {
        let half_height = self.half_height.widen();
        let radius = match face {
            SIDE => self.radius_at(local.y().clamp(-half_height, half_height)),
            BASE => self.base_radius.widen(),
            _ => self.top_radius.widen(),
        };
        snap_tube::<S>(local, face, self.half_height, radius.max(S::Wide::ZERO))
    }

    fn normal(&self, local: S::Vec3, face: u32, _: &Tables<'_, S>) -> S::WideVec {
        match face {
            SIDE => {
                let Slant { rise, growth, .. } = self.slant();
                let local = S::widen_vec(local);
                let distance = local.with(Axis::Y, S::Wide::ZERO).length();
                if distance == S::Wide::ZERO {
                    // The tip looks along the axis.
                    let up = growth < S::Wide::ZERO;
                    return S::WideVec::ZERO
                        .with(Axis::Y, if up { S::Wide::ONE } else { -S::Wide::ONE });
                }
                S::WideVec::new(local.x() * rise, -growth * distance, local.z() * rise)
            }
            TOP => S::WideVec::ZERO.with(Axis::Y, S::Wide::ONE),
            _ => S::WideVec::ZERO.with(Axis::Y, -S::Wide::ONE),
        }
    }

    /// As a cylinder of the greater radius.
    fn uv(&self, local: S::Vec3, face: u32, _: &Tables<'_, S>) -> [S; 2] {
        tube_uv(local, face, self.half_height, self.radius_max())
    }
}

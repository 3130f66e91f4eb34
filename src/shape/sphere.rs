//! The ball, and by placement the ellipsoid.

use super::{Flaw, Primitive, Sight, Tables, check_centre, check_length, turn};
use crate::bounds::Bounds;
use crate::place::{Local, Placement};
use crate::scalar::{Axis, Number, Real, Scalar, Vector};
use crate::span::Span;

/// A ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere<S: Scalar> {
    /// The middle; zero for a placed ball.
    pub center: S::Vec3,
    /// The radius, greater than 0.
    pub radius: S,
}

impl<S: Scalar> Primitive<S> for Sphere<S> {
    fn centre(&self) -> S::Vec3 {
        self.center
    }

    fn check(&self, placed: bool, _: &Tables<'_, S>) -> Result<(), Flaw> {
        check_centre::<S>(self.center, placed)?;
        check_length(self.radius, "radius")
    }

    fn bounds(&self, place: Option<&Placement<S>>, _: &Tables<'_, S>) -> Bounds<S> {
        match place {
            None => Bounds::about(self.center, S::Vec3::splat(self.radius)),
            Some(place) => {
                let radius = self.radius.widen();
                let [x, y, z] = place.to_world.map(|row| S::narrow(row.length() * radius));
                Bounds::about(place.anchor, S::Vec3::new(x, y, z))
            }
        }
    }

    /// Recentred on the point nearest to the centre, where half the chord is √(r² − m²) in
    /// plain arithmetic; a ray from the surface has its other root at −2b/a.
    #[inline]
    fn spans(&self, sight: &Sight<'_, S>, mut emit: impl FnMut(Span<S>)) {
        if let Some(start) = sight.start {
            if start.inward {
                let ray = Local::from_surface(sight.line, sight.place, start.local);
                let other = (ray.origin.dot(ray.dir) * S::Wide::TWO).abs() * ray.inv_dd;
                emit(Span::of_face(0, S::ZERO, S::narrow(other).max(S::TINY)));
            }
            return;
        }
        if sight.place.is_none() && !sight.line.may_pass(self.center, self.radius) {
            return;
        }
        let ray = Local::recentred(sight.line, sight.place, self.center);
        let middle = -ray.origin.dot(ray.dir) * ray.inv_dd;
        let nearest = ray.origin + ray.dir * middle;
        let square = self.radius.widen().squared() - nearest.length_squared();
        if square > S::Wide::ZERO {
            let half = (square * ray.inv_dd).sqrt();
            emit(Span::of_face(0, ray.arrive(middle - half), ray.arrive(middle + half)));
        }
    }

    fn snap(&self, local: S::WideVec, _: u32, _: &Tables<'_, S>) -> S::Vec3 {
        let snapped = S::narrow_vec(local.normalize() * self.radius.widen());
        if snapped == S::Vec3::ZERO { S::Vec3::ZERO.with(Axis::Y, self.radius) } else { snapped }
    }

    fn normal(&self, local: S::Vec3, _: u32, _: &Tables<'_, S>) -> S::WideVec {
        S::widen_vec(local)
    }

    /// Longitude from −x through −z as u, latitude from the south pole (−y) as v, both in 0..=1.
    fn uv(&self, local: S::Vec3, _: u32, _: &Tables<'_, S>) -> [S; 2] {
        let angle = (local.y().widen() / self.radius.widen()).acos();
        [turn(local.x(), local.z()), S::narrow(S::Wide::ONE - angle / S::Wide::PI)]
    }
}

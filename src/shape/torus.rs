//! The torus: ring, horn and spindle.

use super::{Flaw, Primitive, Sight, Tables, check_centre, check_length, turn};
use crate::bounds::Bounds;
use crate::place::{Local, Placement};
use crate::roots::{Knots, crossings_between, knots};
use crate::scalar::{Axis, Number, Pair, Real, Scalar, Vector};
use crate::span::Span;

/// All points within `minor` of a circle of radius `major` about the local y axis: what the turning
/// disc `(ρ − major)² + y² ≤ minor²` sweeps over, in the distance ρ from the axis and the height y.
///
/// A ring where `minor < major`; a horn where they are equal; beyond that a spindle, filled: the
/// lens about the axis, which the disc passes twice, is inside as well, and only the outer skin is surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Torus<S: Scalar> {
    /// The middle; zero for a placed torus.
    pub center: S::Vec3,
    /// The radius of the circle, greater than 0.
    pub major: S,
    /// The radius of the tube, greater than 0 and no thinner than the number format resolves on the circle.
    pub minor: S,
}

/// A torus and a ray in its coordinates.
struct Crossing<'a, S: Scalar> {
    sight: &'a Sight<'a, S>,
    ray: &'a Local<S>,
    anchor: S::Vec3,
    major: S::Wide,
    minor: S::Wide,
    /// How far rounding may move a point of the ray near the torus.
    noise: S::Wide,
}

/// Parameters at which a ray goes in and out in turns, ascending.
struct Ends<S> {
    at: [S; 4],
    len: u32,
}

impl<S: Scalar> Torus<S> {
    fn crossing<'a>(&self, sight: &'a Sight<'a, S>, ray: &'a Local<S>) -> Crossing<'a, S> {
        let (major, minor) = (self.major.widen(), self.minor.widen());
        let four = S::Wide::TWO + S::Wide::TWO;
        let noise = (ray.origin.max_abs() + major + minor) * S::Wide::EPSILON * four;
        let anchor = sight.place.map_or(self.center, |place| place.anchor);
        Crossing { sight, ray, anchor, major, minor, noise }
    }

    /// Where the ray goes in and out.
    #[inline(never)]
    fn crossings(&self, sight: &Sight<'_, S>) -> Ends<S> {
        let mut found = Ends::none();
        let ray = Local::recentred(sight.line, sight.place, self.center);
        let crossing = self.crossing(sight, &ray);
        if let Some(reach) = crossing.reach() {
            let pieces = crossing.pieces(reach);
            let depth = |t| crossing.depth(t);
            crossings_between(pieces.as_slice(), reach, depth, |t| found.push(ray.arrive(t)));
        }
        found
    }

    /// Where a ray that starts on the surface comes through it again: the quartic has lost its
    /// constant term, and what is left is a cubic, whose sign at the start is known.
    #[inline(never)]
    fn later_crossings(&self, sight: &Sight<'_, S>, local: S::Vec3, inward: bool) -> Ends<S> {
        let mut found = Ends::none();
        let ray = Local::from_surface(sight.line, sight.place, local);
        let crossing = self.crossing(sight, &ray);
        let far = crossing.reach().map_or(S::Wide::ZERO, |[_, far]| far);
        if inward {
            found.push(S::ZERO);
        }
        let size = crossing.major + crossing.minor;
        let inverse = S::Wide::ONE / size;
        let (l, d) = (ray.origin * inverse, ray.dir);
        let (m, flat) = (l.dot(d), S::Wide::ZERO);
        let (across, major) = (d.with(Axis::Y, flat).length_squared(), crossing.major * inverse);
        let rho = l.with(Axis::Y, flat).length_squared().sqrt();
        let four = S::Wide::TWO + S::Wide::TWO;
        // The derivative of dd²·u³ + 4·m·dd·u² + (4m² + 4R·ρ·dd − 4R²·a)·u + …, divided by dd.
        let derivative = [
            ((m.squared() - major.squared() * across) * ray.inv_dd + major * rho) * four,
            m * four * S::Wide::TWO,
            ray.dd * (S::Wide::ONE + S::Wide::TWO),
        ];
        let ends = [S::Wide::ZERO, far];
        let knots = knots(&derivative, ends.map(|t| t * inverse)).map(|u| u * size);
        let f = |t: S::Wide| {
            let [value, slope] = crossing.deflated(t);
            if t > S::Wide::ZERO {
                return [value, slope];
            }
            // Rounding has no say in where a ray goes that starts here.
            let value = value.abs().max(S::Wide::TINY);
            [if inward { -value } else { value }, slope]
        };
        if far > S::Wide::ZERO {
            crossings_between(knots.as_slice(), ends, f, |t| found.push(S::narrow(t).max(S::TINY)));
        }
        if found.len % 2 == 1 {
            found.push(S::TINY);
        }
        found
    }
}

impl<S: Scalar> Crossing<'_, S> {
    /// Where to cut the ray into pieces with one end of a span at most: the roots of the derivative of
    /// the quartic within the reach of the torus.
    fn pieces(&self, reach: [S::Wide; 2]) -> Knots<S::Wide, 4> {
        let ray = self.ray;
        // From the nearest point on, and in u, counted in radii of the whole, the quartic is
        // (dd·u² + e)² − 4R²·(a·u² + 2·b·u + c): its derivative lacks the square.
        let size = self.major + self.minor;
        let inverse = S::Wide::ONE / size;
        let middle = -ray.origin.dot(ray.dir) * ray.inv_dd;
        let (l, d) = ((ray.origin + ray.dir * middle) * inverse, ray.dir);
        let flat = S::Wide::ZERO;
        let (a, b) = (d.with(Axis::Y, flat).length_squared(), l.with(Axis::Y, flat).dot(d));
        let e = l.length_squared() + (self.major - self.minor) * inverse;
        let square = (self.major * inverse).squared() * S::Wide::TWO;
        // A quarter of it, divided by dd.
        let derivative = [-(square * b) * ray.inv_dd, e - square * a * ray.inv_dd, flat, ray.dd];
        let ends = reach.map(|t| (t - middle) * inverse);
        knots(&derivative, ends).map(|u| middle + u * size)
    }

    /// A stretch of the ray outside of which there is no torus, and at whose ends it is
    /// certainly left: within the ball around it and between the planes above and below.
    fn reach(&self) -> Option<[S::Wide; 2]> {
        let (ray, one) = (self.ray, S::Wide::ONE);
        let more = one + S::Wide::from_ratio(1, 64);
        let middle = -ray.origin.dot(ray.dir) * ray.inv_dd;
        let nearest = ray.origin + ray.dir * middle;
        let ball = (self.major + self.minor) * more + self.noise;
        let square = ball.squared() - nearest.length_squared();
        if !(square > S::Wide::ZERO) {
            return None;
        }
        let half = (square * ray.inv_dd).sqrt();
        let (mut low, mut high) = (middle - half, middle + half);
        let height = self.minor * more + self.noise * S::Wide::TWO;
        let (y, inverse) = (ray.origin.y(), one / ray.dir.y());
        if inverse.is_finite() {
            let (down, up) = ((-height - y) * inverse, (height - y) * inverse);
            low = low.max(down.min(up));
            high = high.min(down.max(up));
        } else if y.abs() > height {
            return None;
        }
        (low < high).then_some([low, high])
    }

    /// `(ρ − R)² + y² − r²` at a point of the ray, and its slope: negative inside. Beside the circle
    /// of the quartic's other factor, which is negative in the lens of a spindle, this is the quartic.
    #[inline(never)]
    fn depth(&self, t: S::Wide) -> [S::Wide; 2] {
        let (p, d) = (self.ray.origin + self.ray.dir * t, self.ray.dir);
        let rho = (p.x().squared() + p.z().squared()).sqrt();
        let (outward, y) = (rho - self.major, p.y());
        let speed = speed(p.x() * d.x() + p.z() * d.z(), rho);
        let slope = (outward * speed + y * d.y()) * S::Wide::TWO;
        let square = outward.squared() + y.squared();
        let mut value = square - self.minor.squared();
        if S::PAIRS {
            let doubt = (outward.abs() + y.abs() + self.noise) * self.noise * S::Wide::TWO;
            let grazes = slope.squared() <= square * self.ray.dd;
            if grazes && value.abs() <= doubt {
                value = self.exact_depth(t);
            }
        }
        [value, slope]
    }

    /// The same value in twice the precision, from the ray as it was given.
    #[inline(never)]
    fn exact_depth(&self, t: S::Wide) -> S::Wide {
        let (line, shift) = (self.sight.line, self.ray.shift);
        let from = line.recentred(self.anchor, shift);
        let rest = line.recentred_rest(self.anchor, shift);
        let along = line.heading();
        let point = Axis::ALL.map(|axis| {
            let from = Pair::new(from.get(axis), rest.get(axis));
            from.plus(Pair::product(along.get(axis), t))
        });
        let [x, y, z] = match self.sight.place {
            None => point,
            Some(place) => place.to_local.map(|row| {
                let [x, y, z] = point;
                x.times(row.x()).plus(y.times(row.y())).plus(z.times(row.z()))
            }),
        };
        let outward = x.squared().plus(z.squared()).sqrt().less(self.major);
        let square = outward.squared().plus(y.squared());
        square.plus(Pair::product(-self.minor, self.minor)).high
    }

    /// What [`depth`](Self::depth) is when its root at the start is divided out, and the slope of that:
    /// `(depth(t) − depth(0))/t` without a difference of like terms.
    #[inline(never)]
    fn deflated(&self, t: S::Wide) -> [S::Wide; 2] {
        let (l, d) = (self.ray.origin, self.ray.dir);
        let p = l + d * t;
        let across = d.x().squared() + d.z().squared();
        let start = (l.x().squared() + l.z().squared()).sqrt();
        let rho = (p.x().squared() + p.z().squared()).sqrt();
        let sum = start + rho;
        let outward = (start - self.major) + (rho - self.major);
        // (ρ² − ρ₀²)/t.
        let growth = (l.x() * d.x() + l.z() * d.z()) * S::Wide::TWO + across * t;
        let speed = speed(p.x() * d.x() + p.z() * d.z(), rho);
        let upward = d.y() * (l.y() * S::Wide::TWO + d.y() * t);
        if !(sum > S::Wide::ZERO) {
            // Along the axis.
            return [upward, d.y().squared()];
        }
        let value = upward + growth * outward / sum;
        let bend = growth * speed * self.major * S::Wide::TWO / sum;
        [value, d.y().squared() + (across * outward + bend) / sum]
    }
}

/// How fast ρ grows, from half the growth of its square; 0 on the axis.
#[inline]
fn speed<T: Real>(half: T, rho: T) -> T {
    if rho > T::ZERO { half / rho } else { T::ZERO }
}

impl<S: Scalar> Ends<S> {
    fn none() -> Self {
        Self { at: [S::ZERO; 4], len: 0 }
    }

    fn push(&mut self, t: S) {
        if let Some(slot) = self.at.get_mut(self.len as usize) {
            *slot = t;
            self.len += 1;
        }
    }

    /// The spans between them; a gap without a number in it is none.
    // Out of line: what it keeps on the stack is there for such solids only.
    #[inline(never)]
    fn spans(&self, mut emit: impl FnMut(Span<S>)) {
        let [a, b, c, d] = self.at;
        if self.len < 2 {
            return;
        }
        let first = Span::of_face(0, a, b).solid();
        if self.len < 4 {
            emit(first);
        } else if first.exit.t < c {
            emit(first);
            emit(Span::of_face(0, c, d));
        } else {
            emit(Span::of_face(0, a, d));
        }
    }
}

impl<S: Scalar> Primitive<S> for Torus<S> {
    fn centre(&self) -> S::Vec3 {
        self.center
    }

    fn check(&self, placed: bool, _: &Tables<'_, S>) -> Result<(), Flaw> {
        check_centre::<S>(self.center, placed)?;
        check_length(self.major, "major")?;
        check_length(self.minor, "minor")?;
        // Thinner than this, the circle is not where the tube is.
        let thin = self.minor.widen() < S::rounding(self.major.widen()) * S::Wide::from_i32(16);
        if thin { Err(Flaw::NotPositive("minor")) } else { Ok(()) }
    }

    fn bounds(&self, place: Option<&Placement<S>>, _: &Tables<'_, S>) -> Bounds<S> {
        let Some(place) = place else {
            let radius = self.major + self.minor;
            return Bounds::about(self.center, S::Vec3::new(radius, self.minor, radius));
        };
        let [x, y, z] = place.to_world.map(|row| {
            let across = row.with(Axis::Y, S::Wide::ZERO).length();
            S::narrow(across * self.major.widen() + row.length() * self.minor.widen())
        });
        Bounds::about(place.anchor, S::Vec3::new(x, y, z))
    }

    /// Between the roots of the quartic's derivative the ray is cut into pieces with one end of a
    /// span at most; each is found on `(ρ − R)² + y² − r²` by bracketed Newton, in twice the precision where
    /// the ray grazes the surface. Outside of the ball and the two planes around the torus the
    /// sign is certain, so the number of ends is even.
    #[inline]
    fn spans(&self, sight: &Sight<'_, S>, emit: impl FnMut(Span<S>)) {
        let ends = match sight.start {
            Some(start) => self.later_crossings(sight, start.local, start.inward),
            None => {
                let radius = self.major + self.minor;
                if sight.place.is_none() && !sight.line.may_pass(self.center, radius) {
                    return;
                }
                self.crossings(sight)
            }
        };
        ends.spans(emit);
    }

    fn snap(&self, local: S::WideVec, _: u32, _: &Tables<'_, S>) -> S::Vec3 {
        let (major, minor, zero) = (self.major.widen(), self.minor.widen(), S::Wide::ZERO);
        let flat = local.with(Axis::Y, zero);
        let rho = flat.length();
        let side = if rho > zero {
            flat * (S::Wide::ONE / rho)
        } else {
            S::WideVec::ZERO.with(Axis::X, S::Wide::ONE)
        };
        let (outward, y) = (rho - major, local.y());
        let distance = S::WideVec::new(outward, y, zero).length();
        let (outward, y) = if distance > zero {
            (outward * (minor / distance), y * (minor / distance))
        } else {
            (zero, minor)
        };
        let rho = major + outward;
        if rho < zero {
            // Past the tip of a spindle.
            let tip = ((minor - major) * (minor + major)).sqrt();
            let y = if y < zero { -tip } else { tip };
            return S::Vec3::ZERO.with(Axis::Y, S::narrow(y));
        }
        S::narrow_vec((side * rho).with(Axis::Y, y))
    }

    fn normal(&self, local: S::Vec3, _: u32, _: &Tables<'_, S>) -> S::WideVec {
        let local = S::widen_vec(local);
        let flat = local.with(Axis::Y, S::Wide::ZERO);
        let rho = flat.length();
        if rho > S::Wide::ZERO {
            let normal = (flat * ((rho - self.major.widen()) / rho)).with(Axis::Y, local.y());
            if normal.max_abs() > S::Wide::ZERO {
                return normal;
            }
        }
        // The tip of a spindle looks along the axis.
        let up = S::WideVec::ZERO.with(Axis::Y, S::Wide::ONE);
        if local.y() < S::Wide::ZERO { -up } else { up }
    }

    /// The angle around the axis as u, from −x through −z, and the angle around the tube as v, from the
    /// inner side upside down through the lower, the outer and the upper side; both in 0..=1.
    fn uv(&self, local: S::Vec3, _: u32, _: &Tables<'_, S>) -> [S; 2] {
        let flat = S::widen_vec(local).with(Axis::Y, S::Wide::ZERO);
        let outward = S::narrow(flat.length() - self.major.widen());
        [turn(local.x(), local.z()), turn(outward, local.y())]
    }
}

#[cfg(test)]
mod tests;

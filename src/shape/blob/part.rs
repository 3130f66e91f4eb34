//! What one component of a blob is along a ray: one stretch, or three, of the square of a quadratic.

use super::Component;
use crate::scalar::{Number, Real, Scalar, Vector};

/// A ray near a blob, by the way along it: from a point, in a direction of unit length.
#[derive(Clone, Copy)]
pub(super) struct Path<S: Scalar> {
    pub(super) origin: S::WideVec,
    pub(super) dir: S::WideVec,
}

/// A stretch of a ray on which `height − (rate·(s − middle))²` is how much of a component is there, in
/// 0..=1; s is the way along the ray.
#[derive(Clone, Copy)]
pub(super) struct Part<T> {
    middle: T,
    height: T,
    rate: T,
    /// Of the component.
    pub(super) strength: T,
    pub(super) radius: T,
    pub(super) from: T,
    pub(super) to: T,
}

impl<T: Real> Part<T> {
    /// Nothing.
    pub(super) const NONE: Self = {
        let zero = T::ZERO;
        let (middle, height, rate) = (zero, zero, zero);
        Self { middle, height, rate, strength: zero, radius: zero, from: zero, to: zero }
    };

    /// Clipped to another stretch; `None` if nothing is left.
    fn within(mut self, [from, to]: [T; 2]) -> Option<Self> {
        self.from = self.from.max(from);
        self.to = self.to.min(to);
        (self.from < self.to).then_some(self)
    }

    #[inline]
    pub(super) fn contains(&self, s: T) -> bool {
        self.from <= s && s < self.to
    }

    /// The value at a place.
    #[inline]
    pub(super) fn value(&self, s: T) -> T {
        self.height - ((s - self.middle) * self.rate).squared()
    }

    /// The values of the quadratic's polar form at two places.
    #[inline]
    fn polar(&self, s: T, t: T) -> T {
        self.height - ((s - self.middle) * self.rate) * ((t - self.middle) * self.rate)
    }

    /// The same less the value at 0, without a difference of like terms.
    #[inline]
    fn growth(&self, s: T, t: T) -> T {
        let [s, t, middle] = [s, t, self.middle].map(|s| s * self.rate);
        middle * (s + t) - s * t
    }

    /// Adds the coefficients of `strength·(q² − q₀²)` between two places, in Bernstein's basis, where q is the
    /// value and q₀ is that at 0, or 0 if there is nothing of it there.
    ///
    /// From the control points b of q those of q² are products; with `b = q₀ + d` the squares of q₀ drop out.
    pub(super) fn add(&self, sum: &mut [T; 5], [s, t]: [T; 2], from_start: bool) {
        let (start, [a, b, c]) = if from_start {
            (self.value(T::ZERO), [self.growth(s, s), self.growth(s, t), self.growth(t, t)])
        } else {
            (T::ZERO, [self.polar(s, s), self.polar(s, t), self.polar(t, t)])
        };
        let twice = start * T::TWO;
        let outer = start * (a + c) + a * c;
        let parts = [
            a * (twice + a),
            start * (a + b) + a * b,
            (outer + b * (twice + b) * T::TWO) * T::from_ratio(1, 3),
            start * (b + c) + b * c,
            c * (twice + c),
        ];
        for (sum, part) in sum.iter_mut().zip(parts) {
            *sum += part * self.strength;
        }
    }
}

impl<S: Scalar> Component<S> {
    /// Gives the parts that a ray meets, at most three.
    #[inline]
    pub(super) fn parts(&self, path: &Path<S>, mut each: impl FnMut(&Part<S::Wide>)) {
        let axis = self.ends[1] - self.ends[0];
        let square = axis.length_squared();
        if !(square > S::Wide::ZERO) {
            if let Some(part) = self.ball(path, self.ends[0]) {
                each(&part);
            }
            return;
        }
        let middle = (self.ends[0] + self.ends[1]) * S::Wide::HALF;
        let near = -(path.origin - middle).dot(path.dir);
        let aside = path.origin - middle + path.dir * near;
        // No farther than half the length and the radius together, whose square is at most this.
        let reach = square * S::Wide::HALF + self.radius.squared() * S::Wide::TWO;
        if aside.length_squared() > reach {
            return;
        }
        let far = S::Wide::FAR;
        let inverse = S::Wide::ONE / square;
        let from = path.origin - self.ends[0] + path.dir * near;
        // The share of the way from end to end, at the nearest point and by the way along the ray.
        let (share, speed) = (axis.dot(from) * inverse, axis.dot(path.dir) * inverse);
        let pace = S::Wide::ONE / speed;
        let [low, high] = if speed == S::Wide::ZERO || !pace.is_finite() {
            let one = S::Wide::ONE;
            // All of it is beside one of the three.
            if share < S::Wide::ZERO {
                [far, far]
            } else if share < one {
                [-far, far]
            } else {
                [-far, -far]
            }
        } else {
            let ends = [near - share * pace, near + (S::Wide::ONE - share) * pace];
            let [first, last] = ends;
            [first.min(last), first.max(last)]
        };
        let [before, after] = if speed < S::Wide::ZERO { [1, 0] } else { [0, 1] };
        let end = |index: usize| self.ends.get(index).copied().unwrap_or(self.ends[0]);
        if let Some(part) = self.ball(path, end(before)).and_then(|part| part.within([-far, low])) {
            each(&part);
        }
        let (aside, across) = (from - axis * share, path.dir - axis * speed);
        if let Some(part) = self.side(aside, across, near).and_then(|part| part.within([low, high]))
        {
            each(&part);
        }
        if let Some(part) = self.ball(path, end(after)).and_then(|part| part.within([high, far])) {
            each(&part);
        }
    }

    fn ball(&self, path: &Path<S>, centre: S::WideVec) -> Option<Part<S::Wide>> {
        let Self { radius, strength, .. } = *self;
        let rate = S::Wide::ONE / radius;
        let from = path.origin - centre;
        let middle = -from.dot(path.dir);
        let height = S::Wide::ONE - ((from + path.dir * middle) * rate).length_squared();
        let half = height.sqrt() * radius;
        let (from, to) = (middle - half, middle + half);
        let part = Part { middle, height, rate, strength, radius, from, to };
        (height > S::Wide::ZERO).then_some(part)
    }

    /// The side of a cylinder, from how far the ray is beside the axis at `near` and how fast that changes.
    fn side(&self, aside: S::WideVec, across: S::WideVec, near: S::Wide) -> Option<Part<S::Wide>> {
        let Self { radius, strength, .. } = *self;
        let (one, far) = (S::Wide::ONE, S::Wide::FAR);
        let inverse = one / radius;
        let square = across.length_squared();
        let doubt = S::Wide::EPSILON * S::Wide::from_i32(4);
        if square <= doubt.squared() {
            // Along the axis, as far as the direction can tell.
            let height = one - (aside * inverse).length_squared();
            let (middle, rate, from, to) = (near, S::Wide::ZERO, -far, far);
            let part = Part { middle, height, rate, strength, radius, from, to };
            return (height > S::Wide::ZERO).then_some(part);
        }
        let shift = -aside.dot(across) / square;
        let height = one - ((aside + across * shift) * inverse).length_squared();
        let (middle, speed) = (near + shift, square.sqrt());
        let half = height.sqrt() * radius / speed;
        let (from, to) = (middle - half, middle + half);
        let part = Part { middle, height, rate: speed * inverse, strength, radius, from, to };
        (height > S::Wide::ZERO).then_some(part)
    }
}

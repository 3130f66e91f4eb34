//! Intervals that hold every value that a formula can take: each operation rounds outward.
//!
//! Source: R. E. Moore, R. B. Kearfott and M. J. Cloud, *Introduction to Interval Analysis*
//! (2009), chapters 2 to 5.

mod algebra;
mod dual;
mod sine;

pub(crate) use algebra::Algebra;
pub(crate) use dual::Dual;
pub(crate) use sine::Digits;

use core::ops::{Add, Mul, Neg, Sub};

use crate::scalar::Real;

/// All numbers from `low` to `high`. Where nothing is known, both are infinite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Interval<T> {
    low: T,
    high: T,
}

/// On which side of 0 a number is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Below,
    Above,
}

impl<T: Real> Interval<T> {
    /// Nothing but 0.
    const ZERO: Self = Self { low: T::ZERO, high: T::ZERO };

    /// The numbers between two, the ends included.
    #[inline]
    pub(crate) fn between(low: T, high: T) -> Self {
        Self { low, high }
    }

    /// All numbers.
    #[inline]
    fn line() -> Self {
        Self { low: -T::FAR, high: T::FAR }
    }

    /// The numbers between two that were rounded to within one step; all if one is not finite.
    #[inline]
    fn outward(low: T, high: T) -> Self {
        if low.is_finite() && high.is_finite() {
            Self { low: low.next_down(), high: high.next_up() }
        } else {
            Self::line()
        }
    }

    /// Every number of it is greater than 0.
    #[inline]
    pub(crate) fn is_positive(&self) -> bool {
        self.low > T::ZERO
    }

    /// Every number of it is less than 0.
    #[inline]
    pub(crate) fn is_negative(&self) -> bool {
        self.high < T::ZERO
    }

    /// The side of 0 that all of it is on, if there is one.
    #[inline]
    pub(crate) fn side(&self) -> Option<Side> {
        if self.is_positive() {
            Some(Side::Above)
        } else if self.is_negative() {
            Some(Side::Below)
        } else {
            None
        }
    }

    /// The side of 0 that most of it is on: five eighths, for rounding seldom adds up to all that it may.
    #[inline]
    pub(crate) fn likely_side(&self) -> Option<Side> {
        let quarter = (self.high - self.low) * (T::HALF * T::HALF);
        let sum = self.low + self.high;
        if sum > quarter {
            Some(Side::Above)
        } else if sum < -quarter {
            Some(Side::Below)
        } else {
            None
        }
    }

    #[inline]
    fn is_zero(&self) -> bool {
        self.low == T::ZERO && self.high == T::ZERO
    }

    /// The magnitudes of its numbers.
    #[inline]
    fn magnitude(self) -> Self {
        if self.low >= T::ZERO {
            self
        } else if self.high <= T::ZERO {
            -self
        } else {
            Self { low: T::ZERO, high: self.high.max(-self.low) }
        }
    }

    /// A function that grows, of what is not negative, and whose values are not; it is rounded to
    /// within `steps` times the precision.
    #[inline]
    fn growing(self, steps: T, f: impl Fn(T) -> T) -> Self {
        let (low, high) = (f(self.low), f(self.high));
        if !high.is_finite() {
            return Self::line();
        }
        let slack = |v: T| v * (T::EPSILON * steps);
        let low = (low - slack(low)).next_down();
        Self { low: low.max(T::ZERO), high: (high + slack(high)).next_up() }
    }
}

impl<T: Real> Neg for Interval<T> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { low: -self.high, high: -self.low }
    }
}

impl<T: Real> Add for Interval<T> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        // What is exact stays so: most constants, and slopes across the axes.
        if other.is_zero() {
            self
        } else if self.is_zero() {
            other
        } else {
            Self::outward(self.low + other.low, self.high + other.high)
        }
    }
}

impl<T: Real> Sub for Interval<T> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<T: Real> Mul for Interval<T> {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let (a, b, zero) = (self, other, T::ZERO);
        if a.is_zero() || b.is_zero() {
            return Self::ZERO;
        }
        let (low, high) = if a.low >= zero {
            let low = if b.low >= zero { a.low } else { a.high };
            let high = if b.high <= zero { a.low } else { a.high };
            (low * b.low, high * b.high)
        } else if a.high <= zero {
            let low = if b.high <= zero { a.high } else { a.low };
            let high = if b.low >= zero { a.high } else { a.low };
            (low * b.high, high * b.low)
        } else if b.low >= zero {
            (a.low * b.high, a.high * b.high)
        } else if b.high <= zero {
            (a.high * b.low, a.low * b.low)
        } else {
            ((a.low * b.high).min(a.high * b.low), (a.low * b.low).max(a.high * b.high))
        };
        Self::outward(low, high)
    }
}

impl<T: Real> Algebra for Interval<T> {
    type Number = T;

    #[inline]
    fn exactly(x: T) -> Self {
        Self { low: x, high: x }
    }

    #[inline]
    fn square(self) -> Self {
        self.magnitude().growing(T::ZERO, T::squared)
    }

    fn whole_power(self, n: u32) -> Self {
        // Each of the products may round once, at half a step.
        let steps = T::from_i32(n.min(255) as i32);
        let power = |part: Self| part.growing(steps, |x| x.powi(n));
        if n & 1 == 0 {
            return power(self.magnitude());
        }
        let positive = power(Self { low: self.low.max(T::ZERO), high: self.high.max(T::ZERO) });
        let negative =
            power(Self { low: (-self.high).max(T::ZERO), high: (-self.low).max(T::ZERO) });
        let low = if self.low < T::ZERO { -negative.high } else { positive.low };
        let high = if self.high > T::ZERO { positive.high } else { -negative.low };
        Self { low, high }
    }

    fn real_power(self, e: T) -> Self {
        let magnitude = self.magnitude();
        if e < T::ZERO {
            return Self::exactly(T::ONE).over(magnitude.growing(T::from_i32(8), |x| x.pow(-e)));
        }
        magnitude.growing(T::from_i32(8), |x| x.pow(e))
    }

    #[inline]
    fn root(self) -> Self {
        let positive = Self { low: self.low.max(T::ZERO), high: self.high.max(T::ZERO) };
        positive.growing(T::ZERO, T::sqrt)
    }

    #[inline]
    fn over(self, divisor: Self) -> Self {
        let negative = divisor.is_negative();
        let (this, divisor) = if negative { (-self, -divisor) } else { (self, divisor) };
        if this.is_zero() {
            return this;
        }
        if !divisor.is_positive() {
            return Self::line();
        }
        let low = if this.low < T::ZERO { divisor.low } else { divisor.high };
        let high = if this.high > T::ZERO { divisor.low } else { divisor.high };
        Self::outward(this.low / low, this.high / high)
    }

    /// By the middle m and the half width r: sin(m + h) = sin m · cos h + cos m · sin h, where
    /// 1 − r²/2 ≤ cos h ≤ 1 and |sin h| ≤ r.
    fn sin_cos(self, digits: Digits) -> [Self; 2] {
        let middle = (self.low + self.high) * T::HALF;
        let half = (self.high - middle).max(middle - self.low).next_up();
        let whole = Self { low: -T::ONE, high: T::ONE };
        // Both bounds infinite make no number of the middle.
        if !(half < T::TWO && middle.abs() <= T::from_i32(sine::ARGUMENT_MAX)) {
            return [whole; 2];
        }
        let (sin, cos) = sine::sin_cos(middle, digits);
        let slack = sine::error(middle, digits) + T::EPSILON * T::from_i32(8);
        let bend = half.squared() * T::HALF;
        [(sin, cos), (cos, sin)].map(|(value, slope)| {
            let reach = slope.abs() * half + slack;
            let low = value - (value * bend).max(T::ZERO) - reach;
            let high = value - (value * bend).min(T::ZERO) + reach;
            Self { low: low.max(-T::ONE), high: high.min(T::ONE) }
        })
    }

    #[inline]
    fn lesser(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.min(other.high) }
    }

    #[inline]
    fn is_less(self, other: Self) -> Option<bool> {
        if self.high < other.low {
            Some(true)
        } else if self.low >= other.high {
            Some(false)
        } else {
            None
        }
    }

    #[inline]
    fn either(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    fn smooth_lesser(self, other: Self, width: T) -> Self {
        // It grows with both.
        let corner = |a: T, b: T| algebra::blend(Self::exactly(a), Self::exactly(b), width);
        Self { low: corner(self.low, other.low).low, high: corner(self.high, other.high).high }
    }

    #[inline]
    fn share(self) -> Self {
        Self { low: self.low.clamp(T::ZERO, T::ONE), high: self.high.clamp(T::ZERO, T::ONE) }
    }
}

#[cfg(test)]
mod tests;

//! A value with its slope along a line.

use core::ops::{Add, Mul, Neg, Sub};

use super::Algebra;
use crate::scalar::{Number, Real};

/// A value and its derivative along a line.
///
/// Source: forward mode; A. Griewank and A. Walther, *Evaluating Derivatives* (2008), chapter 3.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dual<A> {
    pub(crate) value: A,
    pub(crate) slope: A,
}

impl<A: Algebra> Dual<A> {
    /// A number that is the same everywhere.
    #[inline]
    pub(crate) fn constant(x: A::Number) -> Self {
        Self { value: A::exactly(x), slope: A::exactly(A::Number::ZERO) }
    }

    /// `self²`.
    #[inline]
    pub(crate) fn square(self) -> Self {
        let Self { value, slope } = self;
        let twice = value * slope;
        Self { value: value.square(), slope: twice + twice }
    }

    /// `selfⁿ`, for n from 1 to 255.
    pub(crate) fn whole_power(self, n: u32) -> Self {
        let Self { value, slope } = self;
        if n < 2 {
            return self;
        }
        let factor = A::exactly(A::Number::from_i32(n as i32));
        Self { value: value.whole_power(n), slope: value.whole_power(n - 1) * slope * factor }
    }

    /// `|self|ᵉ`.
    pub(crate) fn real_power(self, e: A::Number) -> Self {
        let Self { value, slope } = self.magnitude();
        let grown = value.real_power(e - A::Number::ONE) * A::exactly(e);
        Self { value: value.real_power(e), slope: grown * slope }
    }

    /// The square root; of what is negative, 0.
    #[inline]
    pub(crate) fn root(self) -> Self {
        let root = self.value.root();
        Self { value: root, slope: self.slope.over(root + root) }
    }

    /// `self / divisor`; 0 for a divisor of 0.
    #[inline]
    pub(crate) fn over(self, divisor: Self) -> Self {
        let value = self.value.over(divisor.value);
        Self { value, slope: (self.slope - value * divisor.slope).over(divisor.value) }
    }

    /// The sine of an angle in radians, from the sine and the cosine of its value.
    pub(crate) fn sine(self, [sin, cos]: [A; 2]) -> Self {
        Self { value: sin, slope: cos * self.slope }
    }

    /// The cosine of an angle in radians, from the sine and the cosine of its value.
    pub(crate) fn cosine(self, [sin, cos]: [A; 2]) -> Self {
        Self { value: cos, slope: -(sin * self.slope) }
    }

    /// The lesser of two.
    #[inline]
    pub(crate) fn lesser(self, other: Self) -> Self {
        let slope = match self.value.is_less(other.value) {
            Some(true) => self.slope,
            Some(false) => other.slope,
            None => self.slope.either(other.slope),
        };
        Self { value: self.value.lesser(other.value), slope }
    }

    /// The magnitude.
    #[inline]
    pub(crate) fn magnitude(self) -> Self {
        -self.lesser(-self)
    }

    /// The lesser of two, rounded off where they differ by less than `width`.
    pub(crate) fn smooth_lesser(self, other: Self, width: A::Number) -> Self {
        let half = A::exactly(A::Number::HALF);
        let ahead = (other.value - self.value).over(A::exactly(width + width));
        let share = (half + ahead).share();
        Self {
            value: self.value.smooth_lesser(other.value, width),
            slope: other.slope + share * (self.slope - other.slope),
        }
    }
}

impl<A: Algebra> Neg for Dual<A> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { value: -self.value, slope: -self.slope }
    }
}

impl<A: Algebra> Add for Dual<A> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl<A: Algebra> Sub for Dual<A> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, slope: self.slope - other.slope }
    }
}

impl<A: Algebra> Mul for Dual<A> {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            slope: self.slope * other.value + self.value * other.slope,
        }
    }
}

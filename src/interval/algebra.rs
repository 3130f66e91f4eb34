//! What formulas are computed with: a number, or an interval that holds it.

use core::ops::{Add, Mul, Neg, Sub};

use crate::scalar::{Number, Real};

use super::sine::{self, Digits};

/// A number or what stands for one. What a number gives lies in what an interval around it gives.
pub(crate) trait Algebra:
    Copy + PartialEq + Neg<Output = Self> + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
    /// What it is made of.
    type Number: Real;

    /// One number.
    fn exactly(x: Self::Number) -> Self;
    /// `self²`.
    fn square(self) -> Self;
    /// `selfⁿ`, for n from 1 to 255.
    fn whole_power(self, n: u32) -> Self;
    /// `|self|ᵉ`.
    fn real_power(self, e: Self::Number) -> Self;
    /// The square root; of what is negative, 0.
    fn root(self) -> Self;
    /// `self / divisor`; 0 for a divisor of 0.
    fn over(self, divisor: Self) -> Self;
    /// Sine and cosine of an angle in radians.
    fn sin_cos(self, digits: Digits) -> [Self; 2];
    /// The lesser of two.
    fn lesser(self, other: Self) -> Self;
    /// `self < other`, if that is known.
    fn is_less(self, other: Self) -> Option<bool>;
    /// What holds both, where it is not known which it is.
    fn either(self, other: Self) -> Self;
    /// The lesser of two, rounded off where they differ by less than `width`.
    fn smooth_lesser(self, other: Self, width: Self::Number) -> Self;
    /// Clamped to 0..=1.
    fn share(self) -> Self;
}

/// min(a, b) − h²·w/4 with h = max(0, 1 − |a − b|/w): a parabola that joins both with their slopes.
///
/// Source: I. Quilez, "Smooth minimum" (2013), the quadratic polynomial.
pub(super) fn blend<A: Algebra>(a: A, b: A, width: A::Number) -> A {
    let one = A::exactly(A::Number::ONE);
    let gap = a - b;
    let apart = -gap.lesser(-gap);
    let overlap = (one - apart.over(A::exactly(width))).share();
    let quarter = A::exactly(width * A::Number::HALF * A::Number::HALF);
    a.lesser(b) - overlap.square() * quarter
}

impl<T: Real> Algebra for T {
    type Number = T;

    #[inline]
    fn exactly(x: T) -> T {
        x
    }
    #[inline]
    fn square(self) -> T {
        self.squared()
    }
    #[inline]
    fn whole_power(self, n: u32) -> T {
        self.powi(n)
    }
    fn real_power(self, e: T) -> T {
        if e < T::ZERO { T::ONE.over(self.abs().pow(-e)) } else { self.abs().pow(e) }
    }
    #[inline]
    fn root(self) -> T {
        self.sqrt()
    }
    #[inline]
    fn over(self, divisor: T) -> T {
        if divisor == T::ZERO { T::ZERO } else { self / divisor }
    }
    #[inline]
    fn sin_cos(self, digits: Digits) -> [T; 2] {
        let (sin, cos) = sine::sin_cos(self, digits);
        [sin, cos]
    }
    #[inline]
    fn lesser(self, other: T) -> T {
        self.min(other)
    }
    #[inline]
    fn is_less(self, other: T) -> Option<bool> {
        Some(self < other)
    }
    #[inline]
    fn either(self, _: T) -> T {
        self
    }
    #[inline]
    fn smooth_lesser(self, other: T, width: T) -> T {
        blend(self, other, width)
    }
    #[inline]
    fn share(self) -> T {
        self.clamp(T::ZERO, T::ONE)
    }
}

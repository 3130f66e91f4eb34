//! Numbers of twice the precision, as sums of two.

use super::Real;

/// A number as the unevaluated sum of two: a rounded one, and what its rounding left.
///
/// Source: T. J. Dekker, "A floating-point technique for extending the available precision" (1971);
/// J.-M. Muller et al., *Handbook of Floating-Point Arithmetic* (2018), chapter 14.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair<T> {
    /// The number, rounded.
    pub(crate) high: T,
    /// The rest.
    low: T,
}

impl<T: Real> Pair<T> {
    /// A number and a rest that is small beside it.
    #[inline]
    pub(crate) fn new(high: T, low: T) -> Self {
        let sum = high + low;
        Self { high: sum, low: low - (sum - high) }
    }

    /// The product of two numbers.
    #[inline]
    pub(crate) fn product(a: T, b: T) -> Self {
        let (high, low) = a.two_product(b);
        Self { high, low }
    }

    /// The sum of two.
    #[inline]
    pub(crate) fn plus(self, other: Self) -> Self {
        let (sum, error) = self.high.two_sum(other.high);
        Self::new(sum, error + (self.low + other.low))
    }

    /// The same less a number.
    #[inline]
    pub(crate) fn less(self, other: T) -> Self {
        let (sum, error) = self.high.two_sum(-other);
        Self::new(sum, error + self.low)
    }

    /// The product with a number.
    #[inline]
    pub(crate) fn times(self, factor: T) -> Self {
        let (product, error) = self.high.two_product(factor);
        Self::new(product, error + self.low * factor)
    }

    /// The square.
    #[inline]
    pub(crate) fn squared(self) -> Self {
        let (product, error) = self.high.two_product(self.high);
        Self::new(product, error + self.high * self.low * T::TWO)
    }

    /// The square root; 0 of what is not positive.
    #[inline]
    pub(crate) fn sqrt(self) -> Self {
        let root = self.high.sqrt();
        if root <= T::ZERO {
            return Self { high: T::ZERO, low: T::ZERO };
        }
        let (square, error) = root.two_product(root);
        let rest = (self.high - square) - error + self.low;
        Self::new(root, rest * T::HALF / root)
    }
}

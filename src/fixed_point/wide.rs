//! The number for long formulas of fixed point: a mantissa of 63 bits with an exponent of its
//! own, in integer arithmetic alone.
//!
//! The operations are calls, not copies: where a product takes a hundred instructions, as on
//! the smallest cores, copies would fill the flash.

use core::cmp::Ordering;
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::scalar::{Number, Real};

/// A number of 63 significant bits that neither overflows nor wraps.
///
/// Every operation is rounded to nearest, ties away from 0. Beyond an exponent of 2¹⁶ numbers
/// saturate at [`FAR`](Real::FAR); below −2¹⁶ they are 0. A quotient by 0 saturates, 0/0 is 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wide {
    /// 0, or of a magnitude in 2⁶²..2⁶³.
    mantissa: i64,
    /// The value is mantissa · 2^exponent; 0 for the number 0.
    exponent: i32,
}

/// The magnitude of every mantissa but 0 is at least this.
const LEAST: u64 = 1 << 62;
const EXPONENT_MAX: i32 = 1 << 16;

impl Wide {
    /// `mantissa · 2^exponent`, exactly for any mantissa but the least.
    #[inline]
    pub(crate) const fn from_parts(mantissa: i64, exponent: i32) -> Self {
        Self::assemble(mantissa < 0, mantissa.unsigned_abs(), exponent)
    }

    /// `mantissa · 2^exponent`, rounded to 63 bits.
    #[inline]
    pub(crate) const fn from_long(mantissa: i128, exponent: i32) -> Self {
        Self::assemble_long(mantissa < 0, mantissa.unsigned_abs(), exponent)
    }

    /// A magnitude of any size, brought to 63 bits.
    #[inline]
    const fn assemble(negative: bool, magnitude: u64, exponent: i32) -> Self {
        if magnitude == 0 {
            return Self { mantissa: 0, exponent: 0 };
        }
        if magnitude >> 63 != 0 {
            return Self::settle(negative, (magnitude >> 1) + (magnitude & 1), exponent + 1);
        }
        let shift = magnitude.leading_zeros() - 1;
        Self::settle(negative, magnitude << shift, exponent - shift as i32)
    }

    /// A magnitude of 2⁶² to 2⁶³, that included, with an exponent that may be out of range.
    #[inline]
    const fn settle(negative: bool, mut magnitude: u64, mut exponent: i32) -> Self {
        if magnitude >> 63 != 0 {
            (magnitude, exponent) = (LEAST, exponent + 1);
        }
        if exponent < -EXPONENT_MAX {
            return Self { mantissa: 0, exponent: 0 };
        }
        if exponent > EXPONENT_MAX {
            (magnitude, exponent) = (LEAST, EXPONENT_MAX);
        }
        let mantissa = magnitude as i64;
        Self { mantissa: if negative { -mantissa } else { mantissa }, exponent }
    }

    #[inline]
    const fn assemble_long(negative: bool, magnitude: u128, exponent: i32) -> Self {
        let high = (magnitude >> 64) as u64;
        if high == 0 {
            return Self::assemble(negative, magnitude as u64, exponent);
        }
        // 64 bits are left, and the last of them rounds the 63rd.
        let shift = 64 - high.leading_zeros();
        let rounded = (magnitude >> shift) as u64;
        Self::assemble(negative, rounded, exponent.saturating_add(shift as i32))
    }

    /// `mantissa · 2^exponent` as two numbers: rounded to 63 bits, and the rest.
    #[inline]
    pub(crate) const fn halves(mantissa: i128, exponent: i32) -> (Self, Self) {
        let high = Self::from_long(mantissa, exponent);
        let shift = high.exponent - exponent;
        if shift <= 0 || shift > 64 {
            // Exact, or beyond what the exponent can tell.
            return (high, Self::from_parts(0, 0));
        }
        let rest = mantissa.wrapping_sub((high.mantissa as i128) << shift);
        (high, Self::from_long(rest, exponent))
    }

    /// The nearest multiple of 2^−`fraction`, in such units, saturating at ±`most`.
    #[inline]
    pub(crate) const fn to_fixed(self, fraction: i32, most: i64) -> i64 {
        let shift = self.exponent + fraction;
        let magnitude = self.mantissa.unsigned_abs();
        let units = if magnitude == 0 || shift < -63 {
            0
        } else if shift > 0 {
            most as u64
        } else if shift == 0 {
            magnitude
        } else {
            (magnitude >> -shift) + ((magnitude >> (-shift - 1)) & 1)
        };
        let units = if units > most as u64 { most } else { units as i64 };
        if self.mantissa < 0 { -units } else { units }
    }

    /// The sign of the first comparison of magnitudes of the same sign.
    #[inline]
    fn magnitude_order(&self, other: &Self) -> Ordering {
        let key = |x: &Self| (x.mantissa != 0, x.exponent, x.mantissa.unsigned_abs());
        key(self).cmp(&key(other))
    }

    /// The exact product as mantissa and exponent.
    #[inline]
    const fn product(self, other: Self) -> (i128, i32) {
        (self.mantissa as i128 * other.mantissa as i128, self.exponent + other.exponent)
    }

    /// A sum of products of 126 bits each, rounded last.
    #[inline(never)]
    pub(super) fn sum_of_products<const N: usize>(products: [(Self, Self); N]) -> Self {
        let exact = products.map(|(a, b)| a.product(b));
        let most = exact.iter().filter(|(p, _)| *p != 0).map(|(_, exponent)| *exponent).max();
        let Some(most) = most else {
            return Self::ZERO;
        };
        // Two bits to the right make room for the sum of four.
        let sum = exact.iter().fold(0_i128, |sum, &(product, exponent)| {
            sum + (product >> (most - exponent).clamp(0, 124) as u32 >> 2)
        });
        Self::from_long(sum, most + 2)
    }

    /// `a·b − c·d` with the exact sign.
    pub(crate) fn det2(a: Self, b: Self, c: Self, d: Self) -> Self {
        let ((p, i), (q, j)) = (a.product(b), c.product(d));
        if p == 0 || q == 0 || i.abs_diff(j) > 1 {
            // Products of 125 bits that differ so much cannot cancel.
            return a * b - c * d;
        }
        // Both fit in 127 bits with one bit to spare, and so does their difference.
        let least = if i < j { i } else { j };
        let (p, q) = (p << (i - least), q << (j - least));
        match p.checked_sub(q) {
            Some(difference) => Self::from_long(difference, least),
            None => Self::from_long(p / 2 - q / 2, least + 1),
        }
    }
}

impl PartialOrd for Wide {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        let order = self.mantissa.signum().cmp(&other.mantissa.signum());
        Some(order.then_with(|| {
            let magnitudes = self.magnitude_order(other);
            if self.mantissa < 0 { magnitudes.reverse() } else { magnitudes }
        }))
    }
}

impl Neg for Wide {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { mantissa: -self.mantissa, ..self }
    }
}

impl Add for Wide {
    type Output = Self;
    #[inline(never)]
    fn add(self, other: Self) -> Self {
        if other.mantissa == 0 {
            return self;
        }
        if self.mantissa == 0 {
            return other;
        }
        let (large, small) =
            if self.exponent >= other.exponent { (self, other) } else { (other, self) };
        let gap = large.exponent - small.exponent;
        if gap > 64 {
            return large;
        }
        // 62 bits more on the right keep all that rounding can ask for.
        let gap = gap as u32;
        if gap <= 62 {
            let sum = ((large.mantissa as i128) << gap) + small.mantissa as i128;
            return Self::from_long(sum, small.exponent);
        }
        let sum = ((large.mantissa as i128) << 62) + (small.mantissa >> (gap - 62)) as i128;
        Self::from_long(sum, large.exponent - 62)
    }
}

impl Sub for Wide {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Wide {
    type Output = Self;
    #[inline(never)]
    fn mul(self, other: Self) -> Self {
        if self.mantissa == 0 || other.mantissa == 0 {
            return Self::ZERO;
        }
        let negative = (self.mantissa < 0) != (other.mantissa < 0);
        let magnitude = |x: Self| x.mantissa.unsigned_abs() as u128;
        // Of 125 or 126 bits; 64 of them are looked at, and the last of these rounds.
        let product = magnitude(self) * magnitude(other);
        let (high, low) = ((product >> 64) as u64, product as u64);
        let (top, shift) = if high >> 61 != 0 {
            ((high << 2) | (low >> 62), 63)
        } else {
            ((high << 3) | (low >> 61), 62)
        };
        let exponent = self.exponent + other.exponent + shift;
        Self::settle(negative, (top >> 1) + (top & 1), exponent)
    }
}

impl Div for Wide {
    type Output = Self;
    #[inline(never)]
    fn div(self, other: Self) -> Self {
        let negative = (self.mantissa < 0) != (other.mantissa < 0);
        let (n, d) = (self.mantissa.unsigned_abs(), other.mantissa.unsigned_abs());
        match ((n as u128) << 64).checked_div(d as u128) {
            // Of 64 or 65 bits.
            Some(quotient) => {
                Self::assemble_long(negative, quotient, self.exponent - other.exponent - 64)
            }
            None if n == 0 => Self::ZERO,
            None if self.mantissa < 0 => -Self::FAR,
            None => Self::FAR,
        }
    }
}

macro_rules! assigning {
    ($($name:ident $method:ident $operator:tt)*) => { $(
        impl $name for Wide {
            #[inline]
            fn $method(&mut self, other: Self) {
                *self = *self $operator other;
            }
        }
    )* };
}

assigning!(AddAssign add_assign + SubAssign sub_assign - MulAssign mul_assign *);

impl Number for Wide {
    const ZERO: Self = Self { mantissa: 0, exponent: 0 };
    const HALF: Self = Self::from_parts(1, -1);
    const ONE: Self = Self::from_parts(1, 0);

    #[inline]
    fn is_finite(self) -> bool {
        self.exponent < EXPONENT_MAX
    }
}

impl Real for Wide {
    const TWO: Self = Self::from_parts(2, 0);
    const PI: Self = Self::from_parts(0x6487_ed51_10b4_611a, -61);
    // What the functions and the products of matrices keep.
    const EPSILON: Self = Self::from_parts(1, -48);
    const FAR: Self = Self::from_parts(LEAST as i64, EXPONENT_MAX);
    const TINY: Self = Self::from_parts(1, -1022);

    #[inline]
    fn from_i32(n: i32) -> Self {
        Self::from_parts(n as i64, 0)
    }
    #[inline]
    fn from_ratio(n: i32, d: i32) -> Self {
        Self::from_i32(n) / Self::from_i32(d)
    }
    fn from_f64(x: f64) -> Self {
        let bits = x.to_bits();
        let (biased, fraction) = ((bits >> 52) as i32 & 0x7ff, bits & ((1 << 52) - 1));
        let magnitude = match biased {
            0x7ff if fraction != 0 => Self::ZERO,
            0x7ff => Self::FAR,
            0 => Self::assemble(false, fraction, -1074),
            _ => Self::assemble(false, fraction | 1 << 52, biased - 1075),
        };
        if bits >> 63 == 1 { -magnitude } else { magnitude }
    }
    fn to_f64(self) -> f64 {
        let sign = if self.mantissa < 0 { 1 << 63 } else { 0 };
        let magnitude = self.mantissa.unsigned_abs();
        if magnitude == 0 {
            return 0.0;
        }
        // 53 bits to nearest, ties to even.
        let (mut kept, dropped) = (magnitude >> 10, magnitude & 0x3ff);
        if dropped > 0x200 || (dropped == 0x200 && kept & 1 == 1) {
            kept += 1;
        }
        let carried = (kept >> 53) as i32;
        let biased = self.exponent + 10 + 1075 + carried;
        if biased >= 0x7ff {
            return f64::from_bits(sign | 0x7ff << 52);
        }
        if biased <= 0 {
            return f64::from_bits(sign);
        }
        let fraction = (kept >> carried) & ((1 << 52) - 1);
        f64::from_bits(sign | (biased as u64) << 52 | fraction)
    }
    #[inline]
    fn nearest(self) -> i32 {
        self.to_fixed(0, i32::MAX as i64) as i32
    }
    #[inline]
    fn next_up(self) -> Self {
        let Self { mantissa, exponent } = self;
        match mantissa {
            0 => Self { mantissa: LEAST as i64, exponent: -EXPONENT_MAX },
            i64::MAX if exponent < EXPONENT_MAX => {
                Self { mantissa: LEAST as i64, exponent: exponent + 1 }
            }
            i64::MAX => self,
            // Nearer to 0 than a power of two the numbers stand twice as close.
            _ if mantissa == -(LEAST as i64) => Self::from_parts(-i64::MAX, exponent - 1),
            _ => Self { mantissa: mantissa + 1, exponent },
        }
    }
    #[inline(never)]
    fn sqrt(self) -> Self {
        if self.mantissa <= 0 {
            return Self::ZERO;
        }
        // 126 or 127 bits of radicand for 63 or 64 of the root.
        let odd = self.exponent & 1;
        let radicand = (self.mantissa as u128) << (64 - odd);
        let root = radicand.isqrt() as u64;
        Self::assemble(false, root, (self.exponent - 64 + odd) / 2)
    }
    #[inline(never)]
    fn two_sum(self, other: Self) -> (Self, Self) {
        let (large, small) =
            if self.exponent >= other.exponent { (self, other) } else { (other, self) };
        let gap = large.exponent - small.exponent;
        if large.mantissa == 0 || small.mantissa == 0 {
            return (self + other, Self::ZERO);
        } else if gap > 62 {
            // The smaller is at most about half of the last place, or less.
            return (large, small);
        }
        Self::halves(((large.mantissa as i128) << gap) + small.mantissa as i128, small.exponent)
    }
    #[inline(never)]
    fn two_product(self, other: Self) -> (Self, Self) {
        let (product, exponent) = self.product(other);
        Self::halves(product, exponent)
    }
    fn sin_cos(self) -> (Self, Self) {
        super::functions::sin_cos(self)
    }
    fn atan2(self, x: Self) -> Self {
        super::functions::atan2(self, x)
    }
    fn acos(self) -> Self {
        let x = self.clamp(-Self::ONE, Self::ONE);
        super::functions::atan2(((Self::ONE - x) * (Self::ONE + x)).sqrt(), x)
    }
    fn exp(self) -> Self {
        super::functions::exp(self)
    }
    fn pow(self, e: Self) -> Self {
        super::functions::pow(self, e)
    }
}

impl Wide {
    /// `self · 2ⁿ`.
    #[inline]
    pub(super) const fn doubled(self, n: i32) -> Self {
        Self::from_parts(self.mantissa, self.exponent.saturating_add(n))
    }

    /// The power of two at or below the magnitude, as its exponent.
    #[inline]
    pub(super) const fn magnitude_exponent(self) -> i32 {
        self.exponent + 62
    }

    /// The nearest whole number, saturating.
    #[inline]
    pub(super) const fn nearest(self) -> i64 {
        self.to_fixed(0, i64::MAX)
    }
}

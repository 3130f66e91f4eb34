//! The numbers: positions and components of directions, with operators that round once and
//! saturate.

use core::fmt;
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use fixed::types::{I2F30, I2F62, I16F16, I32F32};

use super::triple::Component;
use super::wide::Wide;
use crate::scalar::{Number, Real, Scalar};

macro_rules! number {
    ($(#[$doc:meta])* $name:ident, $inner:ident, $bits:ident, $long:ident, $fraction:literal) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
        pub struct $name(
            /// The number as the `fixed` crate has it.
            pub $inner,
        );

        impl $name {
            /// The number of so many units in the last place.
            pub const fn from_bits(bits: $bits) -> Self {
                Self($inner::from_bits(bits))
            }

            /// How many units in the last place it is.
            pub const fn to_bits(self) -> $bits {
                self.0.to_bits()
            }

            /// The sum of exact products, rounded to nearest.
            #[inline]
            pub(super) const fn rounded(products: $long) -> Self {
                Self::clamped(products.saturating_add(1 << ($fraction - 1)) >> $fraction)
            }

            /// The nearest number to one of so many units.
            #[inline]
            pub(super) const fn clamped(units: $long) -> Self {
                let most = $bits::MAX as $long;
                Self::from_bits(if units > most {
                    $bits::MAX
                } else if units < -most {
                    -$bits::MAX
                } else {
                    units as $bits
                })
            }

            /// The exact product, in units of the square of the last place.
            #[inline]
            pub(super) const fn product(self, other: Self) -> $long {
                self.to_bits() as $long * other.to_bits() as $long
            }
        }

        impl fmt::Debug for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                fmt::Display::fmt(&self.0, f)
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                fmt::Display::fmt(&self.0, f)
            }
        }

        impl Add for $name {
            type Output = Self;
            #[inline]
            fn add(self, other: Self) -> Self {
                Self::clamped(self.to_bits() as $long + other.to_bits() as $long)
            }
        }

        impl Sub for $name {
            type Output = Self;
            #[inline]
            fn sub(self, other: Self) -> Self {
                Self::clamped(self.to_bits() as $long - other.to_bits() as $long)
            }
        }

        impl Mul for $name {
            type Output = Self;
            #[inline]
            fn mul(self, other: Self) -> Self {
                Self::rounded(self.product(other))
            }
        }

        impl Neg for $name {
            type Output = Self;
            #[inline]
            fn neg(self) -> Self {
                Self::from_bits(self.to_bits().saturating_neg())
            }
        }

        impl AddAssign for $name {
            #[inline]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }

        impl SubAssign for $name {
            #[inline]
            fn sub_assign(&mut self, other: Self) {
                *self = *self - other;
            }
        }

        impl MulAssign for $name {
            #[inline]
            fn mul_assign(&mut self, other: Self) {
                *self = *self * other;
            }
        }

        impl Number for $name {
            const ZERO: Self = Self::from_bits(0);
            const HALF: Self = Self::from_bits(1 << ($fraction - 1));
            const ONE: Self = Self::from_bits(1 << $fraction);

            #[inline]
            fn is_finite(self) -> bool {
                true
            }
        }

        impl Component for $name {
            #[inline]
            fn dot3([ax, ay, az]: [Self; 3], [bx, by, bz]: [Self; 3]) -> Self {
                // Where the sum saturates, so does the result.
                let sum = ax.product(bx).saturating_add(ay.product(by));
                Self::rounded(sum.saturating_add(az.product(bz)))
            }
            #[inline]
            fn det(a: Self, b: Self, c: Self, d: Self) -> Self {
                Self::rounded(a.product(b).saturating_sub(c.product(d)))
            }
        }
    };
}

number!(
    /// A number with 16 bits before and 16 behind the point; one step is 2⁻¹⁶.
    Q16, I16F16, i32, i64, 16
);
number!(
    /// A number with 32 bits before and 32 behind the point; one step is 2⁻³².
    Q32, I32F32, i64, i128, 32
);
number!(
    /// A component of a direction for [`Q16`]: between −2 and 2, in steps of 2⁻³⁰.
    Unit16, I2F30, i32, i64, 30
);
number!(
    /// A component of a direction for [`Q32`]: between −2 and 2, in steps of 2⁻⁶².
    Unit32, I2F62, i64, i128, 62
);

macro_rules! real {
    ($name:ident, $bits:ident, $long:ident, $square:ident, $fraction:literal) => {
        impl Div for $name {
            type Output = Self;
            #[inline]
            fn div(self, other: Self) -> Self {
                let doubled = (self.to_bits() as $long) << ($fraction + 1);
                match doubled.checked_div(other.to_bits() as $long) {
                    // To nearest, ties away from 0.
                    Some(twice) => Self::clamped((twice + twice.signum()) / 2),
                    None => Self::clamped(($bits::MAX as $long) * doubled.signum()),
                }
            }
        }

        impl Real for $name {
            const TWO: Self = Self::from_bits(2 << $fraction);
            const PI: Self =
                Self::from_bits((0x6487_ed51_10b4_611a_i64 >> (61 - $fraction)) as $bits);
            const EPSILON: Self = Self::from_bits(1);
            const FAR: Self = Self::from_bits($bits::MAX);
            const TINY: Self = Self::from_bits(1);

            #[inline]
            fn from_i32(n: i32) -> Self {
                Self::clamped((n as $long) << $fraction)
            }
            #[inline]
            fn from_ratio(n: i32, d: i32) -> Self {
                Self::narrow(Wide::from_ratio(n, d))
            }
            fn from_f64(x: f64) -> Self {
                Self::narrow(Wide::from_f64(x))
            }
            fn to_f64(self) -> f64 {
                self.widen().to_f64()
            }
            #[inline]
            fn nearest(self) -> i32 {
                Real::nearest(self.widen())
            }
            #[inline]
            fn next_up(self) -> Self {
                Self::from_bits(self.to_bits().saturating_add(1))
            }
            #[inline]
            fn sqrt(self) -> Self {
                if self.to_bits() <= 0 {
                    return Self::ZERO;
                }
                let square = (self.to_bits() as $square) << $fraction;
                let root = square.isqrt();
                let up = square - root * root > root;
                Self::clamped(root as $long + up as $long)
            }
            fn sin_cos(self) -> (Self, Self) {
                let (sin, cos) = self.widen().sin_cos();
                (Self::narrow(sin), Self::narrow(cos))
            }
            fn atan2(self, x: Self) -> Self {
                Self::narrow(self.widen().atan2(x.widen()))
            }
            fn acos(self) -> Self {
                Self::narrow(self.widen().acos())
            }
            fn exp(self) -> Self {
                Self::narrow(self.widen().exp())
            }
            fn pow(self, e: Self) -> Self {
                Self::narrow(self.widen().pow(e.widen()))
            }
        }
    };
}

real!(Q16, i32, i64, u64, 16);
real!(Q32, i64, i128, u128, 32);

//! The number a scene is made of, and the vector of three of them.
//!
//! Everything that the tracer computes is written once, in the words of [`Scalar`] and
//! [`Vector`]. Beside the four operations and the square root these offer the few fused
//! steps where precision is decided; each implementation makes them as exact as its
//! format allows, and never asks the platform's mathematics library.

mod pair;
mod vector;

pub(crate) use pair::Pair;
pub use vector::{Axis, Vector};

use core::fmt::{Debug, Display};
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// What vectors are made of: a number that can be added and multiplied.
///
/// All operations give the same bits on every target and never wrap: fixed point saturates.
/// Comparison is by `<`; [`min`](Self::min) and [`max`](Self::max) are compare and select, so
/// that signed zeros are treated alike everywhere.
pub trait Number:
    'static
    + Copy
    + Debug
    + Default
    + PartialEq
    + PartialOrd
    + Send
    + Sync
    + Add<Output = Self>
    + AddAssign
    + Mul<Output = Self>
    + MulAssign
    + Neg<Output = Self>
    + Sub<Output = Self>
    + SubAssign
{
    /// 0.
    const ZERO: Self;
    /// ½.
    const HALF: Self;
    /// 1.
    const ONE: Self;

    /// Neither infinite nor not-a-number.
    fn is_finite(self) -> bool;

    /// The smaller of two numbers; `self` where they are equal.
    #[inline]
    fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }

    /// The larger of two numbers; `self` where they are equal.
    #[inline]
    fn max(self, other: Self) -> Self {
        if self < other { other } else { self }
    }

    /// The magnitude.
    #[inline]
    fn abs(self) -> Self {
        if self < Self::ZERO { -self } else { self }
    }

    /// The number in `low..=high` nearest to this one.
    #[inline]
    fn clamp(self, low: Self, high: Self) -> Self {
        self.max(low).min(high)
    }

    /// `self²`.
    #[inline]
    fn squared(self) -> Self {
        self * self
    }

    /// `self` to a whole power, by repeated squaring.
    #[inline]
    fn powi(self, mut n: u32) -> Self {
        let (mut base, mut result) = (self, Self::ONE);
        while n > 0 {
            if n & 1 == 1 {
                result *= base;
            }
            base *= base;
            n >>= 1;
        }
        result
    }
}

/// A number that formulas are written in: it divides, has a root and the common functions.
///
/// A quotient by 0 is infinite, or the greatest number where there is no infinity.
pub trait Real: Number + Div<Output = Self> {
    /// 2.
    const TWO: Self;
    /// π.
    const PI: Self;
    /// The distance from 1 to the next larger number; of the wide number of fixed point, the relative
    /// precision that functions and products of matrices keep.
    const EPSILON: Self;
    /// Farther than any point of a scene: the end of an unbounded ray.
    const FAR: Self;
    /// The smallest positive number of full precision.
    const TINY: Self;

    /// The number `n`.
    fn from_i32(n: i32) -> Self;
    /// `n / d`, rounded once.
    fn from_ratio(n: i32, d: i32) -> Self;
    /// The nearest number to `x`.
    fn from_f64(x: f64) -> Self;
    /// The value, exactly where `f64` can hold it.
    fn to_f64(self) -> f64;
    /// The nearest whole number, ties away from 0, saturating at the ends of `i32`.
    fn nearest(self) -> i32;
    /// The next larger number.
    fn next_up(self) -> Self;
    /// The next smaller number.
    #[inline]
    fn next_down(self) -> Self {
        -(-self).next_up()
    }
    /// The square root, correctly rounded; 0 for negative numbers.
    fn sqrt(self) -> Self;
    /// The rounded sum of two numbers and what was rounded away, exactly; of a number in fixed
    /// point nothing is kept.
    ///
    /// Source: D. E. Knuth, *The Art of Computer Programming*, volume 2, section 4.2.2.
    #[inline]
    fn two_sum(self, other: Self) -> (Self, Self) {
        (self + other, Self::ZERO)
    }
    /// The rounded product of two numbers and what was rounded away, exactly but for underflow; of a
    /// number in fixed point nothing is kept.
    ///
    /// Source: T. J. Dekker, "A floating-point technique for extending the available precision" (1971).
    #[inline]
    fn two_product(self, other: Self) -> (Self, Self) {
        (self * other, Self::ZERO)
    }
    /// Sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);
    /// The angle of the point (`x`, `self`) in −π..=π.
    fn atan2(self, x: Self) -> Self;
    /// The angle in 0..=π whose cosine this is; the argument is clamped to −1..=1.
    fn acos(self) -> Self;
    /// eˣ.
    fn exp(self) -> Self;
    /// `self` to the power `e`, for `self ≥ 0`.
    fn pow(self, e: Self) -> Self;
}

/// A real number in some format: `f32`, `f64`, and in fixed point [`Q16`](crate::Q16) and [`Q32`](crate::Q32).
///
/// A scene is made of such numbers. Around each stand three companions, which for the floats are
/// all the number itself: [`Unit`](Self::Unit), a component of a direction; [`Wide`](Self::Wide), in
/// which what must not round or overflow on the way is computed; and [`Inverse`](Self::Inverse), the
/// reciprocal of a component of a direction.
pub trait Scalar: Real + Display {
    /// Three of these numbers: a point.
    type Vec3: Vector<Scalar = Self>;
    /// A component of a direction, or a cosine: in fixed point with all its digits behind the point.
    type Unit: Number;
    /// A direction; in fixed point always of unit length.
    type Dir: Vector<Scalar = Self::Unit>;
    /// The number for long formulas: of at least the precision of this one, and in fixed point
    /// with an exponent of its own, so that nothing overflows on the way.
    type Wide: Real;
    /// Three numbers for long formulas.
    type WideVec: Vector<Scalar = Self::Wide>;
    /// The reciprocal of a component of a direction.
    type Inverse: Copy + Debug + PartialEq + Send + Sync;
    /// What [`recentre`](Self::recentre) wants to know of a direction, computed once a ray.
    type Aim: Copy + Debug + Send + Sync;
    /// The little-endian bytes of one number, for digests.
    type Bytes: AsRef<[u8]>;

    /// The name of the format, as command lines spell it.
    const NAME: &'static str;
    /// Long sums are rounded to this precision, so that a root gains from a second step.
    const REFINES: bool;
    /// The wide number has hardly more digits than a coordinate, so that what is to be decided closely
    /// takes two of them.
    const PAIRS: bool;
    /// A power of two at or just above the square root of the rounding of a number near 1.
    const EPSILON_ROOT: Self;
    /// The greatest magnitude of a legal coordinate or length.
    const COORD_MAX: Self;
    /// The smallest legal length: a radius, an edge, an axis.
    const LENGTH_MIN: Self;

    /// The bits, least significant byte first.
    fn to_le_bytes(self) -> Self::Bytes;
    /// `⌊self · 2³²⌋`, with everything below 0 as 0 and from 1 on as the greatest `u32`.
    fn to_unit_bits(self) -> u32;
    /// `⌊self⌋`, saturating at the ends of `i64`.
    fn floor_i64(self) -> i64;
    /// `⌊self⌋` in the same format.
    fn floor(self) -> Self;

    /// The same number, for a long formula.
    fn widen(self) -> Self::Wide;
    /// The nearest number; the greatest or least one where it lies beyond.
    fn narrow(wide: Self::Wide) -> Self;
    /// The nearest number to a cosine.
    fn from_unit(unit: Self::Unit) -> Self;
    /// The same cosine, for a long formula.
    fn widen_unit(unit: Self::Unit) -> Self::Wide;
    /// The nearest cosine; in fixed point clamped to less than 2.
    fn narrow_unit(wide: Self::Wide) -> Self::Unit;

    /// The unit vector in the direction of a vector; zero for the zero vector.
    fn unit(v: Self::WideVec) -> Self::Dir;
    /// The direction of a vector, of unit length, and its length; both zero for the zero vector.
    fn toward(v: Self::Vec3) -> (Self::Dir, Self);
    /// The direction of a vector, and how many of the vector's lengths t counts in along it: as it
    /// is in a float, of unit length in fixed point.
    fn steer(v: Self::WideVec) -> (Self::Dir, Self::Wide);
    /// The plane `normal · p = offset` with a legal normal, and its offset: as it is in a float, of unit
    /// length in fixed point.
    fn plane(normal: Self::WideVec, offset: Self::Wide) -> (Self::Dir, Self);
    /// `t·dir`, rounded once.
    fn along(dir: Self::Dir, t: Self) -> Self::Vec3;
    /// `v − 2·cosine·normal`: mirrored where the cosine is that between the two.
    fn mirror(v: Self::Dir, normal: Self::Dir, cosine: Self::Unit) -> Self::Dir;

    /// `1/d`; parallel where d is 0.
    fn reciprocal(d: Self::Unit) -> Self::Inverse;
    /// The component is 0, or so small that its reciprocal is infinite.
    fn is_parallel(inverse: Self::Inverse) -> bool;
    /// The component is negative.
    fn is_backward(inverse: Self::Inverse) -> bool;
    /// `(to − from)/d` for the reciprocal of d: rounded at most twice, and in fixed point saturating.
    fn quotient(to: Self, from: Self, inverse: Self::Inverse) -> Self;

    /// How far rounding may move a number of this magnitude, at ½ each time.
    fn rounding(magnitude: Self::Wide) -> Self::Wide;
    /// `a·b − c·d` with the exact sign: 0 only where the products are equal.
    fn det2(a: Self::Wide, b: Self::Wide, c: Self::Wide, d: Self::Wide) -> Self::Wide;
    /// `a · b` as if computed in twice the precision of this number and rounded last.
    ///
    /// Source: T. Ogita, S. M. Rump and S. Oishi, "Accurate Sum and Dot Product" (2005).
    fn dot_wide(a: Self::WideVec, b: Self::WideVec) -> Self::Wide;
    /// `offset − normal·p`: how far a point lies below a plane, with [`dot_wide`](Self::dot_wide).
    fn height(offset: Self::Wide, normal: Self::WideVec, p: Self::WideVec) -> Self::Wide;
    /// `(a − o)/d < (b − p)/e` for `(a, o, d)` and `(b, p, e)`, decided exactly; `d` and `e`
    /// are not 0.
    fn precedes(first: (Self, Self, Self::Unit), second: (Self, Self, Self::Unit)) -> bool;
    /// What [`recentre`](Self::recentre) caches of a direction.
    fn aim(dir: Self::Dir) -> Self::Aim;
    /// The direction that was aimed, for long formulas.
    fn heading(dir: Self::Dir, aim: &Self::Aim) -> Self::WideVec;
    /// About the parameter at which a ray is nearest to a point; `inv_dd` is `1/(dir · dir)`.
    fn approach(origin: Self::Vec3, centre: Self::Vec3, dir: Self::Dir, inv_dd: Self::Wide)
    -> Self;
    /// The line of a ray may come within `radius` of `centre`; never false where it does.
    fn may_pass(
        origin: Self::Vec3,
        centre: Self::Vec3,
        dir: Self::Dir,
        inv_dd: Self::Wide,
        radius: Self,
    ) -> bool;
    /// `origin − centre + k·dir`, as if computed exactly and rounded last: the point of the
    /// ray at `k`, seen from `centre`, with no cancellation however far the origin is.
    ///
    /// Source: error-free transforms of Dekker (1971) and Knuth, as in
    /// Haines et al., *Ray Tracing Gems* (2019), chapter 7, carried further; in fixed point
    /// products of integers are exact.
    fn recentre(
        origin: Self::Vec3,
        centre: Self::Vec3,
        dir: Self::Dir,
        aim: &Self::Aim,
        k: Self,
    ) -> Self::WideVec;

    /// What the rounding of [`recentre`](Self::recentre) took from its point, itself rounded.
    fn recentre_rest(
        origin: Self::Vec3,
        centre: Self::Vec3,
        dir: Self::Dir,
        aim: &Self::Aim,
        k: Self,
    ) -> Self::WideVec;

    /// The same point, for a long formula.
    #[inline]
    fn widen_vec(v: Self::Vec3) -> Self::WideVec {
        let [x, y, z] = v.to_array().map(Self::widen);
        Self::WideVec::new(x, y, z)
    }

    /// The nearest point.
    #[inline]
    fn narrow_vec(v: Self::WideVec) -> Self::Vec3 {
        let [x, y, z] = v.to_array().map(Self::narrow);
        Self::Vec3::new(x, y, z)
    }

    /// The nearest direction to a vector of unit length.
    #[inline]
    fn narrow_dir(v: Self::WideVec) -> Self::Dir {
        let [x, y, z] = v.to_array().map(Self::narrow_unit);
        Self::Dir::new(x, y, z)
    }

    /// The same direction, for a long formula.
    #[inline]
    fn widen_dir(dir: Self::Dir) -> Self::WideVec {
        let [x, y, z] = dir.to_array().map(Self::widen_unit);
        Self::WideVec::new(x, y, z)
    }
}

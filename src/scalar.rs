//! The number a scene is made of, and the vector of three of them.
//!
//! Everything that the tracer computes is written once, in the words of [`Scalar`] and
//! [`Vector`]. Beside the four operations and the square root these offer the few fused
//! steps where precision is decided; each implementation makes them as exact as its
//! format allows, and never asks the platform's mathematics library.

use core::fmt::{Debug, Display};
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// A real number in some format: `f32`, `f64`.
///
/// All operations give the same bits on every target. Comparison is by `<`; [`min`](Self::min)
/// and [`max`](Self::max) are compare and select, so that signed zeros are treated alike everywhere.
pub trait Scalar:
    'static
    + Copy
    + Debug
    + Default
    + Display
    + PartialEq
    + PartialOrd
    + Send
    + Sync
    + Add<Output = Self>
    + AddAssign
    + Div<Output = Self>
    + Mul<Output = Self>
    + MulAssign
    + Neg<Output = Self>
    + Sub<Output = Self>
    + SubAssign
{
    /// Three of these numbers.
    type Vec3: Vector<Scalar = Self>;
    /// What [`recentre`](Self::recentre) wants to know of a direction, computed once a ray.
    type Aim: Copy + Debug + Send + Sync;
    /// The little-endian bytes of one number, for digests.
    type Bytes: AsRef<[u8]>;

    /// The name of the format, as command lines spell it.
    const NAME: &'static str;
    /// 0.
    const ZERO: Self;
    /// ½.
    const HALF: Self;
    /// 1.
    const ONE: Self;
    /// 2.
    const TWO: Self;
    /// π.
    const PI: Self;
    /// The distance from 1 to the next larger number.
    const EPSILON: Self;
    /// A power of two at or just above the square root of [`EPSILON`](Self::EPSILON).
    const EPSILON_ROOT: Self;
    /// Farther than any point of a scene: the end of an unbounded ray.
    const FAR: Self;
    /// The smallest positive number of full precision.
    const TINY: Self;
    /// The greatest magnitude of a legal coordinate or length.
    const COORD_MAX: Self;
    /// The smallest legal length: a radius, an edge, an axis.
    const LENGTH_MIN: Self;

    /// The number `n`.
    fn from_i32(n: i32) -> Self;
    /// `n / d`, rounded once.
    fn from_ratio(n: i32, d: i32) -> Self;
    /// The nearest number to `x`.
    fn from_f64(x: f64) -> Self;
    /// The value, exactly where `f64` can hold it.
    fn to_f64(self) -> f64;
    /// The bits, least significant byte first.
    fn to_le_bytes(self) -> Self::Bytes;
    /// `⌊self · 2³²⌋`, with everything below 0 as 0 and from 1 on as the greatest `u32`.
    fn to_unit_bits(self) -> u32;
    /// `⌊self⌋`, saturating at the ends of `i64`.
    fn floor_i64(self) -> i64;
    /// The next larger number.
    fn next_up(self) -> Self;
    /// `⌊self⌋` in the same format.
    fn floor(self) -> Self;
    /// Neither infinite nor not-a-number.
    fn is_finite(self) -> bool;

    /// The square root, correctly rounded; 0 for negative numbers.
    fn sqrt(self) -> Self;
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

    /// `a·b − c·d` with the exact sign: 0 only where the products are equal.
    fn det2(a: Self, b: Self, c: Self, d: Self) -> Self;
    /// `a · b` as if computed in twice the precision and rounded last.
    ///
    /// Source: T. Ogita, S. M. Rump and S. Oishi, "Accurate Sum and Dot Product" (2005).
    fn dot_wide(a: Self::Vec3, b: Self::Vec3) -> Self;
    /// `(a − o)/d < (b − p)/e` for `[a, o, d]` and `[b, p, e]`, decided exactly; `d` and `e`
    /// are not 0.
    fn precedes(first: [Self; 3], second: [Self; 3]) -> bool;
    /// What [`recentre`](Self::recentre) caches of a direction.
    fn aim(dir: Self::Vec3) -> Self::Aim;
    /// `origin − centre + k·dir`, as if computed exactly and rounded last: the point of the
    /// ray at `k`, seen from `centre`, with no cancellation however far the origin is.
    ///
    /// Source: error-free transforms of Dekker (1971) and Knuth, as in
    /// Haines et al., *Ray Tracing Gems* (2019), chapter 7, carried further.
    fn recentre(
        origin: Self::Vec3,
        centre: Self::Vec3,
        dir: Self::Vec3,
        aim: &Self::Aim,
        k: Self,
    ) -> Self::Vec3;

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

/// Three numbers: a point, a direction or a normal.
pub trait Vector:
    'static
    + Copy
    + Debug
    + Default
    + PartialEq
    + Send
    + Sync
    + Add<Output = Self>
    + AddAssign
    + Mul<Self::Scalar, Output = Self>
    + Neg<Output = Self>
    + Sub<Output = Self>
{
    /// The number that it is made of.
    type Scalar: Scalar<Vec3 = Self>;
    /// The zero vector.
    const ZERO: Self;

    /// The vector of these three coordinates.
    fn new(x: Self::Scalar, y: Self::Scalar, z: Self::Scalar) -> Self;
    /// The first coordinate.
    fn x(self) -> Self::Scalar;
    /// The second coordinate.
    fn y(self) -> Self::Scalar;
    /// The third coordinate.
    fn z(self) -> Self::Scalar;
    /// The sum of the products of the coordinates.
    fn dot(self, other: Self) -> Self::Scalar;
    /// The vector at right angles to both, right-handed.
    fn cross(self, other: Self) -> Self;

    /// The vector of three equal coordinates.
    #[inline]
    fn splat(v: Self::Scalar) -> Self {
        Self::new(v, v, v)
    }

    /// The three coordinates in order.
    #[inline]
    fn to_array(self) -> [Self::Scalar; 3] {
        [self.x(), self.y(), self.z()]
    }

    /// The vector of three coordinates in order.
    #[inline]
    fn from_array([x, y, z]: [Self::Scalar; 3]) -> Self {
        Self::new(x, y, z)
    }

    /// One coordinate.
    #[inline]
    fn get(self, axis: Axis) -> Self::Scalar {
        match axis {
            Axis::X => self.x(),
            Axis::Y => self.y(),
            Axis::Z => self.z(),
        }
    }

    /// The vector with one coordinate replaced.
    #[inline]
    fn with(self, axis: Axis, value: Self::Scalar) -> Self {
        match axis {
            Axis::X => Self::new(value, self.y(), self.z()),
            Axis::Y => Self::new(self.x(), value, self.z()),
            Axis::Z => Self::new(self.x(), self.y(), value),
        }
    }

    /// Each coordinate by itself.
    #[inline]
    fn map(self, f: impl Fn(Self::Scalar) -> Self::Scalar) -> Self {
        Self::new(f(self.x()), f(self.y()), f(self.z()))
    }

    /// Coordinates of two vectors, pair by pair.
    #[inline]
    fn zip(self, other: Self, f: impl Fn(Self::Scalar, Self::Scalar) -> Self::Scalar) -> Self {
        Self::new(f(self.x(), other.x()), f(self.y(), other.y()), f(self.z(), other.z()))
    }

    /// The square of the length.
    #[inline]
    fn length_squared(self) -> Self::Scalar {
        self.dot(self)
    }

    /// The greatest magnitude of a coordinate.
    #[inline]
    fn max_abs(self) -> Self::Scalar {
        self.x().abs().max(self.y().abs()).max(self.z().abs())
    }

    /// The length, without overflow or underflow on the way.
    #[inline]
    fn length(self) -> Self::Scalar {
        let scale = self.max_abs();
        if scale == Self::Scalar::ZERO {
            return scale;
        }
        self.scaled_down(scale).length_squared().sqrt() * scale
    }

    /// The vector of length 1 in the same direction; zero for the zero vector.
    #[inline]
    fn normalize(self) -> Self {
        let scale = self.max_abs();
        if scale == Self::Scalar::ZERO {
            return self;
        }
        let scaled = self.scaled_down(scale);
        scaled * (Self::Scalar::ONE / scaled.length_squared().sqrt())
    }

    /// The vector divided by a positive number.
    #[inline]
    fn scaled_down(self, by: Self::Scalar) -> Self {
        if by < Self::Scalar::TINY {
            // The reciprocal would overflow.
            self.map(|v| v / by)
        } else {
            self * (Self::Scalar::ONE / by)
        }
    }

    /// Every coordinate is finite.
    #[inline]
    fn is_finite(self) -> bool {
        self.x().is_finite() && self.y().is_finite() && self.z().is_finite()
    }

    /// Two unit vectors that make a right-handed orthonormal basis (a, b, self) with this unit vector.
    ///
    /// The first is at right angles to the coordinate axis farthest from this vector, so no
    /// direction is ill-conditioned.
    #[inline]
    fn basis(self) -> (Self, Self) {
        let (ax, ay, az) = (self.x().abs(), self.y().abs(), self.z().abs());
        let helper = if ax <= ay && ax <= az {
            Self::ZERO.with(Axis::X, Self::Scalar::ONE)
        } else if ay <= az {
            Self::ZERO.with(Axis::Y, Self::Scalar::ONE)
        } else {
            Self::ZERO.with(Axis::Z, Self::Scalar::ONE)
        };
        let a = helper.cross(self).normalize();
        (a, self.cross(a))
    }
}

/// One of the three coordinate axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// The first.
    X,
    /// The second.
    Y,
    /// The third.
    Z,
}

impl Axis {
    /// The axes in order.
    pub const ALL: [Self; 3] = [Self::X, Self::Y, Self::Z];

    /// The axis after this one, round and round.
    #[must_use]
    #[inline]
    pub const fn next(self) -> Self {
        match self {
            Self::X => Self::Y,
            Self::Y => Self::Z,
            Self::Z => Self::X,
        }
    }
}

//! Three numbers, and the axes they belong to.

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Mul, Neg, Sub};

use super::{Number, Real};

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
    type Scalar: Number;
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
    fn length(self) -> Self::Scalar
    where
        Self::Scalar: Real,
    {
        let scale = self.max_abs();
        if scale == Self::Scalar::ZERO {
            return scale;
        }
        self.scaled_down(scale).length_squared().sqrt() * scale
    }

    /// The vector of length 1 in the same direction; zero for the zero vector.
    #[inline]
    fn normalize(self) -> Self
    where
        Self::Scalar: Real,
    {
        let scale = self.max_abs();
        if scale == Self::Scalar::ZERO {
            return self;
        }
        let scaled = self.scaled_down(scale);
        scaled * (Self::Scalar::ONE / scaled.length_squared().sqrt())
    }

    /// The vector divided by a positive number.
    #[inline]
    fn scaled_down(self, by: Self::Scalar) -> Self
    where
        Self::Scalar: Real,
    {
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
    fn basis(self) -> (Self, Self)
    where
        Self::Scalar: Real,
    {
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

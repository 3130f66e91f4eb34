//! Three fixed-point numbers.

use core::ops::{Add, AddAssign, Mul, Neg, Sub};

use super::wide::Wide;
use crate::scalar::{Number, Vector};

/// A point, a direction or a normal in fixed point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Triple<T> {
    /// The first coordinate.
    pub x: T,
    /// The second coordinate.
    pub y: T,
    /// The third coordinate.
    pub z: T,
}

impl<T> Triple<T> {
    /// The vector of three coordinates.
    pub const fn new(x: T, y: T, z: T) -> Self {
        Self { x, y, z }
    }
}

/// Sums of products that are rounded once.
pub trait Component: Number {
    /// `a·b`.
    fn dot3(a: [Self; 3], b: [Self; 3]) -> Self;
    /// `a·b − c·d`.
    fn det(a: Self, b: Self, c: Self, d: Self) -> Self;
}

impl Component for Wide {
    #[inline]
    fn dot3([ax, ay, az]: [Self; 3], [bx, by, bz]: [Self; 3]) -> Self {
        ax * bx + ay * by + az * bz
    }
    #[inline]
    fn det(a: Self, b: Self, c: Self, d: Self) -> Self {
        a * b - c * d
    }
}

impl<T: Number> Add for Triple<T> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<T: Number> AddAssign for Triple<T> {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<T: Number> Sub for Triple<T> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<T: Number> Neg for Triple<T> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}

impl<T: Number> Mul<T> for Triple<T> {
    type Output = Self;
    #[inline]
    fn mul(self, factor: T) -> Self {
        Self::new(self.x * factor, self.y * factor, self.z * factor)
    }
}

impl<T: Component> Vector for Triple<T> {
    type Scalar = T;
    const ZERO: Self = Self::new(T::ZERO, T::ZERO, T::ZERO);

    #[inline]
    fn new(x: T, y: T, z: T) -> Self {
        Self { x, y, z }
    }
    #[inline]
    fn x(self) -> T {
        self.x
    }
    #[inline]
    fn y(self) -> T {
        self.y
    }
    #[inline]
    fn z(self) -> T {
        self.z
    }
    #[inline]
    fn dot(self, other: Self) -> T {
        T::dot3([self.x, self.y, self.z], [other.x, other.y, other.z])
    }
    #[inline]
    fn cross(self, other: Self) -> Self {
        Self::new(
            T::det(self.y, other.z, self.z, other.y),
            T::det(self.z, other.x, self.x, other.z),
            T::det(self.x, other.y, self.y, other.x),
        )
    }
}

//! A ray as a surface of revolution sees it: its distance from the axis at each height.

use crate::place::Local;
use crate::scalar::{Real, Scalar, Vector};
use crate::shape::cylinder::is_axial;

/// A ray around the y axis. Its squared distance from the axis at the parameter t is
/// `across·t² + 2·along·t` more than at its origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sweep<T> {
    x: T,
    z: T,
    pub(super) y: T,
    dx: T,
    dz: T,
    pub(super) dy: T,
    /// The square of the direction, seen along the axis.
    pub(super) across: T,
    /// The product of origin and direction, seen along the axis.
    pub(super) along: T,
    /// How far the ray passes the axis, times the length of the direction, seen along the axis.
    pub(super) moment: T,
    inverse: T,
    /// The ray is parallel to the axis, as far as its direction can tell.
    axial: bool,
    /// The ray is at right angles to the axis, as far as its direction can tell.
    pub(super) level: bool,
}

impl<T: Real> Sweep<T> {
    pub(super) fn new<S: Scalar<Wide = T>>(ray: &Local<S>) -> Self {
        let ([x, y, z], [dx, dy, dz]) = (ray.origin.to_array(), ray.dir.to_array());
        let across = dx.squared() + dz.squared();
        Self {
            x,
            z,
            y,
            dx,
            dz,
            dy,
            across,
            along: x * dx + z * dz,
            moment: x * dz - z * dx,
            inverse: T::ONE / dy,
            axial: is_axial(across, ray.dd),
            level: is_axial(dy.squared(), ray.dd),
        }
    }

    /// The parameter at a height above the local origin; the ray is not level.
    #[inline]
    pub(super) fn at_height(&self, y: T) -> T {
        self.above(y - self.y)
    }

    /// The parameter at a height above the ray's origin; the ray is not level.
    #[inline]
    pub(super) fn above(&self, height: T) -> T {
        height * self.inverse
    }

    /// The direction, seen along the axis.
    #[inline]
    pub(super) fn heading(&self) -> [T; 2] {
        [self.dx, self.dz]
    }

    /// The place at a parameter, seen along the axis.
    #[inline]
    pub(super) fn place(&self, t: T) -> [T; 2] {
        [self.x + t * self.dx, self.z + t * self.dz]
    }

    /// How much farther from the axis the ray is at `t` than `rho`, in squares. A vertex of a
    /// profile that gives less than 0 has the ray on the side of the axis.
    #[inline]
    pub(super) fn beyond(&self, rho: T, t: T) -> T {
        let [x, z] = self.place(t);
        (x.squared() + z.squared()) - rho.squared()
    }

    /// Where the ray is nearer to the axis than a little more than `rho`.
    #[inline]
    pub(super) fn window(&self, rho: T) -> Option<[T; 2]> {
        let square = rho.squared();
        let square = square + square * (T::HALF * T::HALF * T::HALF);
        if self.axial {
            let near = self.x.squared() + self.z.squared() < square;
            return near.then(|| [-T::FAR, T::FAR]);
        }
        let discriminant = square * self.across - self.moment.squared();
        (discriminant > T::ZERO).then(|| {
            let (middle, half) = (-self.along / self.across, discriminant.sqrt() / self.across);
            [middle - half, middle + half]
        })
    }

    /// Where the ray is at the distance `rho` from the axis, in ascending order.
    #[inline]
    pub(super) fn at_distance(&self, rho: T) -> Option<[T; 2]> {
        let discriminant = rho.squared() * self.across - self.moment.squared();
        if !(discriminant > T::ZERO) {
            return None;
        }
        let (middle, half) = (-self.along / self.across, discriminant.sqrt() / self.across);
        let ends = [middle - half, middle + half];
        (middle - half < middle + half).then_some(ends)
    }
}

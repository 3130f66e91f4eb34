//! A ray and a polygon, seen along the axis of a prism.

use crate::place::Local;
use crate::scalar::{Real, Scalar, Vector};
use crate::shape::crossings::{BOTH, LOWER, UPPER};

/// A place in the plane of the polygon.
pub(super) type Spot<T> = [T; 2];

/// A ray as seen along the axis.
pub(super) struct Plan<T> {
    pub(super) at: Spot<T>,
    pub(super) dir: Spot<T>,
    /// The square of the direction.
    pub(super) across: T,
}

/// A vertex as a ray sees it.
#[derive(Clone, Copy)]
pub(super) struct Seen<T> {
    /// On which side of the ray it lies; 0 on the ray itself.
    pub(super) side: T,
    /// The parameter at which the ray is nearest to it.
    pub(super) t: T,
}

impl<T: Real> Plan<T> {
    pub(super) fn new<S: Scalar<Wide = T>>(ray: &Local<S>) -> Self {
        let dir = [ray.dir.x(), ray.dir.z()];
        let across = dir[0].squared() + dir[1].squared();
        Self { at: [ray.origin.x(), ray.origin.z()], dir, across }
    }

    #[inline]
    pub(super) fn see<S: Scalar<Wide = T>>(&self, [x, z]: Spot<T>) -> Seen<T> {
        let ([x, z], [dx, dz]) = ([x - self.at[0], z - self.at[1]], self.dir);
        Seen { side: S::det2(x, dz, z, dx), t: (x * dx + z * dz) / self.across }
    }
}

/// The parameter at which a ray crosses the edge between two vertices on different sides of it.
#[inline]
pub(super) fn crossing<T: Real>(from: &Seen<T>, to: &Seen<T>) -> T {
    let share = from.side / (from.side - to.side);
    from.t * (T::ONE - share) + to.t * share
}

/// By which rules an edge crosses a ray: a vertex on it lies to the one side or to the other.
#[inline]
pub(super) fn rules_of<T: Real>([from, to]: [T; 2], departs: bool) -> u8 {
    let zero = T::ZERO;
    let lower = (from < zero) != (to < zero);
    if departs {
        return if lower { BOTH } else { 0 };
    }
    let upper = (zero < from) != (zero < to);
    u8::from(lower) * LOWER + u8::from(upper) * UPPER
}

#[inline]
pub(super) fn spot<S: Scalar>(vertex: S::Vec3) -> Spot<S::Wide> {
    [vertex.x().widen(), vertex.z().widen()]
}

/// The edges in order.
pub(super) fn edges<S: Scalar>(
    vertices: &[S::Vec3],
) -> impl Iterator<Item = [Spot<S::Wide>; 2]> + Clone {
    let next = vertices.iter().skip(1).chain(vertices.first());
    vertices.iter().zip(next).map(|(from, to)| [*from, *to].map(spot::<S>))
}

/// Where on an edge a place close to it lies, in 0..=1.
pub(super) fn share_of<T: Real>([from, to]: [Spot<T>; 2], at: Spot<T>) -> T {
    let (x, z) = (to[0] - from[0], to[1] - from[1]);
    let scale = x.abs().max(z.abs());
    let (x, z) = (x / scale, z / scale);
    let way = (at[0] - from[0]) * x + (at[1] - from[1]) * z;
    (way / ((x.squared() + z.squared()) * scale)).clamp(T::ZERO, T::ONE)
}

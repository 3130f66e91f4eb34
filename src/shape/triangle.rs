//! The triangle, watertight along its edges.

use super::{Flaw, Primitive, Sight, check_point, unplaced};
use crate::bounds::Bounds;
use crate::place::Placement;
use crate::ray::Line;
use crate::scalar::{Axis, Scalar, Vector};
use crate::span::Span;

/// A triangle of the scene's vertices, seen from both sides; its normal is that of the
/// counterclockwise side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Triangle {
    /// The corners, as indices into the scene's points.
    pub corners: [u32; 3],
    /// The first of three points that hold the shading normals of the corners; none if
    /// beyond the end of the table ([`Triangle::FLAT`]).
    pub normals: u32,
}

impl Triangle {
    /// No shading normals: the triangle looks as flat as it is.
    pub const FLAT: u32 = u32::MAX;

    fn corners<S: Scalar>(&self, points: &[S::Vec3]) -> Option<[S::Vec3; 3]> {
        let [a, b, c] = self.corners.map(|i| points.get(i as usize).copied());
        Some([a?, b?, c?])
    }

    fn normals<S: Scalar>(&self, points: &[S::Vec3]) -> Option<[S::Vec3; 3]> {
        let first = self.normals as usize;
        match points.get(first..first.checked_add(3)?)? {
            &[a, b, c] => Some([a, b, c]),
            _ => None,
        }
    }

    /// The shares of the corners in a point of the triangle.
    fn shares<S: Scalar>(&self, p: S::Vec3, points: &[S::Vec3]) -> [S; 3] {
        let Some([a, b, c]) = self.corners::<S>(points) else {
            return [S::ONE, S::ZERO, S::ZERO];
        };
        let normal = (b - a).cross(c - a);
        let inverse = S::ONE / normal.length_squared();
        let u = (p - a).cross(c - a).dot(normal) * -inverse;
        let v = (b - a).cross(p - a).dot(normal) * inverse;
        let (u, v) = (u.clamp(S::ZERO, S::ONE), v.clamp(S::ZERO, S::ONE));
        let (u, v) = if u + v > S::ONE { (u / (u + v), v / (u + v)) } else { (u, v) };
        [S::ONE - u - v, u, v]
    }

    /// The normal that light sees at a point: that of the corners, by their shares, where the
    /// triangle has them.
    pub(crate) fn shading_normal<S: Scalar>(
        &self,
        p: S::Vec3,
        points: &[S::Vec3],
    ) -> Option<S::Vec3> {
        let [na, nb, nc] = self.normals::<S>(points)?;
        let [a, b, c] = self.shares::<S>(p, points);
        let normal = na * a + nb * b + nc * c;
        (normal != S::Vec3::ZERO).then_some(normal)
    }
}

/// A ray's direction turned to the third of three axes, by a shear.
#[derive(Clone, Copy)]
pub(super) struct Shear<S> {
    axes: [Axis; 3],
    x: S,
    y: S,
    /// 1 / the direction along the third.
    inverse: S,
}

impl<S: Scalar> Shear<S> {
    /// The shear along the axis in which the ray goes farthest.
    #[inline]
    pub(super) fn new(line: &Line<S>) -> Self {
        let [x, y, z] = line.dir.to_array().map(S::abs);
        let along = if x >= y && x >= z {
            Axis::X
        } else if y >= z {
            Axis::Y
        } else {
            Axis::Z
        };
        let axes = [along.next(), along.next().next(), along];
        let inverse = line.inv_dir.get(along);
        let share = |axis: Axis| line.dir.get(axis) * inverse;
        Self { axes, x: share(along.next()), y: share(along.next().next()), inverse }
    }

    /// A vertex across the ray, relative to its origin, and the t of its depth. The same vertex gives the same bits
    /// whatever it is a vertex of; that is what makes shared edges watertight.
    #[inline]
    pub(super) fn across(&self, vertex: S::Vec3, origin: S::Vec3) -> [S; 3] {
        let from = vertex - origin;
        let [kx, ky, kz] = self.axes;
        let depth = from.get(kz);
        [from.get(kx) - self.x * depth, from.get(ky) - self.y * depth, depth * self.inverse]
    }
}

/// A ray through an edge is inside: of the edges from one y to the next, with these edge
/// functions, a half-line along x crosses an odd number.
#[cold]
fn owns_edge<S: Scalar>([ay, by, cy]: [S; 3], [ab, bc, ca]: [S; 3]) -> bool {
    let crosses = |from: S, to: S, side: S| {
        let upward = to > S::ZERO;
        (from > S::ZERO) != upward && if upward { side < S::ZERO } else { side > S::ZERO }
    };
    crosses(ay, by, ab) ^ crosses(by, cy, bc) ^ crosses(cy, ay, ca)
}

impl<S: Scalar> Primitive<S> for Triangle {
    const OPEN: bool = true;
    const SPANS_MAX: u16 = 1;

    fn centre(&self) -> S::Vec3 {
        S::Vec3::ZERO
    }

    fn check(&self, placed: bool, points: &[S::Vec3]) -> Result<(), Flaw> {
        unplaced(placed, "corners")?;
        let [a, b, c] = self.corners::<S>(points).ok_or(Flaw::Index("corners"))?;
        for corner in [a, b, c] {
            check_point::<S>(corner, "corners")?;
        }
        if self.normals != Self::FLAT {
            for normal in self.normals::<S>(points).ok_or(Flaw::Index("normals"))? {
                check_point::<S>(normal, "normals")?;
            }
        }
        let normal = (b - a).normalize().cross((c - a).normalize());
        if normal.max_abs() > S::EPSILON { Ok(()) } else { Err(Flaw::Empty("corners")) }
    }

    fn bounds(&self, _: Option<&Placement<S>>, points: &[S::Vec3]) -> Bounds<S> {
        self.corners::<S>(points).map_or_else(Bounds::nothing, |corners| Bounds::around(&corners))
    }

    /// Source: Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection" (2013); the edge
    /// functions have their exact sign, so no wider fallback is needed. A point of an edge that
    /// two faces share belongs to one of them, by the rule of [`Polygon`](super::Polygon).
    #[inline]
    fn spans(&self, sight: &Sight<'_, S>, mut emit: impl FnMut(Span<S>)) {
        let Some([a, b, c]) = self.corners::<S>(sight.points) else {
            return;
        };
        if sight.start.is_some() {
            return;
        }
        let (line, shear) = (sight.line, Shear::new(sight.line));
        let [[ax, ay, at], [bx, by, bt], [cx, cy, ct]] =
            [a, b, c].map(|v| shear.across(v, line.origin));
        let u = S::det2(cx, by, cy, bx);
        let v = S::det2(ax, cy, ay, cx);
        let w = S::det2(bx, ay, by, ax);
        let edge = u == S::ZERO || v == S::ZERO || w == S::ZERO;
        if edge && !owns_edge([ay, by, cy], [w, u, v]) {
            return;
        }
        let negative = u < S::ZERO || v < S::ZERO || w < S::ZERO;
        let positive = u > S::ZERO || v > S::ZERO || w > S::ZERO;
        let sum = u + v + w;
        if (negative && positive) || sum == S::ZERO {
            return;
        }
        emit(Span::touch((u * at + v * bt + w * ct) / sum));
    }

    fn snap(&self, local: S::Vec3, _: u16) -> S::Vec3 {
        local
    }

    fn normal(&self, _: S::Vec3, _: u16, points: &[S::Vec3]) -> S::Vec3 {
        self.corners::<S>(points)
            .map_or(S::Vec3::ZERO, |[a, b, c]| (b - a).normalize().cross((c - a).normalize()))
    }

    /// The shares of the second and the third corner.
    fn uv(&self, local: S::Vec3, _: u16, points: &[S::Vec3]) -> [S; 2] {
        let [_, u, v] = self.shares::<S>(local, points);
        [u, v]
    }
}

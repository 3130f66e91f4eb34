//! The triangle, watertight along its edges.

use super::{Flaw, Primitive, Sight, Tables, check_point, unplaced};
use crate::bounds::Bounds;
use crate::place::Placement;
use crate::ray::Line;
use crate::scalar::{Axis, Number, Real, Scalar, Vector};
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

    fn corners<S: Scalar>(&self, tables: &Tables<'_, S>) -> Option<[S::Vec3; 3]> {
        let [a, b, c] = self.corners.map(|i| tables.points.get(i as usize).copied());
        Some([a?, b?, c?])
    }

    fn normals<S: Scalar>(&self, tables: &Tables<'_, S>) -> Option<[S::Vec3; 3]> {
        let first = self.normals as usize;
        match tables.points.get(first..first.checked_add(3)?)? {
            &[a, b, c] => Some([a, b, c]),
            _ => None,
        }
    }

    fn wide_corners<S: Scalar>(&self, tables: &Tables<'_, S>) -> Option<[S::WideVec; 3]> {
        self.corners::<S>(tables).map(|corners| corners.map(S::widen_vec))
    }

    /// The shares of the corners in a point of the triangle.
    fn shares<S: Scalar>(&self, p: S::Vec3, tables: &Tables<'_, S>) -> [S::Wide; 3] {
        self.wide_corners::<S>(tables)
            .map_or([S::Wide::ONE, S::Wide::ZERO, S::Wide::ZERO], |corners| shares::<S>(corners, p))
    }
}

/// The shares of three corners in a point between them.
pub(super) fn shares<S: Scalar>([a, b, c]: [S::WideVec; 3], p: S::Vec3) -> [S::Wide; 3] {
    let (zero, one) = (S::Wide::ZERO, S::Wide::ONE);
    let (b, c, p) = (b - a, c - a, S::widen_vec(p) - a);
    // Nothing overflows on the way, whatever the size.
    let size = b.max_abs().max(c.max_abs());
    let [b, c, p] = [b, c, p].map(|v| v.scaled_down(size));
    let normal = b.cross(c);
    let inverse = one / normal.length_squared();
    let u = p.cross(c).dot(normal) * inverse;
    let v = b.cross(p).dot(normal) * inverse;
    let (u, v) = (u.clamp(zero, one), v.clamp(zero, one));
    let (u, v) = if u + v > one { (u / (u + v), v / (u + v)) } else { (u, v) };
    [one - u - v, u, v]
}

/// The normal of the counterclockwise side of three corners: of the length of the sine of their angle.
pub(super) fn normal<V: Vector<Scalar: Real>>([a, b, c]: [V; 3]) -> V {
    (b - a).normalize().cross((c - a).normalize())
}

/// A ray's direction turned to the third of three axes, by a shear.
#[derive(Clone, Copy)]
pub(super) struct Shear<T> {
    axes: [Axis; 3],
    x: T,
    y: T,
    /// 1 / the direction along the third.
    inverse: T,
}

impl<T: Real> Shear<T> {
    /// The shear along the axis in which the ray goes farthest.
    #[inline]
    pub(super) fn new<S: Scalar<Wide = T>>(line: &Line<S>) -> Self {
        let dir = line.heading();
        let [x, y, z] = dir.to_array().map(Number::abs);
        let along = if x >= y && x >= z {
            Axis::X
        } else if y >= z {
            Axis::Y
        } else {
            Axis::Z
        };
        let axes = [along.next(), along.next().next(), along];
        let inverse = T::ONE / dir.get(along);
        let share = |axis: Axis| dir.get(axis) * inverse;
        Self { axes, x: share(along.next()), y: share(along.next().next()), inverse }
    }

    /// The ray goes along that axis, not against it.
    #[inline]
    pub(super) fn is_forward(&self) -> bool {
        self.inverse > T::ZERO
    }

    /// How fast the ray goes along the axis.
    pub(super) fn speed(&self) -> T {
        (T::ONE / self.inverse).abs()
    }

    /// A vertex across the ray, relative to its origin, and the t of its depth. The same vertex gives the same bits
    /// whatever it is a vertex of; that is what makes shared edges watertight.
    #[inline]
    pub(super) fn across<V: Vector<Scalar = T>>(&self, vertex: V, origin: V) -> [T; 3] {
        let from = vertex - origin;
        let [kx, ky, kz] = self.axes;
        let depth = from.get(kz);
        [from.get(kx) - self.x * depth, from.get(ky) - self.y * depth, depth * self.inverse]
    }
}

/// A ray through an edge is inside: of the edges from one y to the next, with these edge
/// functions, a half-line along x crosses an odd number.
#[cold]
fn owns_edge<T: Real>([ay, by, cy]: [T; 3], [ab, bc, ca]: [T; 3]) -> bool {
    let crosses = |from: T, to: T, side: T| {
        let upward = to > T::ZERO;
        (from > T::ZERO) != upward && if upward { side < T::ZERO } else { side > T::ZERO }
    };
    crosses(ay, by, ab) ^ crosses(by, cy, bc) ^ crosses(cy, ay, ca)
}

impl<S: Scalar> Primitive<S> for Triangle {
    fn centre(&self) -> S::Vec3 {
        S::Vec3::ZERO
    }

    fn check(&self, placed: bool, tables: &Tables<'_, S>) -> Result<(), Flaw> {
        unplaced(placed, "corners")?;
        let [a, b, c] = self.corners::<S>(tables).ok_or(Flaw::Index("corners"))?;
        for corner in [a, b, c] {
            check_point::<S>(corner, "corners")?;
        }
        if self.normals != Self::FLAT {
            for normal in self.normals::<S>(tables).ok_or(Flaw::Index("normals"))? {
                check_point::<S>(normal, "normals")?;
            }
        }
        let normal = normal([a, b, c].map(S::widen_vec));
        if normal.max_abs() > S::EPSILON.widen() { Ok(()) } else { Err(Flaw::Empty("corners")) }
    }

    fn bounds(&self, _: Option<&Placement<S>>, tables: &Tables<'_, S>) -> Bounds<S> {
        self.corners::<S>(tables).map_or_else(Bounds::nothing, |corners| Bounds::around(&corners))
    }

    /// Source: Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection" (2013); the edge
    /// functions have their exact sign, so no wider fallback is needed. A point of an edge that
    /// two faces share belongs to one of them, by the rule of [`Polygon`](super::Polygon).
    #[inline]
    fn spans(&self, sight: &Sight<'_, S>, mut emit: impl FnMut(Span<S>)) {
        let Some([a, b, c]) = self.wide_corners::<S>(sight.tables) else {
            return;
        };
        if sight.start.is_some() {
            return;
        }
        let (shear, origin) = (Shear::new(sight.line), S::widen_vec(sight.line.origin));
        let [[ax, ay, at], [bx, by, bt], [cx, cy, ct]] = [a, b, c].map(|v| shear.across(v, origin));
        let u = S::det2(cx, by, cy, bx);
        let v = S::det2(ax, cy, ay, cx);
        let w = S::det2(bx, ay, by, ax);
        let zero = S::Wide::ZERO;
        let edge = u == zero || v == zero || w == zero;
        if edge && !owns_edge([ay, by, cy], [w, u, v]) {
            return;
        }
        let negative = u < zero || v < zero || w < zero;
        let positive = u > zero || v > zero || w > zero;
        let sum = u + v + w;
        if (negative && positive) || sum == zero {
            return;
        }
        emit(Span::touch(S::narrow((u * at + v * bt + w * ct) / sum)));
    }

    fn snap(&self, local: S::WideVec, _: u32, _: &Tables<'_, S>) -> S::Vec3 {
        S::narrow_vec(local)
    }

    fn normal(&self, _: S::Vec3, _: u32, tables: &Tables<'_, S>) -> S::WideVec {
        self.wide_corners::<S>(tables).map_or(S::WideVec::ZERO, normal)
    }

    /// That of the corners, by their shares, where the triangle has them.
    fn shading_normal(&self, local: S::Vec3, _: u32, tables: &Tables<'_, S>) -> Option<S::WideVec> {
        let [na, nb, nc] = self.normals::<S>(tables)?.map(S::widen_vec);
        let [a, b, c] = self.shares::<S>(local, tables);
        let normal = na * a + nb * b + nc * c;
        (normal != S::WideVec::ZERO).then_some(normal)
    }

    /// The shares of the second and the third corner.
    fn uv(&self, local: S::Vec3, _: u32, tables: &Tables<'_, S>) -> [S; 2] {
        let [_, u, v] = self.shares::<S>(local, tables);
        [S::narrow(u), S::narrow(v)]
    }
}

//! The plane polygon, convex or not.

use super::triangle::Shear;
use super::{Flaw, Primitive, Sight, Tables, check_direction, check_point, unplaced};
use crate::bounds::Bounds;
use crate::place::Placement;
use crate::scalar::{Number, Real, Scalar, Vector};
use crate::span::Span;

/// A polygon of consecutive points of the scene, seen from both sides. It may be concave;
/// where it crosses itself, the even-odd rule decides what is inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polygon<S: Scalar> {
    /// The index of the first vertex.
    pub first: u32,
    /// How many vertices follow, at least three.
    pub count: u32,
    /// The normal of the counterclockwise side, of unit length: [`Polygon::newell`].
    pub normal: S::Dir,
}

impl<S: Scalar> Polygon<S> {
    /// The unit normal of the plane through these vertices; zero where they span no area.
    ///
    /// Source: M. E. Newell's method, in Sutherland, Sproull and Schumacker (1974).
    pub fn newell(vertices: &[S::Vec3]) -> S::Dir {
        let Some((&first, &last)) = vertices.first().zip(vertices.last()) else {
            return S::Dir::ZERO;
        };
        let first = S::widen_vec(first);
        let mut previous = S::widen_vec(last) - first;
        let mut normal = S::WideVec::ZERO;
        for &vertex in vertices {
            let current = S::widen_vec(vertex) - first;
            normal += previous.cross(current);
            previous = current;
        }
        S::unit(normal)
    }

    fn vertices<'a>(&self, tables: &Tables<'a, S>) -> &'a [S::Vec3] {
        let first = self.first as usize;
        tables.points.get(first..first.saturating_add(self.count as usize)).unwrap_or(&[])
    }
}

impl<S: Scalar> Primitive<S> for Polygon<S> {
    fn centre(&self) -> S::Vec3 {
        S::Vec3::ZERO
    }

    fn check(&self, placed: bool, tables: &Tables<'_, S>) -> Result<(), Flaw> {
        unplaced(placed, "vertices")?;
        if self.count < 3 {
            return Err(Flaw::Empty("vertices"));
        }
        let vertices = self.vertices(tables);
        let Some(&first) = vertices.first() else {
            return Err(Flaw::Index("vertices"));
        };
        for &vertex in vertices {
            check_point::<S>(vertex, "vertices")?;
        }
        check_direction::<S>(self.normal, "normal")?;
        let newell = Self::newell(vertices);
        if newell == S::Dir::ZERO {
            return Err(Flaw::Empty("vertices"));
        }
        let (newell, share) = (S::widen_dir(newell), S::Wide::from_ratio(1, 1000));
        let agrees = (newell - S::widen_dir(self.normal)).max_abs() <= share;
        if !agrees {
            return Err(Flaw::NotPlanar("normal"));
        }
        let (mut size, mut off) = (S::Wide::ZERO, S::Wide::ZERO);
        for &vertex in vertices {
            let from = S::widen_vec(vertex) - S::widen_vec(first);
            size = size.max(from.max_abs());
            off = off.max(from.dot(newell).abs());
        }
        if off <= size * share { Ok(()) } else { Err(Flaw::NotPlanar("vertices")) }
    }

    fn bounds(&self, _: Option<&Placement<S>>, tables: &Tables<'_, S>) -> Bounds<S> {
        Bounds::around(self.vertices(tables))
    }

    /// The plane gives t, between the depths of the vertices; edges that cross a half-line in
    /// the space of the ray give inside or outside. Each point of an edge that two polygons
    /// share belongs to one of them.
    #[inline]
    fn spans(&self, sight: &Sight<'_, S>, mut emit: impl FnMut(Span<S>)) {
        let (line, vertices) = (sight.line, self.vertices(sight.tables));
        let (Some(&first), Some(&last)) = (vertices.first(), vertices.last()) else {
            return;
        };
        if sight.start.is_some() {
            return;
        }
        let shear = Shear::new(line);
        let (zero, origin) = (S::Wide::ZERO, S::widen_vec(line.origin));
        let (mut inside, mut near, mut far) = (false, S::Wide::FAR, -S::Wide::FAR);
        let [mut px, mut py, _] = shear.across(S::widen_vec(last), origin);
        for &vertex in vertices {
            let [qx, qy, depth] = shear.across(S::widen_vec(vertex), origin);
            (near, far) = (near.min(depth), far.max(depth));
            let upward = qy > zero;
            if (py > zero) != upward {
                let side = S::det2(px, qy, qx, py);
                inside ^= if upward { side > zero } else { side < zero };
            }
            [px, py] = [qx, qy];
        }
        if inside {
            let normal = S::widen_dir(self.normal);
            let speed = normal.dot(line.heading());
            let t = (S::widen_vec(first) - origin).dot(normal) / speed;
            let t = if speed == zero { near } else { t.clamp(near, far) };
            emit(Span::touch(S::narrow(t)));
        }
    }

    fn snap(&self, local: S::WideVec, _: u32, _: &Tables<'_, S>) -> S::Vec3 {
        S::narrow_vec(local)
    }

    fn normal(&self, _: S::Vec3, _: u32, _: &Tables<'_, S>) -> S::WideVec {
        S::widen_dir(self.normal)
    }

    /// Distances from the first vertex along two axes in the plane.
    fn uv(&self, local: S::Vec3, _: u32, tables: &Tables<'_, S>) -> [S; 2] {
        let (u, v) = S::widen_dir(self.normal).basis();
        let first = self.vertices(tables).first().copied().unwrap_or_default();
        let from = S::widen_vec(local) - S::widen_vec(first);
        [u, v].map(|axis| S::narrow(from.dot(axis)))
    }
}

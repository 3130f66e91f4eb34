//! The plane polygon, convex or not.

use super::triangle::Shear;
use super::{Flaw, Primitive, Sight, check_point, unplaced};
use crate::bounds::Bounds;
use crate::place::Placement;
use crate::scalar::{Scalar, Vector};
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
    pub normal: S::Vec3,
}

impl<S: Scalar> Polygon<S> {
    /// The unit normal of the plane through these vertices; zero where they span no area.
    ///
    /// Source: M. E. Newell's method, in Sutherland, Sproull and Schumacker (1974).
    pub fn newell(vertices: &[S::Vec3]) -> S::Vec3 {
        let Some((&first, &last)) = vertices.first().zip(vertices.last()) else {
            return S::Vec3::ZERO;
        };
        let mut previous = last - first;
        let mut normal = S::Vec3::ZERO;
        for &vertex in vertices {
            let current = vertex - first;
            normal += previous.cross(current);
            previous = current;
        }
        normal.normalize()
    }

    fn vertices<'a>(&self, points: &'a [S::Vec3]) -> &'a [S::Vec3] {
        let first = self.first as usize;
        points.get(first..first.saturating_add(self.count as usize)).unwrap_or(&[])
    }
}

impl<S: Scalar> Primitive<S> for Polygon<S> {
    const OPEN: bool = true;
    const SPANS_MAX: u16 = 1;

    fn centre(&self) -> S::Vec3 {
        S::Vec3::ZERO
    }

    fn check(&self, placed: bool, points: &[S::Vec3]) -> Result<(), Flaw> {
        unplaced(placed, "vertices")?;
        if self.count < 3 {
            return Err(Flaw::Empty("vertices"));
        }
        let vertices = self.vertices(points);
        let Some(&first) = vertices.first() else {
            return Err(Flaw::Index("vertices"));
        };
        for &vertex in vertices {
            check_point::<S>(vertex, "vertices")?;
        }
        check_point::<S>(self.normal, "normal")?;
        let newell = Self::newell(vertices);
        if newell == S::Vec3::ZERO {
            return Err(Flaw::Empty("vertices"));
        }
        let agrees = (newell - self.normal).max_abs() <= S::from_ratio(1, 1000);
        if !agrees {
            return Err(Flaw::NotPlanar("normal"));
        }
        let size = vertices.iter().fold(S::ZERO, |size, &v| size.max((v - first).max_abs()));
        let off = vertices.iter().fold(S::ZERO, |off, &v| off.max((v - first).dot(newell).abs()));
        if off <= size * S::from_ratio(1, 1000) { Ok(()) } else { Err(Flaw::NotPlanar("vertices")) }
    }

    fn bounds(&self, _: Option<&Placement<S>>, points: &[S::Vec3]) -> Bounds<S> {
        Bounds::around(self.vertices(points))
    }

    /// The plane gives t, between the depths of the vertices; edges that cross a half-line in
    /// the space of the ray give inside or outside. Each point of an edge that two polygons
    /// share belongs to one of them.
    #[inline]
    fn spans(&self, sight: &Sight<'_, S>, mut emit: impl FnMut(Span<S>)) {
        let (line, vertices) = (sight.line, self.vertices(sight.points));
        let (Some(&first), Some(&last)) = (vertices.first(), vertices.last()) else {
            return;
        };
        if sight.start.is_some() {
            return;
        }
        let shear = Shear::new(line);
        let (mut inside, mut near, mut far) = (false, S::FAR, -S::FAR);
        let [mut px, mut py, _] = shear.across(last, line.origin);
        for &vertex in vertices {
            let [qx, qy, depth] = shear.across(vertex, line.origin);
            (near, far) = (near.min(depth), far.max(depth));
            let upward = qy > S::ZERO;
            if (py > S::ZERO) != upward {
                let side = S::det2(px, qy, qx, py);
                inside ^= if upward { side > S::ZERO } else { side < S::ZERO };
            }
            [px, py] = [qx, qy];
        }
        if inside {
            let speed = self.normal.dot(line.dir);
            let t = (first - line.origin).dot(self.normal) / speed;
            emit(Span::touch(if speed == S::ZERO { near } else { t.clamp(near, far) }));
        }
    }

    fn snap(&self, local: S::Vec3, _: u16) -> S::Vec3 {
        local
    }

    fn normal(&self, _: S::Vec3, _: u16, _: &[S::Vec3]) -> S::Vec3 {
        self.normal
    }

    /// Distances from the first vertex along two axes in the plane.
    fn uv(&self, local: S::Vec3, _: u16, points: &[S::Vec3]) -> [S; 2] {
        let (u, v) = self.normal.basis();
        let from = self.vertices(points).first().map_or(local, |&first| local - first);
        [from.dot(u), from.dot(v)]
    }
}

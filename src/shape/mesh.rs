//! The mesh: triangles by the thousand, open or closed, under a hierarchy of boxes.

mod arrange;
mod batch;
mod check;
mod course;
#[cfg(test)]
mod twin;
mod view;

use super::triangle::{normal, shares};
use super::{Flaw, Primitive, Sight, Tables};
use crate::bounds::Bounds;
use crate::hierarchy::{Branch, branches_of};
use crate::place::Placement;
use crate::scalar::{Number, Real, Scalar, Vector};
use crate::span::{End, Passage, Span};
use course::Course;

/// Triangles that share their vertices, with a hierarchy of boxes over them.
///
/// An open mesh is a surface that is seen from both sides. A closed one is a solid: the ray is
/// inside where it has met an odd number of triangles. Faces are the triangles in the order of the
/// table.
///
/// The hit on each triangle is that of [`Triangle`](super::Triangle), and which one a point of a
/// shared edge belongs to is decided in the same way, so a ray meets a closed mesh an even number of times
/// whatever is rounded. A ray from outside the box of the mesh is first moved along itself to the
/// middle of it, so the errors do not depend on how far away it starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mesh {
    /// Where its triangles begin in the scene's indices: one record for each, of three points; if `smooth`
    /// three points more, that hold shading normals; if `mapped` the places of the first of two numbers
    /// each, that are texture coordinates.
    pub first: u32,
    /// How many triangles.
    pub triangles: u32,
    /// Where the order of the triangles in the hierarchy begins in the scene's indices, one index for each.
    pub order: u32,
    /// Where the hierarchy begins in the scene's branches: [`Mesh::branches`] of them. It is built by
    /// [`Mesh::arrange`].
    pub branch: u32,
    /// It has an inside. Every edge must be one of exactly two triangles, which go along it in opposite
    /// directions, and the triangles must run counterclockwise as seen from outside.
    pub closed: bool,
    /// Its corners have shading normals.
    pub smooth: bool,
    /// Its corners have texture coordinates.
    pub mapped: bool,
}

impl Mesh {
    /// The nodes of the hierarchy over so many triangles.
    pub const fn branches(triangles: u32) -> u32 {
        branches_of(triangles)
    }

    /// How many indices belong to a triangle.
    pub(crate) const fn stride(&self) -> u32 {
        3 * (1 + self.smooth as u32 + self.mapped as u32)
    }

    /// A part of the record of a triangle: three points, normals, or texture coordinates.
    #[inline]
    fn part(&self, face: u32, part: u32, indices: &[u32]) -> Option<[u32; 3]> {
        let record = (face as usize).checked_mul(self.stride() as usize)?;
        let at = record.checked_add(self.first as usize + 3 * part as usize)?;
        indices.get(at..)?.first_chunk().copied()
    }

    /// A triangle by its place in the hierarchy.
    #[inline]
    fn face(&self, entry: u32, indices: &[u32]) -> Option<u32> {
        let at = (self.order as usize).checked_add(entry as usize)?;
        indices.get(at).copied()
    }

    #[inline]
    fn corners<S: Scalar>(&self, face: u32, tables: &Tables<'_, S>) -> Option<[S::Vec3; 3]> {
        points::<S>(self.part(face, 0, tables.indices)?, tables.points)
    }

    fn wide_corners<S: Scalar>(
        &self,
        face: u32,
        tables: &Tables<'_, S>,
    ) -> Option<[S::WideVec; 3]> {
        self.corners(face, tables).map(|corners| corners.map(S::widen_vec))
    }

    fn normals<S: Scalar>(&self, face: u32, tables: &Tables<'_, S>) -> Option<[S::Vec3; 3]> {
        let part = self.smooth.then_some(1)?;
        points::<S>(self.part(face, part, tables.indices)?, tables.points)
    }

    /// The texture coordinates of the corners.
    fn coordinates<S: Scalar>(&self, face: u32, tables: &Tables<'_, S>) -> Option<[[S; 2]; 3]> {
        let part = if self.smooth { 2 } else { 1 };
        let part = self.mapped.then_some(part)?;
        let [a, b, c] = self.part(face, part, tables.indices)?.map(|at| {
            let numbers = tables.numbers.get(at as usize..);
            numbers.and_then(|numbers| numbers.first_chunk().copied())
        });
        Some([a?, b?, c?])
    }

    /// The hierarchy; empty if it is not all there.
    #[inline]
    fn hierarchy<'a, S: Scalar>(&self, tables: &Tables<'a, S>) -> &'a [Branch<S>] {
        let (first, count) = (self.branch as usize, branches_of(self.triangles) as usize);
        let rest = tables.branches.get(first..).unwrap_or(&[]);
        rest.get(..count).unwrap_or(&[])
    }
}

/// Three points by their indices.
#[inline]
fn points<S: Scalar>(indices: [u32; 3], points: &[S::Vec3]) -> Option<[S::Vec3; 3]> {
    let [a, b, c] = indices.map(|index| points.get(index as usize).copied());
    Some([a?, b?, c?])
}

/// More than rounding can move a vertex across a ray, or a ray beside a box, for a mesh whose
/// coordinates are of this magnitude.
///
/// The ray starts at most 2.8 half widths from any vertex, in each coordinate. The shear moves a vertex by less than 6 roundings of
/// that, the depth where a triangle is met is off by less than 6 more, the ends of a slab by 3, and
/// the place of the ray by one of the coordinates themselves; a start is moved into its face by at
/// most 16. All in all that is less than 60.
fn margin<S: Scalar>(magnitude: S) -> S {
    S::narrow(S::rounding(magnitude.widen()) * S::Wide::from_i32(64))
}

/// The box around three corners, widened on all sides.
fn widened<S: Scalar>([a, b, c]: [S::Vec3; 3], margin: S) -> Bounds<S> {
    let margin = S::Vec3::splat(margin);
    let min = a.zip(b, S::min).zip(c, S::min);
    let max = a.zip(b, S::max).zip(c, S::max);
    Bounds { min: min - margin, max: max + margin }
}

impl<S: Scalar> Primitive<S> for Mesh {
    fn centre(&self) -> S::Vec3 {
        S::Vec3::ZERO
    }

    fn check(&self, placed: bool, tables: &Tables<'_, S>) -> Result<(), Flaw> {
        check::check(self, placed, tables)
    }

    fn bounds(&self, _: Option<&Placement<S>>, tables: &Tables<'_, S>) -> Bounds<S> {
        self.hierarchy(tables).first().map_or_else(Bounds::nothing, |root| root.bounds)
    }

    fn spans(&self, sight: &Sight<'_, S>, emit: impl FnMut(Span<S>)) {
        self.spans_within(sight, [-S::FAR, S::FAR], emit);
    }

    /// A walk through the hierarchy finds the next few boundaries, and then again the next, so a ray may meet
    /// any number of triangles.
    // Out of line: what it keeps on the stack is there for such solids only.
    #[inline(never)]
    fn spans_within(&self, sight: &Sight<'_, S>, window: [S; 2], emit: impl FnMut(Span<S>)) {
        if let Some(course) = Course::listing(self, sight) {
            course.spans(window, emit);
        }
    }

    // Out of line: what it keeps on the stack is there for such solids only.
    #[inline(never)]
    fn first(
        &self,
        sight: &Sight<'_, S>,
        window: [S; 2],
        _: bool,
    ) -> (bool, Option<(End<S>, Passage)>) {
        Course::searching(self, sight).map_or((false, None), |course| course.first(window))
    }

    /// A ray from far away meets a triangle where its t is rounded to, which may be beside the plane by more than the
    /// rounding of the coordinates, or beside an edge.
    fn snap(&self, local: S::WideVec, face: u32, tables: &Tables<'_, S>) -> S::Vec3 {
        let Some([a, b, c]) = self.wide_corners(face, tables) else {
            return S::narrow_vec(local);
        };
        let normal = normal([a, b, c]).normalize();
        let mut p = local - normal * (local - a).dot(normal);
        for [from, to] in [[a, b], [b, c], [c, a]] {
            let inward = normal.cross((to - from).normalize());
            let beside = (p - from).dot(inward);
            if beside < S::Wide::ZERO {
                p = p - inward * beside;
            }
        }
        S::narrow_vec(p)
    }

    fn normal(&self, _: S::Vec3, face: u32, tables: &Tables<'_, S>) -> S::WideVec {
        self.wide_corners(face, tables).map_or(S::WideVec::ZERO, normal)
    }

    /// That of the corners, by their shares, where the mesh has them.
    fn shading_normal(
        &self,
        local: S::Vec3,
        face: u32,
        tables: &Tables<'_, S>,
    ) -> Option<S::WideVec> {
        let [na, nb, nc] = self.normals(face, tables)?.map(S::widen_vec);
        let [a, b, c] = shares::<S>(self.wide_corners(face, tables)?, local);
        let normal = na * a + nb * b + nc * c;
        (normal != S::WideVec::ZERO).then_some(normal)
    }

    /// Those of the corners by their shares, where the mesh has them; else the shares of the second and the
    /// third corner.
    fn uv(&self, local: S::Vec3, face: u32, tables: &Tables<'_, S>) -> [S; 2] {
        let Some(corners) = self.wide_corners(face, tables) else {
            return [S::ZERO; 2];
        };
        let [a, b, c] = shares::<S>(corners, local);
        let Some([[ua, va], [ub, vb], [uc, vc]]) = self.coordinates(face, tables) else {
            return [b, c].map(S::narrow);
        };
        let mix = |x: S, y: S, z: S| S::narrow(x.widen() * a + y.widen() * b + z.widen() * c);
        [mix(ua, ub, uc), mix(va, vb, vc)]
    }
}

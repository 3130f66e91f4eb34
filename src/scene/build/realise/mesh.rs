//! A mesh: its triangles into the tables, and a hierarchy over them.

use super::super::{Corners, SceneBuilder, Storage, Store, Triangles, add};
use crate::error::{Item, SceneError};
use crate::hierarchy::Branch;
use crate::place::{Affine, Rows, apply_transposed};
use crate::scalar::{Number, Scalar, Vector};
use crate::shape::{Mesh, Shape};

/// Where a shape goes: the map, the inverse of its linear part, and the node that it becomes.
#[derive(Clone, Copy)]
pub(super) struct Site<'a, S: Scalar> {
    pub(super) to_world: &'a Affine<S>,
    pub(super) inverse: &'a Rows<S>,
    pub(super) at: Item,
}

/// A part of the record of a triangle, from a list of the caller's; none without a list.
fn part<T>(
    corners: Option<Corners<'_, T>>,
    triangle: u32,
    flaw: SceneError,
) -> Result<Option<[u32; 3]>, SceneError> {
    let Some(Corners { values, triangles }) = corners else {
        return Ok(None);
    };
    let legal = |part: &&[u32; 3]| part.iter().all(|&index| (index as usize) < values.len());
    let part = triangles.get(triangle as usize).filter(legal).ok_or(flaw)?;
    Ok(Some(*part))
}

impl<S: Scalar, M: Storage> SceneBuilder<S, M> {
    pub(super) fn realise_mesh(
        &mut self,
        form: &Triangles<'_, S>,
        site: Site<'_, S>,
    ) -> Result<Shape<S>, SceneError> {
        let first = self.next_mesh(form.closed, form.normals.is_some(), form.uvs.is_some());
        let points = self.points.entries().len() as u32;
        for &point in form.points.values {
            self.mesh_point(point, site)?;
        }
        let normals = self.points.entries().len() as u32;
        for &normal in form.normals.map_or(&[][..], |normals| normals.values) {
            self.mesh_normal(normal, site)?;
        }
        let uvs = self.numbers.entries().len() as u32;
        for &number in form.uvs.map_or(&[][..], |uvs| uvs.values).as_flattened() {
            add(&mut self.numbers, "numbers", number)?;
        }
        for triangle in 0..form.points.triangles.len() as u32 {
            let missing = |flaw| SceneError::Triangle { at: site.at, triangle, flaw };
            let corners =
                part(Some(form.points), triangle, missing("names a point that is not there"))?;
            let flaw = missing("names a normal that is not there");
            let normal = part(form.normals, triangle, flaw)?;
            let flaw = missing("names texture coordinates that are not there");
            let uv = part(form.uvs, triangle, flaw)?;
            let record = [
                corners.map(|part| part.map(|index| points + index)),
                normal.map(|part| part.map(|index| normals + index)),
                uv.map(|part| part.map(|index| uvs + 2 * index)),
            ];
            self.mesh_triangle(record, site)?;
        }
        self.mesh(first)
    }

    /// A mesh without triangles at the end of the tables.
    pub(super) fn next_mesh(&self, closed: bool, smooth: bool, mapped: bool) -> Mesh {
        let first = self.indices.entries().len() as u32;
        let branch = self.branches.entries().len() as u32;
        Mesh { first, triangles: 0, order: first, branch, closed, smooth, mapped }
    }

    pub(super) fn mesh_point(
        &mut self,
        point: S::Vec3,
        site: Site<'_, S>,
    ) -> Result<u32, SceneError> {
        add(&mut self.points, "points", site.to_world.point(point))
    }

    pub(super) fn mesh_normal(
        &mut self,
        normal: S::Vec3,
        site: Site<'_, S>,
    ) -> Result<u32, SceneError> {
        let normal = apply_transposed::<S>(site.inverse, S::widen_vec(normal)).normalize();
        add(&mut self.points, "points", S::narrow_vec(normal))
    }

    /// Adds the record of a triangle, which a mirror turns round.
    pub(super) fn mesh_triangle(
        &mut self,
        record: [Option<[u32; 3]>; 3],
        site: Site<'_, S>,
    ) -> Result<(), SceneError> {
        let mirrored = site.to_world.determinant() < S::Wide::ZERO;
        for [a, b, c] in record.into_iter().flatten() {
            for index in if mirrored { [a, c, b] } else { [a, b, c] } {
                add(&mut self.indices, "indices", index)?;
            }
        }
        Ok(())
    }

    /// The mesh of all records since it was begun.
    pub(super) fn mesh(&mut self, begun: Mesh) -> Result<Shape<S>, SceneError> {
        let records = self.indices.entries().len() as u32 - begun.first;
        let triangles = records.checked_div(begun.stride()).unwrap_or(0);
        let mesh = Mesh { triangles, order: begun.first + records, ..begun };
        for face in 0..triangles {
            add(&mut self.indices, "indices", face)?;
        }
        for _ in 0..Mesh::branches(mesh.triangles) {
            add(&mut self.branches, "branches", Branch::vacant())?;
        }
        let (points, indices) = (self.points.entries(), self.indices.entries_mut());
        mesh.arrange::<S>(points, indices, self.branches.entries_mut());
        Ok(Shape::Mesh(mesh))
    }
}

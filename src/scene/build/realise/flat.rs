//! Triangles and polygons: their vertices into the table, where they stand in the scene.

use super::super::{SceneBuilder, Storage, Store, add};
use crate::error::SceneError;
use crate::place::{Affine, Rows, apply_transposed};
use crate::scalar::{Scalar, Vector};
use crate::shape::{Polygon, Shape, Triangle};

impl<S: Scalar, M: Storage> SceneBuilder<S, M> {
    pub(super) fn realise_triangle(
        &mut self,
        corners: [S::Vec3; 3],
        normals: Option<[S::Vec3; 3]>,
        to_world: &Affine<S>,
        inverse: &Rows<S>,
    ) -> Result<Shape<S>, SceneError> {
        let mut indices = [0; 3];
        for (index, corner) in indices.iter_mut().zip(corners) {
            *index = add(&mut self.points, "points", to_world.point(corner))?;
        }
        let first = self.points.entries().len() as u32;
        for normal in normals.iter().flatten() {
            let normal = apply_transposed::<S>(inverse, S::widen_vec(*normal)).normalize();
            add(&mut self.points, "points", S::narrow_vec(normal))?;
        }
        let normals = if normals.is_some() { first } else { Triangle::FLAT };
        Ok(Shape::Triangle(Triangle { corners: indices, normals }))
    }

    pub(super) fn realise_polygon(
        &mut self,
        vertices: &[S::Vec3],
        to_world: &Affine<S>,
    ) -> Result<Shape<S>, SceneError> {
        let first = self.points.entries().len() as u32;
        for &vertex in vertices {
            add(&mut self.points, "points", to_world.point(vertex))?;
        }
        let placed = self.points.entries().get(first as usize..).unwrap_or(&[]);
        let normal = Polygon::<S>::newell(placed);
        let count = placed.len() as u32;
        Ok(Shape::Polygon(Polygon { first, count, normal }))
    }
}

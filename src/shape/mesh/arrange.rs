//! Puts the triangles of a mesh into the order of its hierarchy.

use super::{Mesh, points, widened};
use crate::bounds::Bounds;
use crate::hierarchy::{Branch, Entries, branches_of, build};
use crate::scalar::{Number, Scalar, Vector};

/// The triangles of a mesh, in an order that can be changed.
struct Order<'a, S: Scalar> {
    mesh: Mesh,
    points: &'a [S::Vec3],
    indices: &'a mut [u32],
    margin: S,
}

impl<S: Scalar> Entries<S> for Order<'_, S> {
    fn bounds(&self, entry: u32) -> Bounds<S> {
        let face = self.mesh.face(entry, self.indices);
        let part = face.and_then(|face| self.mesh.part(face, 0, self.indices));
        let corners = part.and_then(|part| points::<S>(part, self.points));
        corners.map_or_else(Bounds::nothing, |corners| widened::<S>(corners, self.margin))
    }

    fn swap(&mut self, a: u32, b: u32) {
        let faces = [a, b].map(|entry| self.mesh.face(entry, self.indices));
        if let [Some(of_a), Some(of_b)] = faces {
            self.mesh.put(a, of_b, self.indices);
            self.mesh.put(b, of_a, self.indices);
        }
    }
}

impl Mesh {
    /// Builds the hierarchy of this mesh in its part of `branches`, and the order that it has them in, in
    /// its part of `indices`. A closed mesh whose triangles run clockwise as seen from outside is turned round.
    ///
    /// The tables are those of the scene to be. A table that is not long enough, or an index that
    /// is beyond the points, leaves a mesh that the scene refuses.
    ///
    /// The time grows as n·log n. Nothing is allocated, so a mesh of a `static` scene can be arranged
    /// on the target before the scene is made, or beforehand on a host.
    pub fn arrange<S: Scalar>(
        &self,
        points: &[S::Vec3],
        indices: &mut [u32],
        branches: &mut [Branch<S>],
    ) {
        for face in 0..self.triangles {
            self.put(face, face, indices);
        }
        let (first, count) = (self.branch as usize, branches_of(self.triangles) as usize);
        let rest = branches.get_mut(first..).unwrap_or(&mut []);
        let margin = self.margin::<S>(points, indices);
        let mut order = Order { mesh: *self, points, indices, margin };
        build(&mut order, self.triangles, rest.get_mut(..count).unwrap_or(&mut []));
        if self.closed && self.volume::<S>(points, indices) < S::Wide::ZERO {
            self.turn(indices);
        }
    }

    /// Says which triangle stands at a place of the hierarchy.
    fn put(&self, entry: u32, face: u32, indices: &mut [u32]) {
        let at = (self.order as usize).saturating_add(entry as usize);
        if let Some(slot) = indices.get_mut(at) {
            *slot = face;
        }
    }

    /// How far the boxes of this mesh are widened.
    pub(super) fn margin<S: Scalar>(&self, points: &[S::Vec3], indices: &[u32]) -> S {
        let corners = (0..self.triangles)
            .filter_map(|face| super::points::<S>(self.part(face, 0, indices)?, points));
        let size = corners.flatten().fold(S::ZERO, |size, corner| size.max(corner.max_abs()));
        super::margin(size)
    }

    /// Six times the volume of a closed mesh, negative if its triangles run clockwise as seen from outside.
    pub(super) fn volume<S: Scalar>(&self, points: &[S::Vec3], indices: &[u32]) -> S::Wide {
        let mut from = None;
        let mut volume = S::Wide::ZERO;
        for face in 0..self.triangles {
            let part = self.part(face, 0, indices);
            let Some([a, b, c]) = part.and_then(|part| super::points::<S>(part, points)) else {
                continue;
            };
            let from = *from.get_or_insert(a);
            let [a, b, c] = [a, b, c].map(|corner| S::widen_vec(corner - from));
            volume += a.dot(b.cross(c));
        }
        volume
    }

    /// Turns all triangles round.
    fn turn(&self, indices: &mut [u32]) {
        let rest = indices.get_mut(self.first as usize..).unwrap_or(&mut []);
        let parts = (self.stride() / 3 * self.triangles) as usize;
        for part in rest.chunks_exact_mut(3).take(parts) {
            if let [_, b, c] = part {
                core::mem::swap(b, c);
            }
        }
    }
}

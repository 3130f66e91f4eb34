//! Patches and splines, as the tables hold them.

use crate::bounds::Bounds;
use crate::error::{Item, SceneError};
use crate::place::Affine;
use crate::scalar::{Real, Scalar, Vector};
use crate::scene::build::{SceneBuilder, Storage, Store, add};
use crate::shape::{Patches, Shape};

/// What a form becomes: the shape, and no placement, for the control points are moved themselves.
type Realised<S> = Result<(Shape<S>, Option<u16>), SceneError>;

/// One way through the net of a spline.
#[derive(Clone, Copy)]
struct Course {
    /// How many control points.
    points: u32,
    closed: bool,
}

impl Course {
    /// How many cubic pieces.
    fn pieces(self) -> u32 {
        if self.closed { self.points } else { self.points.saturating_sub(3) }
    }

    /// How many Bézier points, each piece's last being the next one's first.
    fn beziers(self) -> u32 {
        self.pieces() * 3 + u32::from(!self.closed)
    }

    fn is_legal(self) -> bool {
        self.points >= if self.closed { 3 } else { 4 }
    }

    /// The control points that a Bézier point is made of, with their weights in sixths.
    ///
    /// Source: W. Boehm, "Inserting New Knots into B-spline Curves" (1980), for equal intervals.
    fn parts(self, bezier: u32) -> [(u32, i32); 3] {
        let at = |step: u32| {
            let index = bezier / 3 + step;
            if self.closed && index >= self.points { index - self.points } else { index }
        };
        match bezier % 3 {
            0 => [(at(0), 1), (at(1), 4), (at(2), 1)],
            1 => [(at(1), 4), (at(2), 2), (at(2), 0)],
            _ => [(at(1), 2), (at(2), 4), (at(2), 0)],
        }
    }

    /// The index of a Bézier point among those that there are.
    fn bezier(self, piece: u32, step: u32) -> u32 {
        let index = piece * 3 + step;
        if self.closed && index == self.beziers() { 0 } else { index }
    }
}

impl<S: Scalar, M: Storage> SceneBuilder<S, M> {
    pub(super) fn realise_patches(
        &mut self,
        points: &[S::Vec3],
        patches: &[[u32; 16]],
        to_world: &Affine<S>,
    ) -> Realised<S> {
        let at = Item::Node(self.nodes.entries().len() as u32);
        let count = patches.len() as u32;
        self.check_count(count)?;
        let first_point = self.points.entries().len() as u32;
        for &point in points {
            add(&mut self.points, "points", to_world.point(point))?;
        }
        let (first, len) = (self.indices.entries().len() as u32, points.len() as u32);
        for &index in patches.iter().flatten() {
            if index >= len {
                return Err(SceneError::IndexOutOfRange { at, table: "points", index, len });
            }
            add(&mut self.indices, "indices", first_point + index)?;
        }
        self.finish_patches(first, count)
    }

    /// Bézier points are computed once each, so that neighbours share them to the bit.
    pub(super) fn realise_spline(
        &mut self,
        points: &[S::Vec3],
        columns: u32,
        [rows_closed, columns_closed]: [bool; 2],
        to_world: &Affine<S>,
    ) -> Realised<S> {
        let at = Item::Node(self.nodes.entries().len() as u32);
        let len = points.len() as u32;
        let along = Course { points: columns, closed: rows_closed };
        let across =
            Course { points: len.checked_div(columns).unwrap_or(0), closed: columns_closed };
        if !(along.is_legal() && across.is_legal() && along.points * across.points == len) {
            let allowed = "full rows, at least 4 of at least 4 points; 3 where the net is closed";
            return Err(SceneError::OutOfRange { at, field: "points", allowed });
        }
        let count = along.pieces().saturating_mul(across.pieces());
        self.check_count(count)?;
        let first_point = self.points.entries().len() as u32;
        let sixth = S::Wide::from_ratio(1, 36);
        for row in 0..across.beziers() {
            for column in 0..along.beziers() {
                let mut sum = S::WideVec::ZERO;
                for (row, weight) in across.parts(row) {
                    for (column, share) in along.parts(column) {
                        let point = points.get((row * columns + column) as usize);
                        let point = S::widen_vec(point.copied().unwrap_or_default());
                        sum += point * S::Wide::from_i32(weight * share);
                    }
                }
                let placed = S::narrow_vec(to_world.wide_point(sum * sixth));
                add(&mut self.points, "points", placed)?;
            }
        }
        let first = self.indices.entries().len() as u32;
        for patch_row in 0..across.pieces() {
            for patch_column in 0..along.pieces() {
                for step in 0..16 {
                    let row = across.bezier(patch_row, step / 4);
                    let column = along.bezier(patch_column, step % 4);
                    let index = first_point + row * along.beziers() + column;
                    add(&mut self.indices, "indices", index)?;
                }
            }
        }
        self.finish_patches(first, count)
    }

    fn check_count(&self, count: u32) -> Result<(), SceneError> {
        let at = Item::Node(self.nodes.entries().len() as u32);
        if count == 0 {
            return Err(SceneError::Empty { at, field: "patches" });
        }
        if count > u32::from(Patches::<S>::COUNT_MAX) {
            let allowed = "at most 1024";
            return Err(SceneError::OutOfRange { at, field: "patches", allowed });
        }
        Ok(())
    }

    /// The shape of so many patches whose indices begin at `first` and are the last of all.
    fn finish_patches(&mut self, first: u32, count: u32) -> Realised<S> {
        let boxes = self.points.entries().len() as u32;
        let mut all = Bounds::<S>::nothing();
        for patch in 0..count {
            let mut corners = [S::Vec3::ZERO; 16];
            let from = (first + patch * 16) as usize;
            let indices = self.indices.entries().get(from..).unwrap_or(&[]);
            for (corner, &index) in corners.iter_mut().zip(indices) {
                *corner = self.points.entries().get(index as usize).copied().unwrap_or_default();
            }
            let around = Bounds::around(&corners);
            all = all.union(&around);
            add(&mut self.points, "points", around.min)?;
            add(&mut self.points, "points", around.max)?;
        }
        let center = all.min * S::HALF + all.max * S::HALF;
        let shape = Patches { center, first, boxes, count: count as u16 };
        Ok((Shape::Patches(shape), None))
    }
}

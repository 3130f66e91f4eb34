//! A height field: it becomes a mesh of two triangles to a cell, closed by walls and a floor if it is a
//! solid.

use super::super::{Heights, SceneBuilder, Storage, Store};
use super::mesh::Site;
use crate::error::SceneError;
use crate::scalar::{Axis, Real, Scalar, Vector};
use crate::shape::Shape;

/// The grid of a height field.
struct Grid<'a, S: Scalar> {
    form: &'a Heights<'a, S>,
    columns: u32,
    rows: u32,
}

impl<S: Scalar> Grid<'_, S> {
    fn height(&self, column: u32, row: u32) -> S {
        let index = row as usize * self.columns as usize + column as usize;
        self.form.heights.get(index).copied().unwrap_or(S::ZERO)
    }

    fn point(&self, column: u32, row: u32) -> S::Vec3 {
        let ([x, z], [to_x, to_z]) = (self.form.min, self.form.max);
        let between = |from: S, to: S, index: u32, count: u32| {
            let share = S::Wide::from_ratio(index as i32, count as i32 - 1);
            S::narrow(from.widen() + (to - from).widen() * share)
        };
        let x = between(x, to_x, column, self.columns);
        S::Vec3::new(x, self.height(column, row), between(z, to_z, row, self.rows))
    }

    /// At right angles to the lines through the neighbours along both axes.
    fn normal(&self, column: u32, row: u32) -> S::Vec3 {
        let (left, right) = (column.saturating_sub(1), (column + 1).min(self.columns - 1));
        let (near, far) = (row.saturating_sub(1), (row + 1).min(self.rows - 1));
        let way = |from: S::Vec3, to: S::Vec3| S::widen_vec(to - from);
        let along_x = way(self.point(left, row), self.point(right, row));
        let along_z = way(self.point(column, near), self.point(column, far));
        S::narrow_vec(along_z.normalize().cross(along_x.normalize()).normalize())
    }

    /// How many points are on the edge.
    const fn around(&self) -> u32 {
        2 * (self.columns - 1) + 2 * (self.rows - 1)
    }

    /// The points of the edge, one after the other as the triangles beside it go along it, and
    /// which of the four sides begins there.
    fn edge(&self, index: u32) -> ([u32; 2], u32) {
        let (x, z) = (self.columns - 1, self.rows - 1);
        let index = if index == self.around() { 0 } else { index };
        if index < z {
            ([0, index], 0)
        } else if index < z + x {
            ([index - z, z], 1)
        } else if index < 2 * z + x {
            ([x, 2 * z + x - index], 2)
        } else {
            ([self.around() - index, 0], 3)
        }
    }
}

impl<S: Scalar, M: Storage> SceneBuilder<S, M> {
    pub(super) fn realise_heights(
        &mut self,
        form: &Heights<'_, S>,
        site: Site<'_, S>,
    ) -> Result<Shape<S>, SceneError> {
        let grid = grid(form, site)?;
        let mesh = self.next_mesh(form.base.is_some(), form.smooth, false);
        let points = self.points.entries().len() as u32;
        let all =
            || (0..grid.rows).flat_map(|row| (0..grid.columns).map(move |column| [column, row]));
        for [column, row] in all() {
            self.mesh_point(grid.point(column, row), site)?;
        }
        let normals = self.points.entries().len() as u32;
        for [column, row] in all().filter(|_| form.smooth) {
            self.mesh_normal(grid.normal(column, row), site)?;
        }
        let place = |[column, row]: [u32; 2]| row * grid.columns + column;
        for [column, row] in all().filter(|&[c, r]| c + 1 < grid.columns && r + 1 < grid.rows) {
            let [a, b, c, d] = [[0, 0], [0, 1], [1, 0], [1, 1]]
                .map(|[right, up]| place([column + right, row + up]));
            for corners in [[a, b, c], [c, b, d]] {
                let normal = form.smooth.then(|| corners.map(|index| normals + index));
                let corners = corners.map(|index| points + index);
                self.mesh_triangle([Some(corners), normal, None], site)?;
            }
        }
        if let Some(base) = form.base {
            self.walls(&grid, base, points, site)?;
        }
        self.mesh(mesh)
    }

    /// The walls under the edge of a height field, and the floor as a fan.
    fn walls(
        &mut self,
        grid: &Grid<'_, S>,
        base: S,
        points: u32,
        site: Site<'_, S>,
    ) -> Result<(), SceneError> {
        let lower = self.points.entries().len() as u32;
        for index in 0..grid.around() {
            let ([column, row], _) = grid.edge(index);
            self.mesh_point(grid.point(column, row).with(Axis::Y, base), site)?;
        }
        let ([x, z], [to_x, to_z]) = (grid.form.min, grid.form.max);
        let middle = S::Vec3::new((x + to_x) * S::HALF, base, (z + to_z) * S::HALF);
        let middle = self.mesh_point(middle, site)?;
        let normals = self.points.entries().len() as u32;
        if grid.form.smooth {
            let (x, y) = (S::Vec3::ZERO.with(Axis::X, S::ONE), S::Vec3::ZERO.with(Axis::Y, S::ONE));
            let z = S::Vec3::ZERO.with(Axis::Z, S::ONE);
            for normal in [-x, z, x, -z, -y] {
                self.mesh_normal(normal, site)?;
            }
        }
        for index in 0..grid.around() {
            let (from, side) = grid.edge(index);
            let (to, _) = grid.edge(index + 1);
            let [p, q] = [from, to].map(|[column, row]| points + row * grid.columns + column);
            let next = if index + 1 == grid.around() { 0 } else { index + 1 };
            let (below_p, below_q) = (lower + index, lower + next);
            let triangles = [
                ([q, p, below_p], side),
                ([q, below_p, below_q], side),
                ([below_q, below_p, middle], 4),
            ];
            for (corners, side) in triangles {
                let normal = grid.form.smooth.then_some([normals + side; 3]);
                self.mesh_triangle([Some(corners), normal, None], site)?;
            }
        }
        Ok(())
    }
}

/// The grid of a height field that is legal.
fn grid<'a, S: Scalar>(
    form: &'a Heights<'a, S>,
    site: Site<'_, S>,
) -> Result<Grid<'a, S>, SceneError> {
    let at = site.at;
    let refused = |field, allowed| Err(SceneError::OutOfRange { at, field, allowed });
    let len = form.heights.len() as u32;
    let rows = len.checked_div(form.columns).unwrap_or(0);
    let legal = 2..=1 << 15;
    if !legal.contains(&form.columns) || !legal.contains(&rows) || rows * form.columns != len {
        return refused(
            "heights",
            "rows of as many points as there are columns, from 2 to 32768 of both",
        );
    }
    for (from, to) in form.min.into_iter().zip(form.max) {
        if !(from.is_finite() && to.is_finite()) {
            return Err(SceneError::NotFinite { at, field: "max" });
        }
        if from == to {
            return Err(SceneError::Empty { at, field: "max" });
        }
        if to < from {
            return Err(SceneError::Inverted { at, field: "max" });
        }
    }
    if let Some(base) = form.base
        && !form.heights.iter().all(|&height| base < height)
    {
        return refused("base", "below all heights");
    }
    Ok(Grid { form, columns: form.columns, rows })
}

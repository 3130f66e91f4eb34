//! Bicubic Bézier patches, one or many that share borders.

mod borders;
mod hits;
mod locate;
mod net;
mod search;
#[cfg(test)]
mod tests;
mod view;

use super::{Flaw, Primitive, Sight, Tables, check_point, unplaced};
use crate::bounds::Bounds;
use crate::place::Placement;
use crate::scalar::{Number, Real, Scalar, Vector};
use crate::span::{End, Passage, Span};
use hits::{HITS_MAX, Hits};
use locate::Spot;
use net::Pair;

/// The logarithm of how many cells a face has along each parameter: within one, the way from its middle to any of
/// its points is short.
const CELL_BITS: u32 = 8;

/// Bicubic Bézier patches of the scene's points, an open surface seen from both sides; the normal is ∂/∂u × ∂/∂v.
///
/// Patches whose sides have equal control points share that side: no ray slips through between them, and none
/// meets both. A side may shrink to a point. A face is a patch and a cell of its parameters: one of 256 along each.
///
/// A patch is halved at most 104 times in a row, and a search looks at 4096 pieces of it at most; a thousand are the most
/// that rays along silhouettes and through degenerate points have needed, and a handful is common. Where the patch is seen
/// edge on, as far as can be told from rounding, it is not met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patches<S: Scalar> {
    /// Where the local coordinates have their origin: about the middle.
    pub center: S::Vec3,
    /// Where the scene's indices begin to name the control points: sixteen for each patch, four rows one after
    /// another along v of four along u.
    pub first: u32,
    /// Where the scene's points begin to hold the boxes around the patches: the least and the
    /// greatest coordinates of each.
    pub boxes: u32,
    /// How many patches, at least 1 and at most [`Patches::COUNT_MAX`].
    pub count: u16,
}

impl<S: Scalar> Patches<S> {
    /// The greatest number of patches in one shape.
    pub const COUNT_MAX: u16 = 1024;

    /// The greatest number of points of one bicubic patch on a ray.
    const POINTS_MAX: u16 = 18;

    /// The greatest number of hits on a ray.
    pub(super) const fn hits_max(&self) -> u16 {
        self.count.saturating_mul(Self::POINTS_MAX)
    }

    /// How often all patches are looked at, at most, until all hits are told.
    const fn passes(&self) -> u16 {
        self.hits_max() / HITS_MAX as u16 + 1
    }

    fn indices<'a>(&self, tables: &Tables<'a, S>, patch: u16) -> Option<&'a [u32]> {
        let first = (self.first as usize).checked_add(usize::from(patch) * 16)?;
        tables.indices.get(first..first.checked_add(16)?)
    }

    /// The greatest index of a control point.
    fn last_point(&self, tables: &Tables<'_, S>) -> u32 {
        let of_patch = |patch| self.indices(tables, patch).unwrap_or(&[]).iter();
        (0..self.count).flat_map(of_patch).fold(0, |last, &index| last.max(index))
    }

    /// The control points of a patch.
    fn control(&self, tables: &Tables<'_, S>, patch: u16) -> Option<[[S::Vec3; 4]; 4]> {
        let mut rows = [[S::Vec3::ZERO; 4]; 4];
        let indices = self.indices(tables, patch)?;
        for (point, &index) in rows.iter_mut().flatten().zip(indices) {
            *point = *tables.points.get(index as usize)?;
        }
        Some(rows)
    }

    /// The box around a patch; nothing for one that does not exist.
    fn patch_bounds(&self, tables: &Tables<'_, S>, patch: u16) -> Bounds<S> {
        let first = (self.boxes as usize).saturating_add(usize::from(patch) * 2);
        match tables.points.get(first..first.saturating_add(2)) {
            Some(&[min, max]) => Bounds { min, max },
            _ => Bounds::nothing(),
        }
    }

    /// The face of a point of a patch.
    fn face(patch: u16, at: Pair<S::Wide>) -> u32 {
        let mut face = u32::from(patch);
        for mut x in at {
            // The binary digits of the parameter, one by one; 1 is in the last cell.
            for _ in 0..CELL_BITS {
                x *= S::Wide::TWO;
                let digit = x >= S::Wide::ONE;
                face = face << 1 | u32::from(digit);
                if digit {
                    x -= S::Wide::ONE;
                }
            }
        }
        face
    }

    /// The patch that a face belongs to.
    pub const fn patch(face: u32) -> u16 {
        (face >> (2 * CELL_BITS)) as u16
    }

    /// The patch of a face, and the middle of its cell.
    fn cell(face: u32) -> (u16, Pair<S::Wide>) {
        let middle = |cell: u32| {
            let cell = (cell & ((1 << CELL_BITS) - 1)) as i32;
            S::Wide::from_ratio(2 * cell + 1, 2 << CELL_BITS)
        };
        (Self::patch(face), [middle(face >> CELL_BITS), middle(face)])
    }

    /// The point of a face nearest to a local point close to it.
    fn place(&self, local: S::WideVec, face: u32, tables: &Tables<'_, S>) -> Spot<S> {
        let (patch, guess) = Self::cell(face);
        self.nearest(tables, patch, local, guess)
    }

    fn check_patch(&self, tables: &Tables<'_, S>, patch: u16) -> Result<(), Flaw> {
        let rows = self.control(tables, patch).ok_or(Flaw::Index("points"))?;
        let bounds = self.patch_bounds(tables, patch);
        for &point in rows.iter().flatten() {
            check_point::<S>(point, "points")?;
        }
        check_point::<S>(bounds.min, "boxes")?;
        check_point::<S>(bounds.max, "boxes")?;
        if !rows.iter().flatten().all(|&point| bounds.contains(point)) {
            return Err(Flaw::OutOfRange("boxes", "around the control points of their patch"));
        }
        let extent = bounds.max - bounds.min;
        if extent.max_abs() < S::LENGTH_MIN || self.is_flat(tables, patch) {
            return Err(Flaw::Empty("points"));
        }
        Ok(())
    }
}

impl<S: Scalar> Primitive<S> for Patches<S> {
    fn centre(&self) -> S::Vec3 {
        self.center
    }

    fn check(&self, placed: bool, tables: &Tables<'_, S>) -> Result<(), Flaw> {
        unplaced(placed, "points")?;
        if self.count == 0 {
            return Err(Flaw::Empty("patches"));
        }
        if self.count > Self::COUNT_MAX {
            return Err(Flaw::OutOfRange("patches", "at most 1024"));
        }
        let entries = |len: usize| len as u32;
        let last_index = self.first.saturating_add(u32::from(self.count) * 16 - 1);
        if self.indices(tables, self.count - 1).is_none() {
            let len = entries(tables.indices.len());
            return Err(Flaw::Beyond { table: "indices", index: last_index, len });
        }
        let last_corner = self.boxes.saturating_add(u32::from(self.count) * 2 - 1);
        for index in [last_corner, self.last_point(tables)] {
            if tables.points.get(index as usize).is_none() {
                let len = entries(tables.points.len());
                return Err(Flaw::Beyond { table: "points", index, len });
            }
        }
        (0..self.count).try_for_each(|patch| self.check_patch(tables, patch))?;
        check_point::<S>(self.center, "center")
    }

    fn bounds(&self, _: Option<&Placement<S>>, tables: &Tables<'_, S>) -> Bounds<S> {
        (0..self.count)
            .fold(Bounds::nothing(), |all, patch| all.union(&self.patch_bounds(tables, patch)))
    }

    #[inline]
    fn spans(&self, sight: &Sight<'_, S>, emit: impl FnMut(Span<S>)) {
        self.spans_until(sight, S::FAR, emit);
    }

    /// Each patch whose box the ray meets is searched by subdivision. So many hits as there is
    /// room for come in one pass; another pass goes on after the last of them.
    // Out of line: what it keeps on the stack is there for such solids only.
    #[inline(never)]
    fn spans_until(&self, sight: &Sight<'_, S>, until: S, mut emit: impl FnMut(Span<S>)) {
        let mut last = None;
        for _ in 0..self.passes() {
            let mut hits = Hits::new(last);
            self.collect(sight, [S::FAR, until], &mut hits);
            for hit in hits.iter() {
                let end = End { t: hit.t, face: Self::face(hit.patch, hit.at) };
                emit(Span { enter: end, exit: end });
                last = Some(*hit);
            }
            if !hits.more || last.is_some_and(|last| until < last.t) {
                break;
            }
        }
    }

    /// The same passes, but what lies beyond the first hit that is wanted is left out.
    // Out of line: what it keeps on the stack is there for such solids only.
    #[inline(never)]
    fn first(
        &self,
        sight: &Sight<'_, S>,
        [after, before]: [S; 2],
        _: bool,
    ) -> (bool, Option<(End<S>, Passage)>) {
        let mut last = None;
        for _ in 0..self.passes() {
            let mut hits = Hits::new(last);
            self.collect(sight, [after, before], &mut hits);
            if let Some(hit) = hits.first(after).filter(|hit| hit.t < before) {
                let end = End { t: hit.t, face: Self::face(hit.patch, hit.at) };
                return (false, Some((end, Passage::Touch)));
            }
            last = hits.iter().last().copied();
            if !hits.more || last.is_some_and(|last| before < last.t) {
                break;
            }
        }
        (false, None)
    }

    fn snap(&self, local: S::WideVec, face: u32, tables: &Tables<'_, S>) -> S::Vec3 {
        S::narrow_vec(self.place(local, face, tables).point)
    }

    fn normal(&self, local: S::Vec3, face: u32, tables: &Tables<'_, S>) -> S::WideVec {
        let Spot { patch, at, .. } = self.place(S::widen_vec(local), face, tables);
        self.normal_at(tables, patch, at)
    }

    /// The parameters on the patch, both in 0..=1.
    fn uv(&self, local: S::Vec3, face: u32, tables: &Tables<'_, S>) -> [S; 2] {
        self.place(S::widen_vec(local), face, tables).at.map(S::narrow)
    }
}

//! A pixel in quarters, and these in quarters again where it matters.

use super::Sample;
use crate::chance::hash;
use crate::scalar::{Number, Real, Scalar, Vector};

/// How often a pixel may be divided.
pub(super) const LEVELS_MAX: usize = 4;

/// A cell in which a quarter counts for four times as much as in the one around it.
const CONTRAST_GROWTH: u32 = 3;

/// Four quarters of a cell.
#[derive(Clone, Copy, Debug)]
struct Cell<S: Scalar> {
    /// The column and row of the cell among those of its size.
    at: [u8; 2],
    samples: [Sample<S>; 4],
    /// How many samples there are.
    have: u8,
    /// How many quarters are summed up.
    done: u8,
    light: S::WideVec,
    spent: S::Wide,
}

/// The division of a pixel: the cells on the way to the one that is looked at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Quarters<S: Scalar> {
    /// How often a pixel is divided at most.
    levels: u8,
    depth: u8,
    /// Of the pixel; decides where a cell has its sample.
    key: u32,
    /// Above what contrast, in steps of 2⁻³², the pixel is divided.
    limit: u32,
    probe: Option<Sample<S>>,
    corners: [Sample<S>; 4],
    cells: [Cell<S>; LEVELS_MAX],
}

impl<S: Scalar> Quarters<S> {
    pub(super) fn new(levels: u8, limit: u32) -> Self {
        let vacant = Sample::VACANT;
        let cell = Cell {
            at: [0; 2],
            samples: [vacant; 4],
            have: 0,
            done: 0,
            light: S::WideVec::ZERO,
            spent: S::Wide::ZERO,
        };
        let (corners, cells) = ([vacant; 4], [cell; LEVELS_MAX]);
        Self { levels, depth: 0, key: 0, limit, probe: None, corners, cells }
    }

    /// The cell of the finest division in which the one sample of the whole pixel with a key lies.
    pub(super) fn probe_of(&self, key: u32) -> [u8; 2] {
        finest(key, self.levels, 0, [0; 2])
    }

    /// Begins with a pixel.
    pub(super) fn begin(&mut self, key: u32, corners: [Sample<S>; 4], probe: Option<Sample<S>>) {
        (self.key, self.corners, self.probe, self.depth) = (key, corners, probe, 0);
        self.divide([0; 2]);
    }

    fn divide(&mut self, at: [u8; 2]) {
        if let Some(cell) = self.cells.get_mut(usize::from(self.depth)) {
            (cell.at, cell.have, cell.done) = (at, 0, 0);
            (cell.light, cell.spent) = (S::WideVec::ZERO, S::Wide::ZERO);
            self.depth += 1;
        }
    }

    /// The cell of the finest division in which the next sample lies.
    pub(super) fn next(&self) -> [u8; 2] {
        let at = self.cell().map_or([0; 2], |cell| quarter(cell.at, cell.have));
        finest(self.key, self.levels, self.depth, at)
    }

    fn cell(&self) -> Option<&Cell<S>> {
        self.cells.get(usize::from(self.depth).wrapping_sub(1))
    }

    fn cell_mut(&mut self) -> Option<&mut Cell<S>> {
        self.cells.get_mut(usize::from(self.depth).wrapping_sub(1))
    }

    /// Takes the next sample.
    pub(super) fn take(&mut self, sample: Sample<S>) {
        if let Some(cell) = self.cell_mut() {
            if let Some(slot) = cell.samples.get_mut(usize::from(cell.have)) {
                *slot = sample;
            }
            cell.have += 1;
        }
    }

    /// Goes on to where the next sample is wanted; the light of the pixel and what was cut from it if
    /// none is. Each turn of the loop takes a sample over from the cell around, sums up a quarter,
    /// divides one or leaves a cell: a few for each level.
    pub(super) fn settle(&mut self) -> Option<(S::WideVec, S::Wide)> {
        loop {
            let Some(&cell) = self.cell() else {
                return Some((S::WideVec::ZERO, S::Wide::ZERO));
            };
            if cell.have < 4 {
                self.take(self.inherited(&cell)?);
            } else if let Some(sample) = cell.samples.get(usize::from(cell.done)) {
                if self.depth < self.levels && self.is_divided(&cell, sample) {
                    self.divide(quarter(cell.at, cell.done));
                } else {
                    self.sum(sample.light(), sample.spent.widen());
                }
            } else {
                let part = S::Wide::from_ratio(1, 4);
                let (light, spent) = (cell.light * part, cell.spent * part);
                self.depth -= 1;
                if self.depth == 0 {
                    return Some((light, spent));
                }
                self.sum(light, spent);
            }
        }
    }

    fn sum(&mut self, light: S::WideVec, spent: S::Wide) {
        if let Some(cell) = self.cell_mut() {
            cell.light += light;
            cell.spent += spent;
            cell.done += 1;
        }
    }

    /// The sample of the cell around, where it lies in the next quarter.
    fn inherited(&self, cell: &Cell<S>) -> Option<Sample<S>> {
        let around = finest(self.key, self.levels, self.depth - 1, cell.at);
        if around != self.next() {
            return None;
        }
        match usize::from(self.depth).checked_sub(2) {
            None => self.probe,
            Some(index) => {
                let cell = self.cells.get(index)?;
                cell.samples.get(usize::from(cell.done)).copied()
            }
        }
    }

    /// Whether the quarter with this sample is divided: it differs from the quarters beside it, or from the
    /// corner of the pixel that lies in it.
    fn is_divided(&self, cell: &Cell<S>, sample: &Sample<S>) -> bool {
        let mut limit = self.limit;
        for _ in 0..self.depth {
            limit = limit.saturating_mul(CONTRAST_GROWTH);
        }
        let at = usize::from(cell.done);
        let beside = [at ^ 1, at ^ 2].into_iter().filter_map(|other| cell.samples.get(other));
        let corner = self.corners.get(at).filter(|_| self.depth == 1);
        beside.chain(corner).any(|other| sample.contrast(other) > limit)
    }
}

/// A quarter of a cell, among the cells of its size.
fn quarter([x, y]: [u8; 2], index: u8) -> [u8; 2] {
    [x << 1 | index & 1, y << 1 | index >> 1]
}

/// The cell of the finest division in which the sample of a cell lies: the sample is also that of each
/// smaller cell around it.
fn finest(key: u32, levels: u8, level: u8, mut at: [u8; 2]) -> [u8; 2] {
    for level in level..levels {
        let [x, y] = at.map(u32::from);
        at = quarter(at, (hash(key, u32::from(level) << 16 | y << 8 | x) >> 30) as u8);
    }
    at
}

//! From coarse to fine: a picture that can be looked at long before it is finished.

use core::ops::Range;

use super::plan::{AnyOrder, Centre};
use super::{Pixel, Render, Step};
use crate::scalar::Scalar;
use crate::stats::Tally;

/// Every so manyth pixel of every so manyth row, and how large a block stands for each until finer ones
/// come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pass {
    /// The first column and row.
    pub first: [u8; 2],
    /// How far it is from one column and row to the next.
    pub step: [u8; 2],
    /// The width and height of a block.
    pub block: [u8; 2],
}

/// The seven passes of Adam7, which has each pixel once.
///
/// Source: *Portable Network Graphics (PNG) Specification*, section 8.2.
pub const PASSES: [Pass; 7] = [
    Pass { first: [0, 0], step: [8, 8], block: [8, 8] },
    Pass { first: [4, 0], step: [8, 8], block: [4, 8] },
    Pass { first: [0, 4], step: [4, 8], block: [4, 4] },
    Pass { first: [2, 0], step: [4, 4], block: [2, 4] },
    Pass { first: [0, 2], step: [2, 4], block: [2, 2] },
    Pass { first: [1, 0], step: [2, 2], block: [1, 2] },
    Pass { first: [0, 1], step: [1, 2], block: [1, 1] },
];

/// A part of a picture, for all of which its first pixel stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Block {
    /// The column of the pixel.
    pub x: u32,
    /// Its row.
    pub y: u32,
    /// The columns of the block, from that of the pixel.
    pub width: u32,
    /// Its rows.
    pub height: u32,
}

/// The pixels of a part of a picture from coarse to fine, each once, with the block for which it stands.
/// Blocks end where the picture does.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Interlace {
    columns: Range<u32>,
    rows: Range<u32>,
    pass: u8,
    x: u32,
    y: u32,
}

impl Interlace {
    /// The pixels of these columns and rows.
    pub const fn new(columns: Range<u32>, rows: Range<u32>) -> Self {
        // The first pass begins with the first pixel.
        let (x, y) = (columns.start, rows.start);
        Self { columns, rows, pass: 0, x, y }
    }

    fn first(&self, pass: &Pass) -> [u32; 2] {
        let [x, y] = pass.first.map(u32::from);
        [self.columns.start + x, self.rows.start + y]
    }
}

impl Iterator for Interlace {
    type Item = Block;

    fn next(&mut self) -> Option<Block> {
        // No pass has more than one turn without a pixel.
        loop {
            let pass = PASSES.get(usize::from(self.pass))?;
            let (x, y) = (self.x, self.y);
            if x < self.columns.end && y < self.rows.end {
                let ([across, along], [width, height]) =
                    (pass.step.map(u32::from), pass.block.map(u32::from));
                self.x = x + across;
                if self.x >= self.columns.end {
                    (self.x, self.y) = (self.first(pass)[0], y + along);
                }
                let width = width.min(self.columns.end - x);
                let height = height.min(self.rows.end - y);
                return Some(Block { x, y, width, height });
            }
            self.pass += 1;
            if let Some(next) = PASSES.get(usize::from(self.pass)) {
                [self.x, self.y] = self.first(next);
            }
        }
    }
}

/// A picture in the making, from coarse to fine: plain data that can be stored at any step and taken up
/// again, as a [`Render`] is. The pixels are the same.
#[derive(Clone, Debug)]
pub struct Preview<
    'a,
    S: Scalar,
    const RAYS: usize = 9,
    const BOUNDARIES: usize = 64,
    T: Tally = (),
    P: AnyOrder<S> = Centre,
> {
    render: Render<'a, S, RAYS, BOUNDARIES, T, P>,
    order: Interlace,
    /// The block of the pixel that is rendered, or was last.
    block: Option<Block>,
    /// The pixel is not finished.
    begun: bool,
}

impl<'a, S: Scalar, const RAYS: usize, const BOUNDARIES: usize, T: Tally, P: AnyOrder<S>>
    Preview<'a, S, RAYS, BOUNDARIES, T, P>
{
    pub(super) const fn new(
        render: Render<'a, S, RAYS, BOUNDARIES, T, P>,
        order: Interlace,
    ) -> Self {
        Self { render, order, block: None, begun: false }
    }

    /// Traces one ray with its shadow rays.
    pub fn step(&mut self) -> Step<S> {
        if !self.begun {
            let Some(block) = self.order.next() else {
                return Step::Done;
            };
            self.render.seek(block.x, block.y);
            (self.block, self.begun) = (Some(block), true);
        }
        let step = self.render.step();
        self.begun = step == Step::Traced;
        step
    }

    /// The block of the pixel that is rendered, or of the last one that was.
    pub const fn block(&self) -> Option<Block> {
        self.block
    }

    /// Who was told what happened.
    pub const fn tally(&self) -> &T {
        self.render.tally()
    }
}

/// The pixels from coarse to fine, each with its block.
impl<S: Scalar, const RAYS: usize, const BOUNDARIES: usize, T: Tally, P: AnyOrder<S>> Iterator
    for Preview<'_, S, RAYS, BOUNDARIES, T, P>
{
    type Item = (Pixel<S>, Block);

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            match self.step() {
                Step::Traced => {}
                Step::Pixel(pixel) => return self.block.map(|block| (pixel, block)),
                Step::Done => return None,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::vec;

    use super::*;

    /// Each pixel comes once, and after every pixel the picture so far has no hole.
    #[test]
    fn blocks_cover_the_picture_and_pixels_come_once() {
        for (width, height) in [(1, 1), (8, 8), (9, 17), (3, 20), (31, 2), (40, 23)] {
            let (left, top) = (5, 70);
            let mut seen = vec![0_u32; (width * height) as usize];
            let mut covered = vec![false; seen.len()];
            for block in Interlace::new(left..left + width, top..top + height) {
                seen[((block.y - top) * width + block.x - left) as usize] += 1;
                assert!(block.width > 0 && block.height > 0);
                for y in block.y..block.y + block.height {
                    for x in block.x..block.x + block.width {
                        covered[((y - top) * width + x - left) as usize] = true;
                    }
                }
                let first = width.div_ceil(8) * height.div_ceil(8);
                if seen.iter().sum::<u32>() >= first {
                    assert!(covered.iter().all(|covered| *covered), "{width}x{height}");
                }
            }
            assert!(seen.iter().all(|times| *times == 1), "{width}x{height}: {seen:?}");
        }
        assert_eq!(Interlace::new(3..3, 0..9).next(), None);
        assert_eq!(Interlace::new(0..9, 4..2).next(), None);
    }
}

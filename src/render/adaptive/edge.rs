//! A straight edge through a pixel: where it crosses the sides, and how much lies on either side of it.

use super::Sample;
use crate::scalar::Scalar;

/// What is known of a side of a pixel between two corners that see different things.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Crossing {
    /// Nothing yet.
    #[default]
    Unknown,
    /// It is crossed once, about so many steps of 2⁻¹⁶ from its first end: the middle of an interval
    /// whose length is a power of two.
    At(u16),
    /// It sees more than its two ends do.
    Several,
}

/// The sides of a pixel: above, left, right, below.
pub(super) const SIDES: [Side; 4] = [
    Side { ends: [0, 1], fixed: [None, Some(0)] },
    Side { ends: [0, 2], fixed: [Some(0), None] },
    Side { ends: [1, 3], fixed: [Some(1), None] },
    Side { ends: [2, 3], fixed: [None, Some(1)] },
];

/// A side of a pixel, between two of the corners above left, above right, below left and below right.
pub(super) struct Side {
    pub(super) ends: [u8; 2],
    /// The coordinate that all its points share.
    fixed: [Option<u32>; 2],
}

/// A whole side, in steps.
const WHOLE: u32 = 1 << 16;

impl Side {
    /// The place of a point of the side, in pixels and steps of them.
    pub(super) fn point(&self, along: u16) -> ([u32; 2], [u16; 2]) {
        let pixel = self.fixed.map(|fixed| fixed.unwrap_or(0));
        let part = self.fixed.map(|fixed| if fixed.is_none() { along } else { 0 });
        (pixel, part)
    }

    /// The same in steps alone.
    fn place(&self, along: u16) -> [i64; 2] {
        let (pixel, part) = self.point(along);
        [0, 1].map(|axis: usize| {
            let pixel = pixel.get(axis).copied().unwrap_or(0);
            let part = part.get(axis).copied().unwrap_or(0);
            i64::from(pixel * WHOLE) + i64::from(part)
        })
    }
}

/// A search for the place where a side is crossed, by halving.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Search {
    pub(super) side: u8,
    low: u32,
    high: u32,
    /// How often it is still halved.
    left: u8,
}

impl Search {
    pub(super) fn new(side: u8, halvings: u8) -> Self {
        Self { side, low: 0, high: WHOLE, left: halvings }
    }

    /// The middle of what is left, where the next sample lies.
    pub(super) fn middle(&self) -> u16 {
        ((self.low + self.high) / 2) as u16
    }

    /// Takes the sample in the middle: the search that goes on, or what it found.
    pub(super) fn narrow<S: Scalar>(
        mut self,
        sample: &Sample<S>,
        [first, last]: [&Sample<S>; 2],
        limit: u32,
    ) -> Result<Self, Crossing> {
        let middle = u32::from(self.middle());
        if sample.is_like(first, limit) {
            self.low = middle;
        } else if sample.is_like(last, limit) {
            self.high = middle;
        } else {
            return Err(Crossing::Several);
        }
        self.left = self.left.saturating_sub(1);
        if self.left > 0 { Ok(self) } else { Err(Crossing::At(self.middle())) }
    }
}

/// Which corners of a pixel see the same as the first, a bit for each, where all others see one
/// other thing and the two can be parted by a straight line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Split(u8);

impl Split {
    pub(super) fn of<S: Scalar>(corners: &[Sample<S>; 4], limit: u32) -> Option<Self> {
        let [first, rest @ ..] = corners;
        let other = rest.iter().find(|corner| corner.signature != first.signature)?;
        let mut mask = 0;
        for (index, corner) in (0_u8..).zip(corners) {
            if corner.is_like(first, limit) {
                mask |= 1 << index;
            } else if !corner.is_like(other, limit) {
                return None;
            }
        }
        // Two diagonals are parted by two lines.
        (mask != 0b1001).then_some(Self(mask))
    }

    /// A corner sees what the first does.
    pub(super) fn is_first(self, corner: u8) -> bool {
        self.0 >> corner & 1 == 1
    }

    /// The line crosses a side.
    pub(super) fn crosses(self, side: &Side) -> bool {
        let [a, b] = side.ends;
        self.is_first(a) != self.is_first(b)
    }

    /// The share of the pixel that sees what the first corner does, in steps of 2⁻¹⁶.
    pub(super) fn share(self, crossings: &[Crossing; 4]) -> u32 {
        let [above, left, right, below] = crossings.map(|crossing| match crossing {
            Crossing::At(along) => u32::from(along),
            _ => WHOLE / 2,
        });
        let corner = |a: u32, b: u32| ((u64::from(a) * u64::from(b)) >> 17) as u32;
        match self.0 {
            0b0011 => (left + right) / 2,
            0b0101 => (above + below) / 2,
            0b0001 => corner(above, left),
            // One other corner sees something else.
            0b1101 => WHOLE - corner(WHOLE - above, right),
            0b1011 => WHOLE - corner(WHOLE - left, below),
            _ => WHOLE - corner(WHOLE - right, WHOLE - below),
        }
    }

    /// Whether a point lies on the first corner's side of the line; none within what the search left open.
    pub(super) fn side_of(self, point: [u16; 2], crossings: &[Crossing; 4]) -> Option<bool> {
        let mut ends = SIDES.iter().zip(crossings).filter_map(|(side, crossing)| match crossing {
            Crossing::At(along) if self.crosses(side) => Some((side.place(*along), *along)),
            _ => None,
        });
        let ((from, a), (to, b)) = (ends.next()?, ends.next()?);
        let way = [to[0] - from[0], to[1] - from[1]];
        let turn = |at: [i64; 2]| way[0] * (at[1] - from[1]) - way[1] * (at[0] - from[0]);
        let (turned, first) = (turn(point.map(i64::from)), turn([0, 0]));
        // Half of the interval in which the line crosses the side.
        let open = |along: u16| 1_i64 << along.trailing_zeros().min(15);
        let least = (way[0].abs() + way[1].abs()) * open(a).max(open(b));
        (turned.abs() > least).then_some((turned < 0) == (first < 0))
    }
}

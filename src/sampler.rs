//! Where the samples of a pixel lie: from a hash of the pixel, without any state, so that the
//! order in which pixels are rendered cannot matter.
//!
//! Everything is computed in integers and given in steps of 2⁻¹⁶, which every number format holds
//! exactly: all of them sample the same points.

use core::num::NonZeroU32;

use crate::chance::{Dimension, hash, mixed};
use crate::scalar::{Number, Real, Scalar};

/// The most samples of a pixel.
pub const SAMPLES_MAX: u16 = 256;

/// How the samples of a pixel are spread over it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Spread {
    /// In the middles of cells of equal area, in rows as even as can be: the same in every pixel.
    Grid,
    /// At a random point of each of these cells (R. L. Cook, "Stochastic Sampling in Computer
    /// Graphics", 1986).
    Jitter,
    /// One in each of N columns and one in each of N rows, otherwise at random (P. Shirley,
    /// "Discrepancy as a Quality Measure for Sample Distributions", 1991).
    Rooks,
    /// Both at once, with the same shuffle in every row and in every column (A. Kensler,
    /// "Correlated Multi-Jittered Sampling", Pixar technical memo 13-01, 2013); where N is no
    /// product of nearly equal factors, in rows of unequal length that are turned round at random.
    #[default]
    MultiJitter,
}

impl Spread {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Grid, Self::Jitter, Self::Rooks, Self::MultiJitter];

    /// The name, as command lines spell it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Grid => "grid",
            Self::Jitter => "jitter",
            Self::Rooks => "rooks",
            Self::MultiJitter => "multi-jitter",
        }
    }
}

/// How much a point of the picture counts for a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PixelFilter {
    /// All points of the pixel alike, and no others.
    #[default]
    Box,
    /// Less with the distance from the pixel's middle, in both directions, down to nothing at
    /// the middles of its neighbours.
    Tent,
}

/// The samples of each pixel. Two of the same settings sample the same points of every pixel, whatever
/// the number format, the target and the order of the pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sampler {
    /// How the samples are spread.
    pub spread: Spread,
    /// What they are weighed by: as many samples lie where it is greater, all of the same weight.
    pub filter: PixelFilter,
    /// How many: from 1, which is the middle of the pixel however they are spread and weighed, to
    /// [`SAMPLES_MAX`].
    pub samples: u16,
    /// Another seed gives other points, spread in the same way.
    pub seed: u32,
}

impl Sampler {
    /// So many samples in correlated multi-jitter, under a box.
    pub const fn new(samples: u16) -> Self {
        Self { spread: Spread::MultiJitter, filter: PixelFilter::Box, samples, seed: 0 }
    }

    /// Where sample number `index` lies, from the upper left corner of a pixel: under a box in 0..1, under a
    /// tent in −½..1½, in both cases exactly a multiple of 2⁻¹⁶. An index from the number of samples
    /// on stands for the last.
    pub fn offset<S: Scalar>(&self, x: u32, y: u32, index: u16) -> [S; 2] {
        let point = self.point([x, y], index, Dimension::PIXEL);
        if self.filter == PixelFilter::Box || self.samples <= 1 {
            return point.map(fraction);
        }
        point.map(|part| S::HALF + tent(part))
    }

    /// The point of a sample in a dimension, in steps of 2⁻¹⁶.
    pub(crate) fn point(&self, [x, y]: [u32; 2], index: u16, dimension: Dimension) -> [u16; 2] {
        let count = match NonZeroU32::new(u32::from(self.samples)) {
            Some(count) if self.samples > 1 && self.samples <= SAMPLES_MAX => count,
            _ => return [MIDDLE; 2],
        };
        let key = [x, y, dimension.0].iter().fold(mixed(self.seed), |key, word| hash(key, *word));
        let mut index = u32::from(index).min(count.get() - 1);
        if dimension != Dimension::PIXEL {
            // So that what comes together in one dimension does not in another.
            index = permute(index, count, hash(key, 0));
        }
        match self.spread {
            Spread::Grid => Cells::of(count).cell(index, |_| [MIDDLE; 2]),
            Spread::Jitter => Cells::of(count).cell(index, |index| jitter(key, index)),
            Spread::Rooks => {
                let across = permute(index, count, hash(key, 1));
                strata([across, index], count, jitter(key, index))
            }
            Spread::MultiJitter => Cells::of(count).correlated(index, key),
        }
    }
}

/// Half of all steps.
const MIDDLE: u16 = 1 << 15;

/// A number of steps of 2⁻¹⁶, exactly.
pub(crate) fn fraction<S: Scalar>(steps: u16) -> S {
    S::from_ratio(i32::from(steps), 1 << 16)
}

/// The place in −1..1 at which the share of a tent's area to its left is the given one, in steps of 2⁻¹⁶.
fn tent<S: Scalar>(share: u16) -> S {
    // From the nearer end the area is half the square of the distance.
    let end = |area: u32| {
        let root = (u64::from(area) << 17).isqrt();
        S::from_ratio((1 << 16) - root as i32, 1 << 16)
    };
    let share = u32::from(share);
    if share < 1 << 15 { -end(share) } else { end((1 << 16) - share) }
}

/// The point of the unit disc for a point of the unit square: areas are kept, and what is near
/// stays near.
///
/// Source: P. Shirley and K. Chiu, "A Low Distortion Map Between Disk and Square" (1997); sine and cosine of at
/// most π/4 by the first terms of their series, which are within 4·10⁻⁷.
pub(crate) fn disc<S: Scalar>(point: [S; 2]) -> [S::Wide; 2] {
    let one = S::Wide::ONE;
    let [a, b] = point.map(|part| part.widen() * S::Wide::TWO - one);
    let wide = a.abs() > b.abs();
    let (radius, other) = if wide { (a, b) } else { (b, a) };
    if radius == S::Wide::ZERO {
        return [radius; 2];
    }
    let angle = S::Wide::PI * S::Wide::from_ratio(1, 4) * (other / radius);
    let square = angle.squared();
    let next = |rest: S::Wide, divisor| one - square * S::Wide::from_ratio(1, divisor) * rest;
    let sin = angle * next(next(next(one, 42), 20), 6);
    let cos = next(next(next(next(one, 56), 30), 12), 2);
    if wide { [radius * cos, radius * sin] } else { [radius * sin, radius * cos] }
}

/// Rows and columns for any number of samples.
struct Cells {
    count: NonZeroU32,
    rows: NonZeroU32,
    /// The samples of a row that is not longer than others.
    base: NonZeroU32,
    /// How many rows, the first ones, have one more.
    longer: u32,
}

impl Cells {
    /// About as many rows as columns. A count from 1 to [`SAMPLES_MAX`].
    fn of(count: NonZeroU32) -> Self {
        let root = count.get().isqrt();
        let up = count.get() > root * root + root;
        let rows = NonZeroU32::MIN.saturating_add(root - 1 + u32::from(up));
        let (base, longer) = (count.get() / rows, count.get() % rows);
        Self { count, rows, base: NonZeroU32::MIN.saturating_add(base - 1), longer }
    }

    /// The row and column of a sample, and how long the row is.
    fn of_index(&self, index: u32) -> (u32, u32, NonZeroU32) {
        let long = self.base.saturating_add(1);
        let in_longer = self.longer * long.get();
        if index < in_longer {
            return (index / long, index % long, long);
        }
        let rest = index - in_longer;
        (self.longer + rest / self.base, rest % self.base, self.base)
    }

    /// A point of a sample's cell; the cells are of equal area.
    fn cell(&self, index: u32, inside: impl Fn(u32) -> [u16; 2]) -> [u16; 2] {
        let (row, column, length) = self.of_index(index);
        let [across, along] = inside(index);
        let above = row * self.base.get() + row.min(self.longer);
        [
            within(column, column + 1, length, across),
            within(above, above + length.get(), self.count, along),
        ]
    }

    /// The point of a sample in correlated multi-jitter.
    fn correlated(&self, index: u32, key: u32) -> [u16; 2] {
        let (row, column, length) = self.of_index(index);
        // Each column of cells is as many strata wide as it has samples, each row as many high.
        let height = if column < self.base.get() {
            self.rows
        } else {
            NonZeroU32::MIN.saturating_add(self.longer.saturating_sub(1))
        };
        let above = row * self.base.get() + row.min(self.longer);
        let mut across = column * self.rows.get() + permute(row, height, hash(key, 1));
        let mut along = above + permute(column, length, hash(key, 2));
        if self.longer > 0 {
            // Cells of unequal area must not be in the same place in every pixel.
            across = turned(across, self.count, hash(key, 3));
            along = turned(along, self.count, hash(key, 4));
        }
        strata([across, along], self.count, jitter(key, index))
    }
}

/// The point of two strata out of `count` that `inside` tells.
fn strata([across, along]: [u32; 2], count: NonZeroU32, inside: [u16; 2]) -> [u16; 2] {
    [within(across, across + 1, count, inside[0]), within(along, along + 1, count, inside[1])]
}

/// A point between two of the `count + 1` ends of equal strata; `from < to ≤ count ≤ 256`.
fn within(from: u32, to: u32, count: NonZeroU32, inside: u16) -> u16 {
    let end = |index: u32| ((index << 16) + (count.get() - 1)) / count;
    let (low, high) = (end(from), end(to));
    let beyond = ((u64::from(high - low) * u64::from(inside)) >> 16) as u32;
    (low + beyond) as u16
}

/// A random point of a sample's cell, in steps of 2⁻¹⁶ of its sides.
fn jitter(key: u32, index: u32) -> [u16; 2] {
    let bits = hash(hash(key, 5), index);
    [(bits >> 16) as u16, bits as u16]
}

/// Where `index` goes when `0..len` is turned round by a random number of places.
fn turned(index: u32, len: NonZeroU32, key: u32) -> u32 {
    let places = (u64::from(key) * u64::from(len.get())) >> 32;
    let sum = index + places as u32;
    if sum < len.get() { sum } else { sum - len.get() }
}

/// Where `index` of `0..len` goes in a random permutation of it.
///
/// A bijection of the next power of two is followed until it comes back below `len`, as the
/// cycle through `index` must: within as many steps as there are numbers above (A. Kensler, section 3).
fn permute(index: u32, len: NonZeroU32, key: u32) -> u32 {
    let mask = u32::MAX.checked_shr((len.get() - 1).leading_zeros()).unwrap_or(0);
    let shift = (mask.count_ones() / 2).max(1);
    let (mut at, key) = (index, mixed(key));
    for _ in 0..=mask {
        // Each of these steps can be undone, so none makes two numbers equal.
        let mut bits = key;
        for _ in 0..3 {
            at = (at ^ bits).wrapping_mul((bits >> 8) | 1) & mask;
            at ^= at >> shift;
            bits = bits.wrapping_mul(0x9e37_79b1).rotate_left(13);
        }
        if at < len.get() {
            break;
        }
    }
    turned(at, len, mixed(key))
}

#[cfg(test)]
mod tests;

//! The boundaries of F ≤ 0 along a ray: isolated by intervals, then refined.

use super::program::run;
use crate::interval::{Algebra, Dual, Interval, Side};
use crate::place::Local;
use crate::roots::bracketed;
use crate::scalar::{Number, Real, Scalar, Vector};

/// F along a ray, less what it is by rounding where the ray starts on the surface.
#[derive(Clone, Copy)]
pub(super) struct Along<'a, S: Scalar> {
    pub(super) code: &'a [u8],
    pub(super) numbers: &'a [S],
    pub(super) ray: Local<S>,
    /// F at the start and, where its sign is not that of the passage, its slope; 0 both for a ray
    /// that starts elsewhere.
    pub(super) start: Dual<S::Wide>,
}

impl<S: Scalar> Along<'_, S> {
    /// Value and slope for a parameter, or for all of an interval.
    #[inline]
    fn evaluate<A: Algebra<Number = S::Wide>>(&self, t: A) -> Dual<A> {
        let (origin, dir) = (self.ray.origin.to_array(), self.ray.dir.to_array());
        let [x, y, z] = [0, 1, 2].map(|i: usize| {
            let of = |v: [S::Wide; 3]| A::exactly(v.get(i).copied().unwrap_or(S::Wide::ZERO));
            Dual { value: of(origin) + of(dir) * t, slope: of(dir) }
        });
        let found = run::<S, A>(self.code, self.numbers, [x, y, z]);
        let Dual { value, slope } = self.start;
        let (value, slope) = (A::exactly(value), A::exactly(slope));
        Dual { value: found.value - (value + slope * t), slope: found.slope - slope }
    }

    #[inline(never)]
    pub(super) fn at(&self, t: S::Wide) -> Dual<S::Wide> {
        self.evaluate(t)
    }

    #[inline(never)]
    pub(super) fn over(&self, [from, to]: [S::Wide; 2]) -> Dual<Interval<S::Wide>> {
        self.evaluate(Interval::between(from, to))
    }

    /// The point at `t` is inside.
    #[inline]
    pub(super) fn is_inside(&self, t: S::Wide) -> bool {
        self.at(t).value < S::Wide::ZERO
    }
}

impl<T: Real> Dual<T> {
    /// What is to be subtracted along a ray from a point of the surface, where this is found, so that
    /// F is 0 there and does not change to the wrong side.
    pub(super) fn deflated(self, inward: bool) -> Self {
        let wrong = if inward { self.slope > T::ZERO } else { self.slope < T::ZERO };
        Self { value: self.value, slope: if wrong { self.slope } else { T::ZERO } }
    }
}

/// After so many evaluations the pieces may be halved once less.
const EVALUATIONS_A_LEVEL: u16 = 32;

/// From this level on a piece is also judged from its middle; before it that is seldom worth it.
const CENTRED_FROM: u32 = 4;

/// The boundaries along a part of a ray, in ascending order.
///
/// The part is halved until a piece has no root, because 0 is not among the values of F, or at
/// most one, because 0 is not among those of its slope; then the signs at its ends decide. A piece that is
/// not told even at the greatest depth holds roots that are nearer to one another than the square
/// root of the precision, or a root where the ray touches: there too the signs at its ends
/// decide, so that the ray goes out as often as it comes in.
///
/// A binary tree without a stack: a piece is told by its place and its level. Of every
/// [`EVALUATIONS_A_LEVEL`] evaluations the greatest depth becomes one less, so there are at most
/// [`evaluations_max`](Self::evaluations_max), and what takes long is seen more coarsely.
///
/// Source: R. E. Moore, *Interval Analysis* (1966), chapter 7; J. M. Snyder, "Interval Analysis for
/// Computer Graphics" (1992); D. P. Mitchell, "Robust Ray Intersection with Interval Arithmetic" (1990).
pub(super) struct Crossings<'a, S: Scalar> {
    along: &'a Along<'a, S>,
    ends: [S::Wide; 2],
    /// The length of the smallest pieces.
    unit: S::Wide,
    /// The greatest depth at first.
    depth: u32,
    /// Where the next piece begins, in smallest pieces.
    position: u32,
    level: u32,
    limit: u32,
    work: u16,
    /// The ray starts on the surface, at the first end.
    started: bool,
    /// The ray is inside at `position`.
    pub(super) inside: bool,
}

impl<'a, S: Scalar> Crossings<'a, S> {
    /// The boundaries between two parameters; for a ray that starts at the first of them, on the
    /// surface or on a face of the box, with the side that it goes to.
    pub(super) fn new(
        along: &'a Along<'a, S>,
        ends: [S::Wide; 2],
        started: bool,
        inside: bool,
    ) -> Self {
        let depth = Self::depth_max();
        let unit = (ends[1] - ends[0]) / S::Wide::from_i32(1 << depth);
        Self {
            along,
            ends,
            unit,
            depth,
            position: 0,
            level: 0,
            limit: depth,
            work: 0,
            started,
            inside,
        }
    }

    /// How often a part is halved at most: about half as often as a number has bits.
    pub(super) fn depth_max() -> u32 {
        if S::Wide::EPSILON > S::Wide::from_f64(1e-10) { 14 } else { 28 }
    }

    /// The most evaluations by intervals.
    #[cfg(test)]
    pub(super) fn evaluations_max() -> u32 {
        Self::depth_max() * (u32::from(EVALUATIONS_A_LEVEL) + 1) + 1
    }

    /// The evaluations so far.
    #[cfg(test)]
    pub(super) fn evaluations(&self) -> u32 {
        (self.depth - self.limit) * u32::from(EVALUATIONS_A_LEVEL) + u32::from(self.work)
    }

    #[inline]
    fn parameter(&self, position: u32) -> S::Wide {
        if position >> self.depth != 0 {
            return self.ends[1];
        }
        self.ends[0] + self.unit * S::Wide::from_i32(position as i32)
    }

    /// The next boundary up to `until`, by the ray's own parameter, or one beyond it; past the
    /// boundary `inside` is the other way round. `None` where there is no other up to there.
    #[inline(never)]
    pub(super) fn next(&mut self, until: S) -> Option<S::Wide> {
        while self.position >> self.depth == 0 {
            let size = 1 << (self.depth - self.level);
            let piece = [self.position, self.position + size].map(|at| self.parameter(at));
            if self.along.ray.arrive(piece[0]) > until {
                break;
            }
            let found = self.along.over(piece);
            self.work += 1;
            if self.work >= EVALUATIONS_A_LEVEL {
                self.work -= EVALUATIONS_A_LEVEL;
                self.limit = self.limit.saturating_sub(1);
            }
            let at_start = self.started && self.position == 0;
            let (rises, falls) = (found.slope.is_positive(), found.slope.is_negative());
            let mut side = found.value.side().filter(|_| !at_start);
            if side.is_none() && !(rises || falls) && self.level >= CENTRED_FROM {
                side = self.side_by_slope(piece, found.slope).filter(|_| !at_start);
            }
            if side.is_none() && !(rises || falls) && self.level < self.limit {
                self.level += 1;
                continue;
            }
            let inside = if let Some(side) = side {
                side == Side::Below
            } else if at_start {
                // F is 0 at the start, so by the mean value theorem nowhere else where it is monotone.
                self.inside
            } else if rises || falls {
                // Only one way leads across.
                if self.inside == falls { falls } else { self.along.is_inside(piece[1]) }
            } else {
                let end = self.along.over([piece[1]; 2]).value.likely_side();
                end.map_or(self.inside, |side| side == Side::Below)
            };
            self.position += size;
            self.level = self.depth - self.position.trailing_zeros().min(self.depth);
            if inside != self.inside {
                self.inside = inside;
                return Some(if side.is_some() { piece[0] } else { self.refine(piece) });
            }
        }
        None
    }

    /// On which side of 0 all values of a piece are, by the value in its middle and the slopes:
    /// nearer than the values by themselves where the slopes are small.
    fn side_by_slope(
        &mut self,
        [from, to]: [S::Wide; 2],
        slope: Interval<S::Wide>,
    ) -> Option<Side> {
        let middle = from + (to - from) * S::Wide::HALF;
        self.work += 1;
        let way = Interval::between(from, to) - Interval::exactly(middle);
        (self.along.over([middle; 2]).value + slope * way).side()
    }

    /// The root in a piece, to the last bit.
    fn refine(&self, piece: [S::Wide; 2]) -> S::Wide {
        let [low, high] = piece;
        let enough = S::rounding(low.abs().max(high.abs())) * S::Wide::HALF;
        // What is entered was not negative before.
        let first = (!self.inside, low + (high - low) * S::Wide::HALF);
        bracketed(piece, first, enough, |t| {
            let Dual { value, slope } = self.along.at(t);
            [value, slope]
        })
    }
}

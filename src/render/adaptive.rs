//! More samples where they matter: at edges, wherever they are seen.
//!
//! Each corner of a pixel has a sample, which it shares with its neighbours, and pixels whose corners
//! see the same thing get one more inside. Where the corners see two things, and nothing in the picture is
//! blurred, the edge between them is looked for on the sides of the pixel, by halving: a few
//! samples tell how much lies on either side as well as many that are spread. All else is divided into
//! quarters, and these again, as far as their samples differ.
//!
//! What a sample sees is known by its signature: a hash of all that its tree of rays met. So an edge in a
//! mirror is an edge, and one that hardly shows is still found.
//!
//! Sources: T. Whitted, "An Improved Illumination Model for Shaded Display" (1980); T. Akimoto, K. Mase
//! and Y. Suenaga, "Pixel-Selected Ray Tracing" (1991).

mod edge;
mod quarters;

use super::plan::{Place, Plan, sealed};
use crate::chance::{Chance, Dimension, hash, mixed};
use crate::color::Rgb;
use crate::error::{Item, SceneError};
use crate::sampler::{PixelFilter, Spread, Sampler, fraction};
use crate::scalar::{Number, Real, Scalar, Vector};
use edge::{Crossing, SIDES, Search, Split};
use quarters::Quarters;

/// The most halvings of a side in search for an edge.
const HALVINGS_MAX: u8 = 4;

/// How pixels are refined.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refine<S> {
    /// The samples of a pixel that is refined everywhere: 4, 16, 64 or 256, under a box, in any pattern but
    /// [`Spread::Rooks`].
    pub sampler: Sampler,
    /// The contrast above which a pixel is refined: the greatest difference of a part of the light of
    /// two of its samples, from 0 to 1 as light is shown.
    pub threshold: S,
}

impl<S: Scalar> Refine<S> {
    fn check(&self) -> Result<u8, SceneError> {
        let at = Item::Sampling;
        let refused = |field, allowed| Err(SceneError::OutOfRange { at, field, allowed });
        let Sampler { pattern, filter, samples, .. } = self.sampler;
        let levels = match samples {
            4 => 1,
            16 => 2,
            64 => 3,
            256 => 4,
            _ => return refused("samples", "4, 16, 64 or 256 for refinement"),
        };
        if pattern == Spread::Rooks {
            return refused("pattern", "one that is spread in both directions, for refinement");
        }
        if filter != PixelFilter::Box {
            return refused("filter", "a box for refinement");
        }
        if !self.threshold.is_finite() {
            return Err(SceneError::NotFinite { at, field: "threshold" });
        }
        if !(self.threshold >= S::ZERO && self.threshold <= S::ONE) {
            return refused("threshold", "between 0 and 1");
        }
        Ok(levels)
    }
}

/// What a picture that is refined remembers of one place in the row above.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner<S> {
    sample: Sample<S>,
    /// Of the side from here to the next corner in the row.
    across: Crossing,
}

impl<S: Scalar> Corner<S> {
    /// Nothing: what a row begins with.
    pub const VACANT: Self = Self { sample: Sample::VACANT, across: Crossing::Unknown };
}

/// A sample and what it saw.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Sample<S> {
    color: Rgb<S>,
    spent: S,
    signature: u32,
}

impl<S: Scalar> Sample<S> {
    const VACANT: Self = Self { color: Rgb::BLACK, spent: S::ZERO, signature: 0 };

    /// The greatest difference of a part of the light, in steps of 2⁻³².
    fn contrast(&self, other: &Self) -> u32 {
        let [mine, theirs] = [self, other].map(|s| s.color.to_array().map(S::to_unit_bits));
        mine.into_iter().zip(theirs).fold(0, |most, (a, b)| most.max(a.abs_diff(b)))
    }

    /// Sees the same thing in the same light.
    fn is_like(&self, other: &Self, limit: u32) -> bool {
        self.signature == other.signature && self.contrast(other) <= limit
    }

    fn light(&self) -> S::WideVec {
        S::WideVec::from_array(self.color.to_array().map(S::widen))
    }
}

/// What is being traced.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Phase {
    /// Corner number so and so of the row above the first.
    Above(u32),
    /// The first corner of a row.
    First,
    /// The corner below right.
    Next,
    /// A point of a side.
    Side(Search),
    /// A point inside; where there is a split, to see whether all is as it tells.
    Probe(Option<Split>),
    /// A quarter.
    Quarter,
}

/// More samples where they matter; the same in any split into rows and tiles, in rows or tiles
/// rendered from their upper left.
#[derive(Debug)]
pub struct Adaptive<'b, S: Scalar> {
    sampler: Sampler,
    levels: u8,
    /// The threshold in steps of 2⁻³².
    limit: u32,
    /// Each point of the picture is one ray, whose light does not depend on chance.
    sharp: bool,
    phase: Phase,
    /// What the sample that is traced has seen so far.
    signature: u32,
    row: &'b mut [Corner<S>],
    /// The corners below.
    left: Sample<S>,
    right: Sample<S>,
    /// Of the sides, above, left, right and below.
    crossings: [Crossing; 4],
    quarters: Quarters<S>,
}

impl<'b, S: Scalar> Adaptive<'b, S> {
    /// For rows of so many pixels; `sharp` where nothing is left to chance.
    pub(super) fn new(
        refine: Refine<S>,
        width: u32,
        sharp: bool,
        row: &'b mut [Corner<S>],
    ) -> Result<Self, SceneError> {
        let levels = refine.check()?;
        let needed = width + 1;
        if row.len() < needed as usize {
            let limit = row.len() as u32;
            return Err(SceneError::RowTooShort { needed, limit });
        }
        let limit = refine.threshold.to_unit_bits();
        Ok(Self {
            sampler: refine.sampler,
            levels,
            limit,
            sharp,
            phase: Phase::Above(0),
            signature: 0,
            row,
            left: Sample::VACANT,
            right: Sample::VACANT,
            crossings: [Crossing::Unknown; 4],
            quarters: Quarters::new(levels, limit),
        })
    }

    fn key(&self, at: Place) -> u32 {
        hash(hash(mixed(!self.sampler.seed), at.x), at.y)
    }

    fn corner(&self, at: Place, across: u32) -> Corner<S> {
        let index = (at.x - at.left + across) as usize;
        self.row.get(index).copied().unwrap_or(Corner::VACANT)
    }

    /// The samples at the corners: above left, above right, below left, below right.
    fn corners(&self, at: Place) -> [Sample<S>; 4] {
        [self.corner(at, 0).sample, self.corner(at, 1).sample, self.left, self.right]
    }

    fn remember(&mut self, index: u32, corner: Corner<S>) {
        if let Some(slot) = self.row.get_mut(index as usize) {
            *slot = corner;
        }
    }

    /// Decides what to do with a pixel whose corners are there.
    fn judge(&mut self, at: Place) {
        let corners = self.corners(at);
        let [first, rest @ ..] = &corners;
        let like = |a: &Sample<S>| corners.iter().all(|b| a.is_like(b, self.limit));
        self.phase = if like(first) && rest.iter().all(like) {
            Phase::Probe(None)
        } else {
            match Split::of(&corners, self.limit).filter(|_| self.sharp) {
                Some(split) => return self.search(at, split),
                None => Phase::Quarter,
            }
        };
        if self.phase == Phase::Quarter {
            self.quarters.begin(self.key(at), corners, None);
        }
    }

    /// Looks for the edge on the next side that it crosses, and inside when it is known on both.
    fn search(&mut self, at: Place, split: Split) {
        let corners = self.corners(at);
        for ((index, side), crossing) in (0..).zip(&SIDES).zip(self.crossings) {
            if !split.crosses(side) {
                continue;
            }
            if crossing == Crossing::Several {
                self.phase = Phase::Quarter;
                return self.quarters.begin(self.key(at), corners, None);
            }
            if crossing == Crossing::Unknown {
                let [Some(a), Some(b)] = side.ends.map(|end| corners.get(usize::from(end))) else {
                    continue;
                };
                let mut halvings = 1;
                while halvings < HALVINGS_MAX && a.contrast(b) >> halvings > self.limit {
                    halvings += 1;
                }
                self.phase = Phase::Side(Search::new(index, halvings));
                return;
            }
        }
        self.phase = Phase::Probe(Some(split));
    }

    /// Takes a point of a side.
    fn narrow(&mut self, at: Place, search: Search, sample: &Sample<S>) {
        let corners = self.corners(at);
        let Some(side) = SIDES.get(usize::from(search.side)) else {
            return;
        };
        let [Some(a), Some(b)] = side.ends.map(|end| corners.get(usize::from(end))) else {
            return;
        };
        match search.narrow(sample, [a, b], self.limit) {
            Ok(search) => self.phase = Phase::Side(search),
            Err(found) => {
                if let Some(slot) = self.crossings.get_mut(usize::from(search.side)) {
                    *slot = found;
                }
                match Split::of(&corners, self.limit) {
                    Some(split) => self.search(at, split),
                    None => self.judge(at),
                }
            }
        }
    }

    /// Takes the point inside: the light of the pixel, if that settles it.
    fn probe(
        &mut self,
        at: Place,
        split: Option<Split>,
        sample: Sample<S>,
    ) -> Option<(S::WideVec, S::Wide)> {
        let corners = self.corners(at);
        let light = match split {
            None => corners.iter().all(|corner| corner.is_like(&sample, self.limit)).then(|| {
                let all = corners.iter().chain([&sample]);
                mean(all, |sample| sample.light())
            }),
            Some(split) => self.parted(at, split, &corners, &sample),
        };
        if light.is_none() {
            self.phase = Phase::Quarter;
            self.quarters.begin(self.key(at), corners, Some(sample));
            return self.quarters.settle();
        }
        light
    }

    /// The light of a pixel that an edge parts, if the point inside sees what the edge tells.
    fn parted(
        &self,
        at: Place,
        split: Split,
        corners: &[Sample<S>; 4],
        sample: &Sample<S>,
    ) -> Option<(S::WideVec, S::Wide)> {
        let point = self.sampler.cell([at.x, at.y], self.quarters.probe_of(self.key(at)), self.levels);
        let likes = |first: bool| {
            let mut seen = (0_u8..).zip(corners).filter(|(index, _)| split.is_first(*index) == first);
            seen.all(|(_, corner)| corner.is_like(sample, self.limit))
        };
        let first = if likes(true) {
            true
        } else if likes(false) {
            false
        } else {
            return None;
        };
        if split.side_of(point, &self.crossings).is_some_and(|expected| expected != first) {
            return None;
        }
        let of = |which: bool| {
            let seen = (0_u8..).zip(corners).filter(|(index, _)| split.is_first(*index) == which);
            let inside = (first == which).then_some(sample);
            mean(seen.map(|(_, corner)| corner).chain(inside), Sample::light)
        };
        let share = S::Wide::from_ratio(split.share(&self.crossings) as i32, 1 << 16);
        let ((one, one_spent), (other, other_spent)) = (of(true), of(false));
        let rest = S::Wide::ONE - share;
        Some((one * share + other * rest, one_spent * share + other_spent * rest))
    }

    /// Ends a pixel, and makes what it knows of its sides those of the next.
    fn finish(&mut self, at: Place, (light, spent): (S::WideVec, S::Wide)) -> (Rgb<S>, S) {
        let index = at.x - at.left;
        let [_, _, right, below] = self.crossings;
        self.remember(index, Corner { sample: self.left, across: below });
        self.left = self.right;
        let across = self.corner(at, 1).across;
        self.crossings = [across, right, Crossing::Unknown, Crossing::Unknown];
        self.phase = Phase::Next;
        if at.x + 1 == at.right {
            self.remember(index + 1, Corner { sample: self.left, across: Crossing::Unknown });
            self.phase = Phase::First;
        }
        let [r, g, b] = light.to_array().map(S::narrow);
        (Rgb::new(r, g, b), S::narrow(spent))
    }
}

/// The mean of samples, of which there is at least one.
fn mean<'s, S: Scalar>(
    samples: impl Iterator<Item = &'s Sample<S>>,
    light: impl Fn(&Sample<S>) -> S::WideVec,
) -> (S::WideVec, S::Wide) {
    let (mut sum, mut spent, mut count) = (S::WideVec::ZERO, S::Wide::ZERO, 0);
    for sample in samples {
        sum += light(sample);
        spent += sample.spent.widen();
        count += 1;
    }
    let part = S::Wide::from_ratio(1, count.max(1));
    (sum * part, spent * part)
}

impl<S: Scalar> Plan<S> for Adaptive<'_, S> {}

impl<S: Scalar> sealed::Watch for Adaptive<'_, S> {
    fn meet(&mut self, mark: impl FnOnce() -> u32) {
        self.signature = hash(self.signature, mark());
    }
}

impl<S: Scalar> sealed::Work<S> for Adaptive<'_, S> {
    type Chance = Spot;

    fn aim(&self, at: Place) -> ([u32; 2], [S; 2]) {
        let Place { x, y, left, .. } = at;
        let (pixel, point) = match self.phase {
            Phase::Above(index) => ([left + index, y], [0; 2]),
            Phase::First => ([left, y + 1], [0; 2]),
            Phase::Next => ([x + 1, y + 1], [0; 2]),
            Phase::Side(search) => {
                let side = SIDES.get(usize::from(search.side));
                let ([across, along], point) =
                    side.map_or(([0; 2], [0; 2]), |side| side.point(search.middle()));
                ([x + across, y + along], point)
            }
            Phase::Probe(_) => {
                let cell = self.quarters.probe_of(self.key(at));
                ([x, y], self.sampler.cell([x, y], cell, self.levels))
            }
            Phase::Quarter => {
                ([x, y], self.sampler.cell([x, y], self.quarters.next(), self.levels))
            }
        };
        (pixel, point.map(fraction))
    }

    fn chance(&self, at: Place) -> Spot {
        let Place { x, y, left, .. } = at;
        let (pixel, cell) = match self.phase {
            Phase::Above(index) => ([left + index, y], None),
            Phase::First => ([left, y + 1], None),
            // Nothing is left to chance where sides are searched.
            Phase::Next | Phase::Side(_) => ([x + 1, y + 1], None),
            Phase::Probe(_) => ([x, y], Some(self.quarters.probe_of(self.key(at)))),
            Phase::Quarter => ([x, y], Some(self.quarters.next())),
        };
        Spot { sampler: self.sampler, levels: self.levels, pixel, cell }
    }

    fn take(&mut self, at: Place, color: Rgb<S>, spent: S) -> Option<(Rgb<S>, S)> {
        let sample = Sample { color, spent, signature: self.signature };
        self.signature = 0;
        let light = match self.phase {
            Phase::Above(index) => {
                self.remember(index, Corner { sample, across: Crossing::Unknown });
                let last = at.left + index == at.right;
                self.phase = if last { Phase::First } else { Phase::Above(index + 1) };
                None
            }
            Phase::First => {
                self.left = sample;
                let across = self.corner(at, 0).across;
                self.crossings =
                    [across, Crossing::Unknown, Crossing::Unknown, Crossing::Unknown];
                self.phase = Phase::Next;
                None
            }
            Phase::Next => {
                self.right = sample;
                self.judge(at);
                None
            }
            Phase::Side(search) => {
                self.narrow(at, search, &sample);
                None
            }
            Phase::Probe(split) => self.probe(at, split, sample),
            Phase::Quarter => {
                self.quarters.take(sample);
                self.quarters.settle()
            }
        };
        light.map(|light| self.finish(at, light))
    }

    fn restart(&mut self) {
        (self.phase, self.signature) = (Phase::Above(0), 0);
    }
}

/// A sample at a corner, or in a cell of the finest division of a pixel.
#[derive(Clone, Copy, Debug)]
pub struct Spot {
    sampler: Sampler,
    levels: u8,
    pixel: [u32; 2],
    cell: Option<[u8; 2]>,
}

impl<S: Scalar> Chance<S> for Spot {
    fn pair(&self, dimension: Dimension) -> [S; 2] {
        let point = match self.cell {
            Some(cell) => self.sampler.shuffled_cell(self.pixel, cell, self.levels, dimension),
            None => self.sampler.corner(self.pixel, dimension),
        };
        point.map(fraction)
    }
}

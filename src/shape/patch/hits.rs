//! The hits of a ray on a set of patches, in order, each once.

use super::Patches;
use super::borders::Sides;
use super::net::Pair;
use crate::scalar::{Number, Real, Scalar};
use crate::shape::Tables;

/// How many hits one pass over the patches keeps; where there are more, another pass follows.
pub(super) const HITS_MAX: usize = 16;

/// A point of a patch on a ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hit<S: Scalar> {
    /// The parameter on the ray.
    pub(super) t: S,
    pub(super) patch: u16,
    /// The sign of the area of du and dv across the ray; 0 where it is not known.
    pub(super) facing: i8,
    /// The sides of the patch that it is on, to rounding.
    pub(super) sides: Sides,
    /// Its parameters on the patch.
    pub(super) at: Pair<S::Wide>,
}

/// The first hits after some t, in ascending order.
pub(super) struct Hits<S: Scalar> {
    list: [Hit<S>; HITS_MAX],
    count: u8,
    /// The last hit of the pass before.
    after: Option<Hit<S>>,
    /// There was no room for all.
    pub(super) more: bool,
}

impl<S: Scalar> Hits<S> {
    pub(super) fn new(after: Option<Hit<S>>) -> Self {
        let vacant =
            Hit { t: S::ZERO, patch: 0, facing: 0, sides: Sides::NONE, at: [S::Wide::ZERO; 2] };
        Self { list: [vacant; HITS_MAX], count: 0, after, more: false }
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &Hit<S>> {
        self.list.iter().take(usize::from(self.count))
    }

    /// The first hit after some t.
    pub(super) fn first(&self, after: S) -> Option<&Hit<S>> {
        self.iter().find(|hit| hit.t > after)
    }

    /// Puts a hit in its place, unless it is there already: on a line between two pieces, or on
    /// a border that two patches share, each may have found it. Of two hits at the same t one is kept.
    pub(super) fn add(
        &mut self,
        hit: Hit<S>,
        slack: Pair<S::Wide>,
        patches: &Patches<S>,
        tables: &Tables<'_, S>,
    ) {
        if self.after.is_some_and(|last| hit.t <= last.t) {
            return;
        }
        let same = |other: &Hit<S>| {
            hit.t == other.t || hit.is_near(other, slack) || patches.meet(tables, &hit, other)
        };
        if self.iter().chain(&self.after).any(same) {
            return;
        }
        let mut carried = hit;
        for slot in self.list.iter_mut().take(usize::from(self.count)) {
            if carried.t < slot.t {
                core::mem::swap(&mut carried, slot);
            }
        }
        match self.list.get_mut(usize::from(self.count)) {
            Some(slot) => {
                *slot = carried;
                self.count += 1;
            }
            None => self.more = true,
        }
    }
}

impl<S: Scalar> Hit<S> {
    /// Both are the same point of one patch, found twice.
    fn is_near(&self, other: &Self, slack: Pair<S::Wide>) -> bool {
        let turned = self.facing * other.facing < 0;
        let least = S::Wide::EPSILON * S::Wide::from_i32(64);
        let near = |a: S::Wide, b: S::Wide, slack: S::Wide| {
            (a - b).abs() <= slack * S::Wide::from_i32(8) + least
        };
        let ([u, v], [other_u, other_v], [su, sv]) = (self.at, other.at, slack);
        self.patch == other.patch && !turned && near(u, other_u, su) && near(v, other_v, sv)
    }
}

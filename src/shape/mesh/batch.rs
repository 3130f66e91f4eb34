//! What a ray meets next of a mesh: a few places in order, as many as there is room for.

use super::view::Crossing;
use crate::scalar::{Real, Scalar};
use crate::span::{End, Passage};

/// No triangle.
const NONE: u32 = u32::MAX;

/// The room for places. Most rays meet no more in one mesh; where they do, the next ones are looked for again.
const ROOM: usize = 6;

/// All that a ray meets at one place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Group<S> {
    pub(super) t: S,
    /// An even number of triangles.
    pub(super) even: bool,
    /// The first triangle that the ray goes through inward, and the first outward.
    faces: [u32; 2],
}

impl<S: Real> Group<S> {
    pub(super) fn of(crossing: Crossing<S>) -> Self {
        let Crossing { t, face, inward } = crossing;
        Self { t, even: false, faces: if inward { [face, NONE] } else { [NONE, face] } }
    }

    /// Takes in a triangle that is met at the same place.
    pub(super) fn join(&mut self, crossing: Crossing<S>) {
        let ([a, b], [c, d]) = (self.faces, Self::of(crossing).faces);
        (self.even, self.faces) = (!self.even, [a.min(c), b.min(d)]);
    }

    /// The face where the ray enters the mesh or leaves it; the first of all if it does neither.
    pub(super) fn face(&self, passage: Passage) -> u32 {
        let [inward, outward] = self.faces;
        match passage {
            Passage::Enter if inward != NONE => inward,
            Passage::Leave if outward != NONE => outward,
            _ => inward.min(outward),
        }
    }

    pub(super) fn end(&self, passage: Passage) -> (End<S>, Passage) {
        (End { t: self.t, face: self.face(passage) }, passage)
    }
}

/// The first places after some place of a ray, in ascending order.
#[derive(Clone, Copy)]
pub(super) struct Batch<S> {
    groups: [Group<S>; ROOM],
    len: u8,
    /// How many are wanted.
    most: u8,
    /// There may be more places after the last one.
    more: bool,
}

impl<S: Scalar> Batch<S> {
    /// Nothing yet of so many places, from 1 to the room that there is.
    pub(super) fn new(most: u8) -> Self {
        let vacant = Group { t: S::ZERO, even: true, faces: [NONE; 2] };
        Self { groups: [vacant; ROOM], len: 0, most: most.min(ROOM as u8), more: true }
    }

    /// Room for a list.
    pub(super) fn roomy() -> Self {
        Self::new(ROOM as u8)
    }

    /// The first place after `at`, if it is among these.
    pub(super) fn after(&self, at: S) -> Option<Group<S>> {
        self.groups.iter().take(self.len.into()).find(|group| group.t > at).copied()
    }

    /// There may be places after the last one.
    pub(super) const fn has_more(&self) -> bool {
        self.more
    }

    /// Forgets all places, to be filled anew.
    pub(super) const fn clear(&mut self) {
        (self.len, self.more) = (0, true);
    }

    /// All crossings have been seen, so nothing is missing but what there was no room for.
    pub(super) const fn finish(&mut self) {
        self.more = self.len == self.most;
    }

    /// Takes in a crossing; where all room is taken, tells beyond which place nothing is of interest.
    pub(super) fn take(&mut self, crossing: Crossing<S>) -> Option<S> {
        let (len, most) = (usize::from(self.len), usize::from(self.most));
        let place = self.groups.iter().take(len).take_while(|group| group.t < crossing.t).count();
        match self.groups.get_mut(place) {
            Some(group) if place < len && group.t == crossing.t => group.join(crossing),
            _ if place < most => {
                for to in (place + 1..most.min(len + 1)).rev() {
                    let moved = self.groups.get(to - 1).copied();
                    if let (Some(moved), Some(slot)) = (moved, self.groups.get_mut(to)) {
                        *slot = moved;
                    }
                }
                if let Some(slot) = self.groups.get_mut(place) {
                    *slot = Group::of(crossing);
                }
                self.len = (len + 1).min(most) as u8;
            }
            _ => {}
        }
        if self.len < self.most {
            return None;
        }
        self.groups.get(most - 1).map(|last| last.t)
    }
}

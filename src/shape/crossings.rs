//! Where a ray crosses the many faces of one solid: brought into order in little room, and made
//! into spans.

use crate::place::Local;
use crate::scalar::{Number, Real, Scalar};
use crate::span::{End, Span};

/// How many crossings are brought into order at a time; of more, the faces are gone through again.
const ROOM: usize = 16;

/// Both rules agree that there is a crossing.
pub(super) const BOTH: u8 = 3;
/// The crossing of a ray that is shifted aside by less than any number.
pub(super) const LOWER: u8 = 1;
/// The crossing of a ray that is shifted as little to the other side.
pub(super) const UPPER: u8 = 2;

/// A ray through a face.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Crossing<T> {
    t: T,
    /// Which one it was of those that were found, to tell equal ones apart.
    order: u32,
    face: u32,
    rules: u8,
}

impl<T: Real> Crossing<T> {
    const NONE: Self = Self { t: T::ZERO, order: 0, face: 0, rules: 0 };

    fn precedes(&self, other: &Self) -> bool {
        self.t < other.t || (self.t == other.t && self.order < other.order)
    }
}

/// Where a ray starts on one of the faces.
#[derive(Clone, Copy, Debug)]
pub(super) struct Departure<T> {
    /// The face.
    pub(super) face: u32,
    /// The ray goes inside.
    pub(super) inward: bool,
    /// So near to the start rounding decides what lies ahead.
    pub(super) within: T,
}

/// The crossings of a ray, by and by in ascending order.
///
/// A solid offers them as it finds them, in any order but the same each time. They are counted by a
/// rule for rays through an edge or along a face; where the two rules that lend themselves to it
/// differ, a point is inside if one of them says so.
#[derive(Clone, Debug)]
pub(super) struct Crossings<T> {
    kept: [Crossing<T>; ROOM],
    len: u32,
    /// How many of them do not count, from the first on.
    skipped: u32,
    /// The last one that was given out before.
    last: Option<Crossing<T>>,
    offered: u32,
    /// There were more than are kept.
    more: bool,
    departure: Option<Departure<T>>,
    /// An odd number lies ahead of the start.
    odd: bool,
    /// The one nearest to the start among those that do not.
    nearest: Option<Crossing<T>>,
}

impl<T: Real> Crossings<T> {
    fn new(departure: Option<Departure<T>>) -> Self {
        Self {
            kept: [Crossing::NONE; ROOM],
            len: 0,
            skipped: 0,
            last: None,
            offered: 0,
            more: false,
            departure,
            odd: false,
            nearest: None,
        }
    }

    /// Takes note of a crossing.
    #[inline(never)]
    pub(super) fn offer(&mut self, t: T, face: u32, rules: u8) {
        let found = Crossing { t, order: self.offered, face, rules };
        self.offered = self.offered.saturating_add(1);
        if let Some(departure) = &self.departure {
            if t <= departure.within {
                if self.nearest.is_none_or(|nearest| t.abs() < nearest.t.abs()) {
                    self.nearest = Some(found);
                }
                return;
            }
            self.odd = !self.odd;
        }
        if self.last.is_none_or(|last| last.precedes(&found)) {
            self.keep(found);
        }
    }

    fn keep(&mut self, mut found: Crossing<T>) {
        let mut slots = self.kept.iter_mut();
        for slot in slots.by_ref().take(self.len as usize) {
            if found.precedes(slot) {
                core::mem::swap(slot, &mut found);
            }
        }
        match slots.next() {
            Some(slot) => {
                *slot = found;
                self.len += 1;
            }
            None => self.more = true,
        }
    }

    /// Makes the number ahead of the start fit to where the ray goes: if rounding put a crossing on
    /// the wrong side of the start it was that nearest to it.
    fn settle(&mut self) {
        let Some(Departure { face, inward, within }) = self.departure else {
            return;
        };
        if self.odd == inward {
            return;
        }
        let first = self.kept.first().copied().filter(|_| self.len > 0);
        let behind = self.nearest.filter(|nearest| {
            let distance = nearest.t.abs();
            distance <= within || first.is_none_or(|first| distance < first.t)
        });
        if let (None, Some(_)) = (behind, first) {
            self.skipped = 1;
            return;
        }
        let face = behind.map_or(face, |behind| behind.face);
        let t = behind.map_or(T::TINY, |behind| behind.t.max(T::TINY));
        self.keep(Crossing { t, order: 0, face, rules: BOTH });
    }

    /// Makes room for those after the ones that are kept, if there are any.
    fn go_on(&mut self) -> bool {
        self.last = self.kept.get(self.len.saturating_sub(1) as usize).copied();
        let more = self.more;
        (self.len, self.skipped, self.offered, self.more) = (0, 0, 0, false);
        more
    }

    fn kept(&self) -> impl Iterator<Item = &Crossing<T>> {
        self.kept.iter().take(self.len as usize).skip(self.skipped as usize)
    }
}

/// Gives the spans between the crossings that `gather` offers, as far as they are in `window`; at most
/// `spans_max`. A ray that departs from a face is given what lies ahead.
///
/// Neighbours that rounding joins are one span, and what begins and ends in one place is none.
/// `gather` is called once for each [`ROOM`] crossings, and once more.
#[inline]
pub(super) fn spans_between<S: Scalar>(
    ray: &Local<S>,
    departure: Option<Departure<S::Wide>>,
    window: &Span<S::Wide>,
    spans_max: u16,
    gather: impl Fn(&mut Crossings<S::Wide>),
    mut emit: impl FnMut(Span<S>),
) {
    let mut crossings = Crossings::new(departure);
    let mut walk = Walk::new(departure);
    let mut left = spans_max;
    let mut give = |span: Option<Span<S>>| {
        if let (Some(span), 1..) = (span, left) {
            left -= 1;
            emit(span);
        }
    };
    gather(&mut crossings);
    crossings.settle();
    loop {
        for crossing in crossings.kept() {
            give(walk.pass(ray, window, crossing));
        }
        if !crossings.go_on() {
            break;
        }
        gather(&mut crossings);
    }
    give(walk.waiting);
}

/// Gives the crossings that `gather` offers as those of an open surface, at most `touches_max`.
#[inline]
pub(super) fn touches<S: Scalar>(
    ray: &Local<S>,
    departure: Option<Departure<S::Wide>>,
    touches_max: u16,
    gather: impl Fn(&mut Crossings<S::Wide>),
    mut emit: impl FnMut(Span<S>),
) {
    let mut crossings = Crossings::new(departure);
    let (mut last, mut left) = (None, touches_max);
    loop {
        gather(&mut crossings);
        for crossing in crossings.kept() {
            let t = ray.arrive(crossing.t);
            if left > 0 && last.is_none_or(|last| last < t) {
                emit(Span::of_face(crossing.face, t, t));
                (last, left) = (Some(t), left - 1);
            }
        }
        if !crossings.go_on() {
            break;
        }
    }
}

/// A way along a ray, from crossing to crossing.
struct Walk<S: Scalar> {
    /// The rules by which this is inside.
    inside: u8,
    enter: End<S::Wide>,
    /// A span that the next one may still join.
    waiting: Option<Span<S>>,
}

impl<S: Scalar> Walk<S> {
    fn new(departure: Option<Departure<S::Wide>>) -> Self {
        let inside = departure.is_some_and(|departure| departure.inward);
        let face = departure.map_or(0, |departure| departure.face);
        let enter = End { t: S::Wide::ZERO, face };
        Self { inside: if inside { BOTH } else { 0 }, enter, waiting: None }
    }

    /// Goes through a crossing; the span that no further one can join.
    fn pass(
        &mut self,
        ray: &Local<S>,
        window: &Span<S::Wide>,
        crossing: &Crossing<S::Wide>,
    ) -> Option<Span<S>> {
        let end = End { t: crossing.t, face: crossing.face };
        let was_inside = self.inside != 0;
        self.inside ^= crossing.rules;
        match (was_inside, self.inside != 0) {
            (false, true) => self.enter = end,
            (true, false) => {
                let mut span = Span { enter: self.enter, exit: end };
                span.clip(window);
                if span.is_open() {
                    return self.take(span.map(|t| ray.arrive(t)).solid());
                }
            }
            _ => {}
        }
        None
    }

    fn take(&mut self, span: Span<S>) -> Option<Span<S>> {
        if let Some(waiting) = &mut self.waiting
            && span.enter.t <= waiting.exit.t
        {
            if waiting.exit.t < span.exit.t {
                waiting.exit = span.exit;
            }
            return None;
        }
        self.waiting.replace(span)
    }
}

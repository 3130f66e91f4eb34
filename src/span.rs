//! Intervals of a ray, and the set operations on lists of their ends.

use crate::scalar::{Real, Scalar};

/// One end of an interval: where, and through which face of the leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct End<S> {
    /// The parameter on the ray.
    pub t: S,
    /// The face of the leaf.
    pub face: u32,
}

/// What lies inside a leaf along a ray: from `enter` up to, not including, `exit`. An open
/// surface, which has no inside, gives twice the same end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span<S> {
    /// Where the ray comes in.
    pub enter: End<S>,
    /// Where it goes out.
    pub exit: End<S>,
}

impl<S: Real> Span<S> {
    /// The whole ray, to be clipped.
    #[inline]
    pub(crate) fn whole() -> Self {
        Self { enter: End { t: -S::FAR, face: 0 }, exit: End { t: S::FAR, face: 0 } }
    }

    /// An interval between two ends on one face.
    #[inline]
    pub(crate) fn of_face(face: u32, enter: S, exit: S) -> Self {
        Self { enter: End { t: enter, face }, exit: End { t: exit, face } }
    }

    /// A point of an open surface.
    #[inline]
    pub(crate) fn touch(t: S) -> Self {
        Self::of_face(0, t, t)
    }

    /// The part that is also in another interval; where ends coincide, this one's stay.
    #[inline]
    pub(crate) fn clip(&mut self, other: &Self) {
        if self.enter.t < other.enter.t {
            self.enter = other.enter;
        }
        if other.exit.t < self.exit.t {
            self.exit = other.exit;
        }
    }

    /// The same faces at other parameters.
    #[inline]
    pub(crate) fn map<T>(self, f: impl Fn(S) -> T) -> Span<T> {
        let Self { enter, exit } = self;
        Span {
            enter: End { t: f(enter.t), face: enter.face },
            exit: End { t: f(exit.t), face: exit.face },
        }
    }

    /// It holds at least one point.
    #[inline]
    pub(crate) fn is_open(&self) -> bool {
        self.enter.t < self.exit.t
    }
}

impl<S: Scalar> Span<S> {
    /// The same span, but not empty: where rounding put both ends in one place, or the exit
    /// before the entry, the exit is the next number. A thin solid far away stays one.
    #[inline]
    pub(crate) fn solid(mut self) -> Self {
        if self.exit.t <= self.enter.t {
            self.exit.t = self.enter.t.next_up();
        }
        self
    }
}

/// What a ray does at a boundary of a solid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Passage {
    /// It comes into the solid.
    Enter,
    /// It goes out of the solid.
    Leave,
    /// It goes through an open surface, from outside to outside.
    Touch,
}

/// A boundary of a solid on a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Boundary<S> {
    /// The parameter on the ray.
    pub t: S,
    /// The leaf whose surface this is, as an index into the scene's nodes.
    pub node: u32,
    /// Which face of that leaf.
    pub face: u32,
    /// Into the solid or out of it.
    pub passage: Passage,
    /// The solid lies on the other side than the leaf does: a cut face, whose normal is the
    /// leaf's turned round.
    pub inverted: bool,
}

impl<S: Scalar> Boundary<S> {
    /// What fills a buffer before it is used.
    pub(crate) fn vacant() -> Self {
        Self { t: S::ZERO, node: 0, face: 0, passage: Passage::Touch, inverted: false }
    }

    fn turned(self, passage: Passage) -> Self {
        Self { passage, inverted: self.inverted != (self.passage != passage), ..self }
    }
}

/// How two solids are combined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    /// In any of the operands.
    Union,
    /// In all of the operands.
    Intersection,
    /// In the first operand and in none of the others.
    Difference,
    /// In an odd number of the operands.
    Xor,
    /// Not in the one operand.
    Complement,
}

impl Operator {
    /// The membership that results from that of the operands so far and that of the next.
    #[inline]
    pub(crate) const fn combine(self, left: bool, right: bool) -> bool {
        match self {
            Self::Union => left || right,
            Self::Intersection => left && right,
            Self::Difference => left && !right,
            Self::Xor | Self::Complement => left != right,
        }
    }

    /// The result where it does not depend on the operands to come.
    #[inline]
    pub(crate) const fn settled(self, left: bool) -> bool {
        match self {
            Self::Union => left,
            Self::Intersection | Self::Difference => !left,
            Self::Xor | Self::Complement => false,
        }
    }
}

/// The boundaries of a solid along a ray in ascending order, and whether the ray starts inside.
#[derive(Clone, Copy, Debug)]
pub struct Spans<'b, S> {
    /// The start of the ray is inside.
    pub inside: bool,
    /// The boundaries after the start.
    pub boundaries: &'b [Boundary<S>],
}

impl<S: Scalar> Spans<'_, S> {
    /// The point at `t` is inside; the set is half-open, so an exit is outside and an entry inside.
    pub fn contains(&self, t: S) -> bool {
        let mut inside = self.inside;
        for boundary in self.boundaries.iter().filter(|b| b.t <= t) {
            match boundary.passage {
                Passage::Enter => inside = true,
                Passage::Leave => inside = false,
                Passage::Touch => {}
            }
        }
        inside
    }
}

/// Combines two neighbouring lists of one buffer, `[from, middle)` and `[middle, to)`, writes
/// the result at `from` and gives its length. Both lists ascend strictly, and so does the result.
///
/// Boundaries at the same t are passed in one transition, and the left one stands for both.
/// Where a right boundary and a left one `coincide` but for rounding, and the two together do
/// what the right one does alone, the surface is the left one's as well: faces in one plane
/// show the material of the first operand, not a speckle of both.
pub(crate) fn merge<S: Scalar>(
    buffer: &mut [Boundary<S>],
    [from, middle, to]: [usize; 3],
    operator: Operator,
    mut states: [bool; 2],
    coincide: impl Fn(&Boundary<S>, &Boundary<S>) -> bool,
) -> usize {
    let (mut left, mut right, mut out) = (from, middle, to);
    let mut inside = operator.combine(states[0], states[1]);
    let mut passed = None;
    loop {
        let a = buffer.get(left).filter(|_| left < middle).copied();
        let b = buffer.get(right).filter(|_| right < to).copied();
        let (a, b, next) = match (a, b) {
            (None, None) => break,
            (Some(a), Some(b)) if a.t < b.t => (Some(a), None, None),
            (Some(a), Some(b)) if b.t < a.t => (None, Some(b), Some(a)),
            (a, b) => (a, b, None),
        };
        left += usize::from(a.is_some());
        right += usize::from(b.is_some());
        let before = states;
        states = [state_after(states[0], a), state_after(states[1], b)];
        let now = operator.combine(states[0], states[1]);
        let emitted = if now != inside {
            let source = closed(a).or_else(|| {
                let b = closed(b)?;
                // The left boundary just before or after does the same together with this one.
                let same = |a: &Boundary<S>| coincide(a, &b);
                let earlier = closed(passed)
                    .filter(|a| operator.combine(a.passage == Passage::Leave, before[1]) == inside);
                let later = closed(next)
                    .filter(|a| operator.combine(a.passage == Passage::Enter, states[1]) == now);
                let stand_in = earlier.filter(same).or_else(|| later.filter(same));
                Some(stand_in.map_or(b, |a| Boundary { t: b.t, ..a }))
            });
            source.map(|b| b.turned(if now { Passage::Enter } else { Passage::Leave }))
        } else if now {
            None
        } else {
            open(a).or(open(b))
        };
        inside = now;
        passed = a.or(passed);
        if let (Some(boundary), Some(slot)) = (emitted, buffer.get_mut(out)) {
            *slot = boundary;
            out += 1;
        }
    }
    let length = out - to;
    // Down to `from`, one by one: a copy of a range would bring a panic into the firmware.
    for offset in 0..length {
        let moved = buffer.get(to + offset).copied();
        if let (Some(boundary), Some(slot)) = (moved, buffer.get_mut(from + offset)) {
            *slot = boundary;
        }
    }
    length
}

/// The one operand has no boundaries and leaves those of the other as they are.
#[inline]
pub(crate) fn is_neutral(operator: Operator, [left, right]: [usize; 2], states: [bool; 2]) -> bool {
    match operator {
        Operator::Union | Operator::Xor => (right == 0 && !states[1]) || (left == 0 && !states[0]),
        Operator::Intersection => (right == 0 && states[1]) || (left == 0 && states[0]),
        Operator::Difference => right == 0 && !states[1],
        Operator::Complement => false,
    }
}

/// Drops the spans and gaps that only rounding makes, so that a hole that ends flush with a
/// face leaves no lid and solids that touch join without a seam; gives the new length.
///
/// Such a sliver lies between boundaries of different leaves that `coincide`. An open surface
/// gives way to a closed one, and of two open ones that with the lower index stays.
pub(crate) fn drop_slivers<S: Scalar>(
    list: &mut [Boundary<S>],
    coincide: impl Fn(&Boundary<S>, &Boundary<S>) -> bool,
) -> usize {
    let mut out = 0_usize;
    for index in 0..list.len() {
        let Some(&next) = list.get(index) else { break };
        let last = out.checked_sub(1).and_then(|last| list.get(last)).copied();
        let close = |a: &Boundary<S>, b: &Boundary<S>| a.node != b.node && coincide(a, b);
        // Of two slivers side by side the thinner one is the one that rounding made.
        let sliver = last.filter(|last| close(last, &next)).filter(|last| {
            let further = list.get(index + 1);
            further.is_none_or(|f| next.t - last.t <= f.t - next.t || !close(&next, f))
        });
        let at = match sliver {
            None => {
                out += 1;
                out - 1
            }
            Some(last) => match (closed(Some(last)), closed(Some(next))) {
                (Some(_), Some(_)) => {
                    out -= 1;
                    continue;
                }
                (Some(_), None) => continue,
                (None, None) if last.node < next.node => continue,
                (None, _) => out - 1,
            },
        };
        if let Some(slot) = list.get_mut(at) {
            *slot = next;
        }
    }
    out
}

fn state_after<S>(state: bool, boundary: Option<Boundary<S>>) -> bool {
    match boundary.map(|b| b.passage) {
        Some(Passage::Enter) => true,
        Some(Passage::Leave) => false,
        Some(Passage::Touch) | None => state,
    }
}

#[inline]
fn closed<S>(boundary: Option<Boundary<S>>) -> Option<Boundary<S>> {
    boundary.filter(|b| b.passage != Passage::Touch)
}

#[inline]
fn open<S>(boundary: Option<Boundary<S>>) -> Option<Boundary<S>> {
    boundary.filter(|b| b.passage == Passage::Touch)
}

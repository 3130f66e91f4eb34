//! Intervals of a ray, and the set operations on lists of their ends.

use crate::scalar::Scalar;

/// One end of an interval: where, and through which face of the leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct End<S> {
    /// The parameter on the ray.
    pub t: S,
    /// The face of the leaf.
    pub face: u16,
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

impl<S: Scalar> Span<S> {
    /// The whole ray, to be clipped.
    #[inline]
    pub(crate) fn whole() -> Self {
        Self { enter: End { t: -S::FAR, face: 0 }, exit: End { t: S::FAR, face: 0 } }
    }

    /// An interval between two ends on one face.
    #[inline]
    pub(crate) fn of_face(face: u16, enter: S, exit: S) -> Self {
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

    /// It holds at least one point.
    #[inline]
    pub(crate) fn is_open(&self) -> bool {
        self.enter.t < self.exit.t
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
    pub face: u16,
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
/// the result at `from` and gives its length.
///
/// Boundaries of the two lists that `coincide` are passed in one transition, and the left
/// one stands for both; so touching solids join without a seam, and a hole that ends flush
/// with a face leaves no lid.
pub(crate) fn merge<S: Scalar>(
    buffer: &mut [Boundary<S>],
    [from, middle, to]: [usize; 3],
    operator: Operator,
    mut states: [bool; 2],
    coincide: impl Fn(&Boundary<S>, &Boundary<S>) -> bool,
) -> usize {
    let (mut left, mut right, mut out) = (from, middle, to);
    let mut inside = operator.combine(states[0], states[1]);
    loop {
        let a = buffer.get(left).filter(|_| left < middle).copied();
        let b = buffer.get(right).filter(|_| right < to).copied();
        let (source, pair) = match (a, b) {
            (None, None) => break,
            (Some(a), None) => (a, [Some(a), None]),
            (None, Some(b)) => (b, [None, Some(b)]),
            (Some(a), Some(b)) if a.t == b.t || coincide(&a, &b) => (a, [Some(a), Some(b)]),
            (Some(a), Some(b)) if a.t < b.t => (a, [Some(a), None]),
            (Some(_), Some(b)) => (b, [None, Some(b)]),
        };
        left += usize::from(pair[0].is_some());
        right += usize::from(pair[1].is_some());
        let mut touch = None;
        for (state, boundary) in states.iter_mut().zip(pair) {
            match boundary.map(|b| b.passage) {
                Some(Passage::Enter) => *state = true,
                Some(Passage::Leave) => *state = false,
                Some(Passage::Touch) => touch = touch.or(boundary),
                None => {}
            }
        }
        let now = operator.combine(states[0], states[1]);
        let emitted = if now != inside {
            Some(source_of_change(source, pair).turned(if now {
                Passage::Enter
            } else {
                Passage::Leave
            }))
        } else if now {
            None
        } else {
            touch
        };
        inside = now;
        if let (Some(boundary), Some(slot)) = (emitted, buffer.get_mut(out)) {
            *slot = boundary;
            out += 1;
        }
    }
    let length = out - to;
    if from != to {
        buffer.copy_within(to..out, from);
    }
    length
}

/// The surface that stands for a change of membership: not an open one where a closed one is at hand.
fn source_of_change<S: Scalar>(source: Boundary<S>, pair: [Option<Boundary<S>>; 2]) -> Boundary<S> {
    let closed = |b: &Boundary<S>| b.passage != Passage::Touch;
    pair.into_iter().flatten().find(closed).unwrap_or(source)
}

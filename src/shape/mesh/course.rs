//! What a ray meets of a mesh, in order: its boundaries one after the other, without a list.

use super::Mesh;
use super::batch::{Batch, Group};
use super::view::{Crossing, View};
use crate::scalar::{Real, Scalar, Vector};
use crate::shape::{Sight, triangle};
use crate::span::{End, Passage, Span};

/// No triangle.
const NONE: u32 = u32::MAX;

/// How a ray starts on the mesh.
#[derive(Clone, Copy)]
struct Departure<S: Scalar> {
    face: u32,
    inward: bool,
    /// A corner of the face, its normal on the side to which the ray goes, and how far beside the
    /// plane what lies in it may seem to be.
    corner: S::Vec3,
    normal: S::WideVec,
    within: S::Wide,
    /// A crossing ahead that does not seem to be one.
    extra: Option<Crossing<S>>,
    /// A triangle that only seems to be met ahead.
    dropped: u32,
}

/// A place between boundaries.
#[derive(Clone, Copy)]
struct State<S> {
    /// Everything up to here is behind, this included.
    at: S,
    /// An odd number of triangles is behind.
    odd: bool,
    /// The mesh is as thin as one step here; where it ends.
    thin: Option<u32>,
}

impl<S> State<S> {
    fn is_inside(&self) -> bool {
        self.odd || self.thin.is_some()
    }
}

/// A ray's way through a mesh.
pub(super) struct Course<'a, S: Scalar> {
    view: View<'a, S>,
    start: Option<Departure<S>>,
    closed: bool,
    /// What is met first, as far as it is known.
    ahead: Batch<S>,
}

impl<'a, S: Scalar> Course<'a, S> {
    /// For all boundaries of a part of the ray.
    pub(super) fn listing(mesh: &Mesh, sight: &Sight<'a, S>) -> Option<Self> {
        Self::new(mesh, sight, Batch::roomy())
    }

    /// For the first boundary.
    pub(super) fn searching(mesh: &Mesh, sight: &Sight<'a, S>) -> Option<Self> {
        Self::new(mesh, sight, Batch::new(1))
    }

    #[inline]
    fn new(mesh: &Mesh, sight: &Sight<'a, S>, ahead: Batch<S>) -> Option<Self> {
        let view = View::new(mesh, sight)?;
        let mut course = Self { view, start: None, closed: mesh.closed, ahead };
        if let Some(start) = sight.start {
            course.depart(start.face, start.inward)?;
        }
        Some(course)
    }

    /// Makes the ray start in a face. Its plane is known, so what lies in it or on the side that the ray
    /// leaves is never met.
    ///
    /// Of a closed mesh the number of triangles ahead is known to be odd or even. If it is not, rounding took
    /// the place where one is met for one on the other side of the start: that next to the start.
    /// Only if the face itself says otherwise than whoever sent the ray, which goes along it then, no
    /// other triangle can tell.
    #[inline(never)]
    fn depart(&mut self, face: u32, inward: bool) -> Option<()> {
        let corners = self.view.corners(face)?;
        let normal = triangle::normal(corners.map(S::widen_vec)).normalize();
        let start = Departure {
            face,
            inward,
            corner: corners[0],
            normal: if inward { -normal } else { normal },
            within: self.view.rounding() * S::Wide::from_i32(8),
            extra: None,
            dropped: NONE,
        };
        let met = self.view.settle(face);
        self.start = Some(start);
        if !self.closed {
            return Some(());
        }
        let (mut odd, mut first, mut hidden) = (false, None, None);
        let mut ahead = self.ahead;
        self.view.each([S::ZERO, S::FAR], |crossing| {
            if crossing.face == face {
            } else if self.hides(&start, crossing.face) {
                nearer(&mut hidden, crossing);
            } else {
                odd = !odd;
                nearer(&mut first, crossing);
                ahead.take(crossing);
            }
            S::FAR
        });
        if odd == inward {
            ahead.finish();
            self.ahead = ahead;
            return Some(());
        }
        let here = Crossing { t: S::TINY, face, inward: !inward };
        let (extra, dropped) = if met == Some(inward) {
            let mut behind = None;
            self.view.each([-S::FAR, S::ZERO], |crossing| {
                if crossing.face != face {
                    nearer(&mut behind, crossing);
                }
                S::ZERO
            });
            let distance = |crossing: Option<Crossing<S>>| crossing.map_or(S::FAR, |c| c.t.abs());
            let (before, after) = (distance(first), distance(behind).min(distance(hidden)));
            if before < after {
                (None, first)
            } else if distance(hidden) <= distance(behind) {
                (hidden, None)
            } else {
                (behind.map(|crossing| Crossing { t: S::TINY, ..crossing }), None)
            }
        } else {
            (None, first.filter(|_| !inward))
        };
        // Where there is nothing else, the ray leaves through the face that it starts in.
        let lost = inward && extra.is_none() && dropped.is_none();
        self.start = Some(Departure {
            extra: if lost { Some(here) } else { extra },
            dropped: dropped.map_or(NONE, |crossing| crossing.face),
            ..start
        });
        Some(())
    }

    /// The triangle lies in the plane of the start, or beyond it as the ray goes.
    fn hides(&self, start: &Departure<S>, face: u32) -> bool {
        self.view.corners(face).is_some_and(|corners| {
            corners.iter().all(|&corner| {
                S::widen_vec(corner - start.corner).dot(start.normal) <= start.within
            })
        })
    }

    /// Gives each crossing of the mesh with low < t ≤ high, as [`View::each`] does.
    #[inline]
    fn each(&self, [low, high]: [S; 2], mut on: impl FnMut(Crossing<S>) -> S) {
        let Some(start) = &self.start else {
            return self.view.each([low, high], on);
        };
        let mut high = high;
        if let Some(extra) = start.extra.filter(|extra| low < extra.t && extra.t <= high) {
            high = high.min(on(extra));
        }
        self.view.each([low.max(S::ZERO), high], |crossing| {
            let face = crossing.face;
            if face != start.face && face != start.dropped && !self.hides(start, face) {
                high = high.min(on(crossing));
            }
            high
        });
    }

    /// What is met first with low < t ≤ high; goes through the hierarchy where it is not known.
    fn next(&mut self, [low, high]: [S; 2]) -> Option<Group<S>> {
        if let Some(group) = self.ahead.after(low) {
            return Some(group).filter(|group| group.t <= high);
        }
        if self.ahead.has_more() {
            let mut ahead = self.ahead;
            ahead.clear();
            self.each([low, high], |crossing| ahead.take(crossing).unwrap_or(high));
            ahead.finish();
            self.ahead = ahead;
        }
        self.ahead.after(low)
    }

    /// How it stands at a place of the ray.
    fn state(&self, at: S) -> State<S> {
        let odd = self.start.is_some_and(|start| start.inward);
        if at <= if self.start.is_some() { S::ZERO } else { -S::FAR } {
            return State { at, odd, thin: None };
        }
        let (mut odd, mut here) = (odd, None::<Group<S>>);
        self.each([-S::FAR, at], |crossing| {
            if crossing.t < at {
                odd = !odd;
            } else if let Some(group) = &mut here {
                group.join(crossing);
            } else {
                here = Some(Group::of(crossing));
            }
            at
        });
        match here {
            Some(group) if group.even => {
                State { at, odd, thin: (!odd).then(|| group.face(Passage::Leave)) }
            }
            Some(_) => State { at, odd: !odd, thin: None },
            None => State { at, odd, thin: None },
        }
    }

    /// The next boundary of a closed mesh with t ≤ high, and how it stands there.
    ///
    /// Where an even number of triangles is met at one place, the mesh ends as it begins: seen from within
    /// that is nothing, seen from outside it is one step thick, so that what is thin does not vanish far away.
    fn advance(&mut self, state: &mut State<S>, high: S) -> Option<(End<S>, Passage)> {
        loop {
            let group = self.next([state.at, high]);
            if let Some(face) = state.thin.take() {
                let end = state.at.next_up();
                if !group.is_some_and(|group| group.t <= end) {
                    state.at = end;
                    return Some((End { t: end, face }, Passage::Leave));
                }
                // It goes on without a gap.
                let group = group?;
                state.at = group.t;
                state.odd = !group.even;
                state.thin = group.even.then(|| group.face(Passage::Leave));
                continue;
            }
            let group = group?;
            state.at = group.t;
            match (state.odd, group.even) {
                (true, true) => {}
                (true, false) => {
                    state.odd = false;
                    return Some(group.end(Passage::Leave));
                }
                (false, even) => {
                    state.odd = !even;
                    state.thin = even.then(|| group.face(Passage::Leave));
                    return Some(group.end(Passage::Enter));
                }
            }
        }
    }

    /// Gives the spans of a closed mesh, or the places of an open one, that have to do with a part of the ray.
    pub(super) fn spans(mut self, [low, high]: [S; 2], mut emit: impl FnMut(Span<S>)) {
        if !self.closed {
            let mut at = low;
            while let Some(group) = self.next([at, high]) {
                at = group.t;
                emit(Span::of_face(group.face(Passage::Touch), at, at));
            }
            return;
        }
        let mut state = self.state(if self.start.is_some() { low.max(S::ZERO) } else { low });
        let face = self.start.map_or(0, |start| start.face);
        let mut enter = state.is_inside().then_some(End { t: state.at, face });
        while let Some((end, passage)) = self.advance(&mut state, high) {
            match (passage, enter) {
                (Passage::Leave, Some(enter)) => emit(Span { enter, exit: end }),
                _ => enter = Some(end),
            }
        }
        if let Some(enter) = enter.filter(|_| state.is_inside()) {
            emit(Span { enter, exit: End { t: S::FAR, face } });
        }
    }

    /// Whether the start of a part of the ray is inside, and the first boundary between its ends.
    pub(super) fn first(mut self, [after, before]: [S; 2]) -> (bool, Option<(End<S>, Passage)>) {
        let (inside, first) = if self.closed {
            let mut state = self.state(after);
            (state.is_inside(), self.advance(&mut state, before))
        } else {
            let group = self.next([after, before]);
            (false, group.map(|group| group.end(Passage::Touch)))
        };
        (inside, first.filter(|(end, _)| end.t < before))
    }
}

/// Keeps the crossing that is nearer to the start, of equally near ones the first.
fn nearer<S: Scalar>(nearest: &mut Option<Crossing<S>>, crossing: Crossing<S>) {
    let key = |crossing: &Crossing<S>| (crossing.t.abs(), crossing.face);
    if !nearest.as_ref().is_some_and(|nearest| key(nearest) < key(&crossing)) {
        *nearest = Some(crossing);
    }
}

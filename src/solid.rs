//! Solids: trees of leaves and operators in one flat array, evaluated by one loop.
//!
//! A tree is written in prefix order: an operator, then its operands one after another. An
//! operator knows how many nodes it spans, so what cannot matter is skipped in one step: an
//! empty left operand ends an intersection or a difference, and every further operand is
//! only looked at where the ones before it left something.

use crate::needs::{self, has};
use crate::place::{Placement, apply};
use crate::ray::{Line, Start};
use crate::scalar::{Number, Real, Scalar, Vector};
use crate::shape::{Shape, Sight, Tables};
use crate::span::{Boundary, End, Operator, Passage, Spans, drop_slivers, is_neutral, merge};

#[cfg(test)]
mod twin;

/// How deep operators may be nested.
pub const NESTING_MAX: usize = 16;

/// A shape with its material and its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leaf<S: Scalar> {
    /// The shape, in the scene's coordinates or in those of the placement.
    pub shape: Shape<S>,
    /// The material of its surface, also where it cuts another solid.
    pub material: u16,
    /// Its placement, as an index into the scene's.
    pub placement: Option<u16>,
}

/// A node of a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Node<S: Scalar> {
    /// One shape.
    Leaf(Leaf<S>),
    /// The solids that follow, combined.
    Operator {
        /// How.
        operator: Operator,
        /// How many nodes the operator spans, itself included.
        size: u32,
    },
}

/// A point of a leaf's surface.
#[derive(Clone, Copy, Debug)]
pub struct Contact<S: Scalar> {
    /// The point in the leaf's own coordinates.
    pub local: S::Vec3,
    /// The point in the scene.
    pub position: S::Vec3,
    /// The unit normal, outward of the leaf.
    pub normal: S::Dir,
}

/// The tables that intersection needs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Geometry<'a, S: Scalar, const NEEDS: u64 = { needs::ALL }> {
    pub(crate) nodes: &'a [Node<S>],
    pub(crate) placements: &'a [Placement<S>],
    pub(crate) tables: &'a Tables<'a, S>,
}

/// An operator whose operands are being evaluated.
#[derive(Clone, Copy)]
struct Frame {
    operator: Operator,
    /// The node after its last operand.
    end: usize,
    /// Where its result begins in the buffer.
    base: usize,
    /// What the operands so far make: inside at the start, and how many boundaries.
    result: Option<(bool, usize)>,
}

impl Frame {
    const VACANT: Self = Self { operator: Operator::Union, end: 0, base: 0, result: None };
}

impl<'a, S: Scalar, const NEEDS: u64> Geometry<'a, S, NEEDS> {
    #[inline]
    pub(crate) fn leaf(&self, node: u32) -> Option<&'a Leaf<S>> {
        match self.nodes.get(node as usize) {
            Some(Node::Leaf(leaf)) => Some(leaf),
            _ => None,
        }
    }

    #[inline]
    pub(crate) fn placement(&self, leaf: &Leaf<S>) -> Option<&'a Placement<S>> {
        if !has(NEEDS, needs::PLACEMENTS) {
            return None;
        }
        leaf.placement.and_then(|index| self.placements.get(usize::from(index)))
    }

    /// A ray as the leaf at `node` sees it.
    #[inline]
    pub(crate) fn sight<'l>(&self, node: u32, leaf: &Leaf<S>, line: &'l Line<S>) -> Sight<'l, S>
    where
        'a: 'l,
    {
        Sight {
            line,
            place: self.placement(leaf),
            start: line.start.as_ref().filter(|start| start.node == node),
            tables: self.tables,
        }
    }

    /// The point of a ray at `t`, in the coordinates of a leaf.
    #[inline]
    fn local_at(&self, line: &Line<S>, leaf: &Leaf<S>, t: S) -> S::WideVec {
        match self.placement(leaf) {
            None => line.recentred(leaf.shape.centre(), t),
            Some(place) => apply::<S>(&place.to_local, line.recentred(place.anchor, t)),
        }
    }

    /// The point where a ray meets a face of a leaf, drawn onto the surface.
    pub(crate) fn contact(&self, line: &Line<S>, leaf: &Leaf<S>, end: End<S>) -> Contact<S> {
        let shape = &leaf.shape;
        let local =
            shape.snap_for::<NEEDS>(self.local_at(line, leaf, end.t), end.face, self.tables);
        let normal = shape.normal_for::<NEEDS>(local, end.face, self.tables);
        let (position, normal) = match self.placement(leaf) {
            None => (local + shape.centre(), normal),
            Some(place) => (place.point(local), place.normal(normal)),
        };
        Contact { local, position, normal: S::unit(normal) }
    }

    /// How far rounding may move the surface of a leaf along its normal, and how fast a ray goes
    /// that way; at a point of a face in the leaf's own coordinates.
    ///
    /// The place is rounded when it is given, when it is moved and when it is stored, at ½ each; the way
    /// to the point goes through the entries of the placement, their products and sums, at less than 4.
    fn uncertainty(
        &self,
        line: &Line<S>,
        leaf: &Leaf<S>,
        local: S::Vec3,
        face: u32,
    ) -> [S::Wide; 2] {
        let magnitude = |v: S::WideVec| v.map(Number::abs);
        let rounding = |v: S::WideVec| magnitude(v).map(S::rounding);
        let reach = |from: S::WideVec, place: S::Vec3| {
            rounding(from) * S::Wide::from_i32(4) + rounding(S::widen_vec(place)) * S::Wide::TWO
        };
        let local_wide = S::widen_vec(local);
        let normal = leaf.shape.normal_for::<NEEDS>(local, face, self.tables);
        let Some(place) = self.placement(leaf) else {
            let normal = normal.normalize();
            let moved = magnitude(normal).dot(reach(local_wide, leaf.shape.centre()));
            return [moved, normal.dot(line.heading()).abs()];
        };
        let across = place.normal(normal);
        let inverse = S::Wide::ONE / across.length();
        let reach = reach(apply::<S>(&place.to_world, local_wide), place.anchor);
        let moved = magnitude(normal).dot(apply::<S>(&place.to_local.map(magnitude), reach));
        [moved * inverse, across.dot(line.heading()).abs() * inverse]
    }

    /// How far rounding may have moved a boundary along the ray: its share of t, and what the
    /// uncertain place of the surface makes of it at this angle.
    fn slack(&self, line: &Line<S>, boundary: &Boundary<S>) -> S::Wide {
        let Some(leaf) = self.leaf(boundary.node) else {
            return S::Wide::ZERO;
        };
        let local = leaf.shape.snap_for::<NEEDS>(
            self.local_at(line, leaf, boundary.t),
            boundary.face,
            self.tables,
        );
        let [moved, speed] = self.uncertainty(line, leaf, local, boundary.face);
        let speed = speed.max(least_speed(line));
        S::rounding(boundary.t.abs().widen()) * S::Wide::TWO + moved / speed
    }

    /// Two boundaries of different leaves cannot be told apart at this precision.
    fn coincide(&self, line: &Line<S>, a: &Boundary<S>, b: &Boundary<S>) -> bool {
        let gap = (a.t - b.t).abs();
        if !(gap <= tie_max(line, a.t.abs().max(b.t.abs()))) {
            return false;
        }
        gap == S::ZERO || gap.widen() <= self.slack(line, a) + self.slack(line, b)
    }

    /// The boundary of a leaf right at the start of a ray that begins on another leaf of the
    /// same solid: rounding put it before or behind, and it counts as met at the start.
    fn at_start(&self, line: &Line<S>, start: &Start<S>, leaf: &Leaf<S>, end: End<S>) -> bool {
        if !(end.t.abs() <= tie_max(line, end.t.abs())) {
            return false;
        }
        let Some(origin) = self.leaf(start.node) else {
            return false;
        };
        let near = match self.placement(leaf) {
            None => S::widen_vec(line.origin) - S::widen_vec(leaf.shape.centre()),
            Some(place) => place.local(line.origin),
        };
        let local = leaf.shape.snap_for::<NEEDS>(near, end.face, self.tables);
        let [moved, speed] = self.uncertainty(line, leaf, local, end.face);
        let [start_moved, _] = self.uncertainty(line, origin, start.local, start.face);
        let speed = speed.max(least_speed(line));
        end.t.abs().widen() * speed <= moved + start_moved
    }

    /// Writes the boundaries of one leaf within the window from `top` on; inside at the start
    /// of the window, and how many.
    fn leaf_boundaries(
        &self,
        (node, leaf): (u32, &Leaf<S>),
        (line, start): (&Line<S>, Option<&Start<S>>),
        [low, high]: [S; 2],
        buffer: &mut [Boundary<S>],
        top: usize,
    ) -> (bool, usize) {
        let (mut inside, mut len) = (false, 0_usize);
        let sight = self.sight(node, leaf, line);
        let settle = start.filter(|start| start.node != node);
        let open = leaf.shape.is_open();
        leaf.shape.spans_within::<NEEDS>(&sight, [low, high], |mut span| {
            for end in [&mut span.enter, &mut span.exit] {
                if settle.is_some_and(|start| self.at_start(line, start, leaf, *end)) {
                    end.t = S::ZERO;
                }
            }
            let mut push = |end: End<S>, passage: Passage| {
                if !(end.t > low && end.t <= high && end.t < S::FAR) {
                    return;
                }
                let last = len.checked_sub(1).and_then(|last| buffer.get(top + last));
                if last.is_some_and(|last| !(last.t < end.t)) {
                    // A span or a gap without a point.
                    len -= 1;
                } else if let Some(slot) = buffer.get_mut(top + len) {
                    let End { t, face } = end;
                    *slot = Boundary { t, node, face, passage, inverted: false };
                    len += 1;
                }
            };
            if open {
                push(span.enter, Passage::Touch);
            } else {
                inside |= span.enter.t <= low && low < span.exit.t;
                push(span.enter, Passage::Enter);
                push(span.exit, Passage::Leave);
            }
        });
        (inside, len)
    }

    /// The boundaries of the solid that starts at node `first`, for t > 0.
    ///
    /// The set operations are exact on the boundaries as the leaves give them; what an empty
    /// operand settles is skipped. Last, what only rounding tells apart is joined.
    ///
    /// The buffer must have the room that [`Scene::limits`](crate::scene::Scene::limits) tells.
    pub(crate) fn evaluate<'b>(
        &self,
        first: u32,
        count: u32,
        line: &Line<S>,
        buffer: &'b mut [Boundary<S>],
        mut on_leaf: impl FnMut(),
    ) -> Spans<'b, S> {
        let own = |start: &&Start<S>| start.node >= first && start.node - first < count;
        let start = line.start.as_ref().filter(own);
        let mut frames = [Frame::VACANT; NESTING_MAX];
        let (mut depth, mut top, mut window) = (0, 0, [S::ZERO, S::FAR]);
        let mut index = first as usize;
        loop {
            let mut value = match self.nodes.get(index) {
                Some(&Node::Operator { operator, size }) => {
                    // A complement is everything but its operand.
                    let result = (operator == Operator::Complement).then_some((true, 0));
                    let end = index + size as usize;
                    if let Some(frame) = frames.get_mut(depth) {
                        *frame = Frame { operator, end, base: top, result };
                    }
                    depth += 1;
                    index += 1;
                    window = [S::ZERO, S::FAR];
                    continue;
                }
                Some(Node::Leaf(leaf)) => {
                    on_leaf();
                    let node = index as u32;
                    index += 1;
                    self.leaf_boundaries((node, leaf), (line, start), window, buffer, top)
                }
                None => (false, 0),
            };
            // The value is an operand of the innermost open operator.
            loop {
                let Some(frame) = depth.checked_sub(1).and_then(|d| frames.get_mut(d)) else {
                    let (inside, len) = value;
                    let made = buffer.get_mut(..len).unwrap_or(&mut []);
                    let len = drop_slivers(made, |a, b| self.coincide(line, a, b));
                    return Spans { inside, boundaries: buffer.get(..len).unwrap_or(&[]) };
                };
                let result = match frame.result {
                    None => value,
                    Some(left) => self.join(frame, left, value, line, buffer),
                };
                frame.result = Some(result);
                let (inside, len) = result;
                if index < frame.end && !(len == 0 && frame.operator.settled(inside)) {
                    top = frame.base + len;
                    let made = buffer.get(frame.base..top).unwrap_or(&[]);
                    window = support(frame.operator, inside, made);
                    break;
                }
                index = frame.end;
                depth -= 1;
                value = result;
            }
        }
    }

    /// Combines two neighbouring lists from the base of a frame on, each with its state at the start.
    #[inline]
    fn join(
        &self,
        frame: &Frame,
        (left, left_len): (bool, usize),
        (right, right_len): (bool, usize),
        line: &Line<S>,
        buffer: &mut [Boundary<S>],
    ) -> (bool, usize) {
        let inside = frame.operator.combine(left, right);
        if is_neutral(frame.operator, [left_len, right_len], [left, right]) {
            return (inside, left_len + right_len);
        }
        let middle = frame.base + left_len;
        let ends = [frame.base, middle, middle + right_len];
        let tie = |a: &Boundary<S>, b: &Boundary<S>| self.coincide(line, a, b);
        (inside, merge(buffer, ends, frame.operator, [left, right], tie))
    }
}

/// The part of the ray where a further operand can still change the result. A boundary of
/// the operand outside of it is never one of the result, so a leaf need not give it.
fn support<S: Scalar>(operator: Operator, inside: bool, made: &[Boundary<S>]) -> [S; 2] {
    let (Operator::Intersection | Operator::Difference, Some(first), Some(last)) =
        (operator, made.first(), made.last())
    else {
        return [S::ZERO, S::FAR];
    };
    let low = if inside { S::ZERO } else { first.t };
    let high = if last.passage == Passage::Enter { S::FAR } else { last.t };
    [low, high]
}

/// How far apart along a ray two boundaries may be at most that rounding brought out of
/// step: a cheap bound, far above most slacks, that spares their computation.
#[inline]
fn tie_max<S: Scalar>(line: &Line<S>, t: S) -> S {
    let reach = t.widen() + line.origin.max_abs().widen() / line.heading().max_abs();
    S::narrow(reach * (S::EPSILON_ROOT * S::from_i32(16)).widen())
}

/// How fast a ray goes through a surface at least; at the edge of a curved one the error is a
/// square root of the rounding, not the rounding over the speed.
fn least_speed<S: Scalar>(line: &Line<S>) -> S::Wide {
    line.dd.sqrt() * S::EPSILON_ROOT.widen()
}

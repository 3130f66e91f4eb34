//! Solids: trees of leaves and operators in one flat array, evaluated by one loop.
//!
//! A tree is written in prefix order: an operator, then its operands one after another. An
//! operator knows how many nodes it spans, so what cannot matter is skipped in one step: an
//! empty left operand ends an intersection or a difference, and every further operand is
//! only looked at where the ones before it left something.

use crate::place::Placement;
use crate::ray::Line;
use crate::scalar::{Scalar, Vector};
use crate::shape::{Shape, Sight};
use crate::span::{Boundary, End, Operator, Passage, Spans, merge};

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
    pub normal: S::Vec3,
}

/// The tables that intersection needs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Geometry<'a, S: Scalar> {
    pub(crate) nodes: &'a [Node<S>],
    pub(crate) placements: &'a [Placement<S>],
    pub(crate) points: &'a [S::Vec3],
}

/// An operator whose operands are being evaluated.
#[derive(Clone, Copy)]
struct Frame<S> {
    operator: Operator,
    /// The node after its last operand.
    end: usize,
    /// Where its result begins in the buffer.
    base: usize,
    /// The part of the ray that its own result is asked for.
    window: [S; 2],
    /// What the operands so far make: inside at the start, and how many boundaries.
    result: Option<(bool, usize)>,
}

impl<'a, S: Scalar> Geometry<'a, S> {
    #[inline]
    pub(crate) fn leaf(&self, node: u32) -> Option<&'a Leaf<S>> {
        match self.nodes.get(node as usize) {
            Some(Node::Leaf(leaf)) => Some(leaf),
            _ => None,
        }
    }

    #[inline]
    pub(crate) fn placement(&self, leaf: &Leaf<S>) -> Option<&'a Placement<S>> {
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
            points: self.points,
        }
    }

    /// The point where a ray meets a face of a leaf, drawn onto the surface.
    pub(crate) fn contact(&self, line: &Line<S>, leaf: &Leaf<S>, end: End<S>) -> Contact<S> {
        let shape = &leaf.shape;
        let Some(place) = self.placement(leaf) else {
            let centre = shape.centre();
            let local = shape.snap(line.recentred(centre, end.t), end.face);
            let normal = shape.normal(local, end.face, self.points).normalize();
            return Contact { local, position: local + centre, normal };
        };
        let near = crate::place::apply::<S>(&place.to_local, line.recentred(place.anchor, end.t));
        let local = shape.snap(near, end.face);
        let normal = place.normal(shape.normal(local, end.face, self.points)).normalize();
        Contact { local, position: place.point(local), normal }
    }

    /// How far rounding may have moved a boundary along the ray: its share of t, and what an
    /// error in the position of the surface makes of it at this angle.
    fn slack(&self, line: &Line<S>, node: u32, end: End<S>) -> S {
        let Some(leaf) = self.leaf(node) else {
            return S::ZERO;
        };
        let contact = self.contact(line, leaf, end);
        let bounds = leaf.shape.bounds(self.placement(leaf), self.points);
        let size = if bounds.is_finite() {
            bounds.min.max_abs().max(bounds.max.max_abs())
        } else {
            contact.position.max_abs()
        };
        let scale = size.max(line.origin.max_abs());
        let least = S::EPSILON_ROOT * line.dd.sqrt();
        let speed = contact.normal.dot(line.dir).abs().max(least);
        (end.t.abs() * S::from_i32(4) + scale * S::from_i32(8) / speed) * S::EPSILON
    }

    /// Two boundaries of different leaves cannot be told apart at this precision.
    fn coincide(&self, line: &Line<S>, a: &Boundary<S>, b: &Boundary<S>) -> bool {
        let gap = (a.t - b.t).abs();
        let reach = a.t.abs() + line.origin.max_abs();
        if !(gap <= reach * S::EPSILON_ROOT * S::from_i32(16)) {
            return false;
        }
        let slack = |x: &Boundary<S>| self.slack(line, x.node, End { t: x.t, face: x.face });
        gap <= slack(a) + slack(b)
    }

    /// The boundary of a leaf right at the start of a ray that begins on another leaf of the
    /// same solid: rounding put it before or behind, and it counts as met at the start.
    fn at_start(&self, line: &Line<S>, node: u32, end: End<S>) -> bool {
        let reach = line.origin.max_abs() * S::EPSILON_ROOT * S::from_i32(16);
        end.t.abs() <= reach && end.t.abs() <= self.slack(line, node, end) * S::TWO
    }

    /// Writes the boundaries of one leaf within the window from `top` on; inside at the start
    /// of the window, and how many.
    fn leaf_boundaries(
        &self,
        node: u32,
        leaf: &Leaf<S>,
        (line, own_start): (&Line<S>, bool),
        window: [S; 2],
        buffer: &mut [Boundary<S>],
        top: usize,
    ) -> (bool, usize) {
        let (mut inside, mut len) = (false, 0);
        let sight = self.sight(node, leaf, line);
        let settle = own_start && sight.start.is_none();
        let [low, high] = window;
        leaf.shape.spans(&sight, |mut span| {
            let open = leaf.shape.is_open();
            if settle {
                for end in [&mut span.enter, &mut span.exit] {
                    if self.at_start(line, node, *end) {
                        end.t = S::ZERO;
                    }
                }
            }
            let mut push = |end: End<S>, passage: Passage| {
                if end.t > low && end.t <= high && end.t < S::FAR {
                    if let Some(slot) = buffer.get_mut(top + len) {
                        *slot =
                            Boundary { t: end.t, node, face: end.face, passage, inverted: false };
                        len += 1;
                    }
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
    /// The buffer must have the room that [`Scene::limits`](crate::scene::Scene::limits) tells.
    pub(crate) fn evaluate<'b>(
        &self,
        first: u32,
        count: u32,
        line: &Line<S>,
        buffer: &'b mut [Boundary<S>],
        mut on_leaf: impl FnMut(),
    ) -> Spans<'b, S> {
        let own_start = line.start.is_some_and(|s| s.node >= first && s.node - first < count);
        let vacant = Frame {
            operator: Operator::Union,
            end: 0,
            base: 0,
            window: [S::ZERO; 2],
            result: None,
        };
        let mut frames = [vacant; NESTING_MAX];
        let (mut depth, mut top, mut window) = (0, 0, [S::ZERO, S::FAR]);
        let mut index = first as usize;
        loop {
            let mut value = match self.nodes.get(index) {
                Some(&Node::Operator { operator, size }) => {
                    // A complement is everything but its operand.
                    let result = (operator == Operator::Complement).then_some((true, 0));
                    let end = index + size as usize;
                    if let Some(frame) = frames.get_mut(depth) {
                        *frame = Frame { operator, end, base: top, window, result };
                    }
                    depth += 1;
                    index += 1;
                    continue;
                }
                Some(Node::Leaf(leaf)) => {
                    on_leaf();
                    let node = index as u32;
                    index += 1;
                    self.leaf_boundaries(node, leaf, (line, own_start), window, buffer, top)
                }
                None => (false, 0),
            };
            // The value is an operand of the innermost open operator.
            loop {
                let Some(frame) = depth.checked_sub(1).and_then(|d| frames.get_mut(d)) else {
                    let (inside, len) = value;
                    return Spans { inside, boundaries: buffer.get(..len).unwrap_or(&[]) };
                };
                let result = match frame.result {
                    None => value,
                    Some((inside, len)) => {
                        let ends = [frame.base, frame.base + len, frame.base + len + value.1];
                        let states = [inside, value.0];
                        let merged = merge(buffer, ends, frame.operator, states, |a, b| {
                            self.coincide(line, a, b)
                        });
                        (frame.operator.combine(inside, value.0), merged)
                    }
                };
                frame.result = Some(result);
                let (inside, len) = result;
                if index < frame.end && !(len == 0 && frame.operator.settled(inside)) {
                    top = frame.base + len;
                    let made = buffer.get(frame.base..top).unwrap_or(&[]);
                    window = narrowed(frame.operator, frame.window, inside, made);
                    break;
                }
                index = frame.end;
                depth -= 1;
                value = result;
            }
        }
    }
}

/// The part of the window where a further operand can still change the result.
fn narrowed<S: Scalar>(
    operator: Operator,
    [low, high]: [S; 2],
    inside: bool,
    made: &[Boundary<S>],
) -> [S; 2] {
    let (Operator::Intersection | Operator::Difference, Some(first), Some(last)) =
        (operator, made.first(), made.last())
    else {
        return [low, high];
    };
    let low = if inside { low } else { first.t };
    let high = if last.passage == Passage::Enter { high } else { last.t };
    [low, high]
}

//! Boxes in boxes over many small things: a flat hierarchy, walked without a stack.
//!
//! The nodes lie in the order of a walk in depth: the first child of a node is the next one, the
//! second is told, and so is the way back up. Nothing here knows what the entries are; a walk
//! asks its visitor about boxes, and gives it the entries of the leaves that it comes to.

mod build;

pub(crate) use build::{Entries, branches_of, build};

use core::ops::ControlFlow;

use crate::bounds::Bounds;
use crate::scalar::{Axis, Scalar, Vector};

/// A node of a hierarchy. All indices count from its root.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Branch<S: Scalar> {
    /// A box around all that is below.
    pub bounds: Bounds<S>,
    /// The first entry of a leaf; of another node the second child, the first being the next node.
    pub first: u32,
    /// The node above; the root names itself.
    pub up: u32,
    /// How many entries follow one another in a leaf; 0 for a node with children.
    pub count: u16,
    /// Where the children lie one after the other.
    pub axis: Axis,
}

impl<S: Scalar> Branch<S> {
    /// What fills a table before a hierarchy is built in it.
    pub const fn vacant() -> Self {
        let bounds = Bounds { min: S::Vec3::ZERO, max: S::Vec3::ZERO };
        Self { bounds, first: 0, up: 0, count: 0, axis: Axis::X }
    }

    /// The children of the node at `index`, the one that a ray comes to first in front.
    #[inline]
    fn children(&self, index: u32, backward: [bool; 3]) -> [u32; 2] {
        let [x, y, z] = backward;
        let turned = match self.axis {
            Axis::X => x,
            Axis::Y => y,
            Axis::Z => z,
        };
        if turned { [self.first, index + 1] } else { [index + 1, self.first] }
    }
}

/// Who walks through a hierarchy, and knows what its entries are.
pub(crate) trait Visit<S: Scalar> {
    /// Something in the box may be of interest.
    fn wants(&mut self, bounds: &Bounds<S>) -> bool;
    /// Looks at the entries of a leaf; a break ends the walk.
    fn entries(&mut self, first: u32, count: u32) -> ControlFlow<()>;
}

/// Walks through a hierarchy that [`check`] has passed, first to what a ray whose direction is
/// `backward` along some axes comes to first. Goes down to every node at most once, and up from it
/// once.
///
/// Source: M. Hapala, T. Davidovič, I. Wald, V. Havran and P. Slusallek, "Efficient Stack-less
/// BVH Traversal for Ray Tracing" (2011).
#[inline]
pub(crate) fn walk<S: Scalar>(
    branches: &[Branch<S>],
    backward: [bool; 3],
    visitor: &mut impl Visit<S>,
) {
    let mut index = 0;
    loop {
        let Some(mut branch) = branches.get(index as usize) else {
            return;
        };
        if visitor.wants(&branch.bounds) {
            if branch.count == 0 {
                [index, _] = branch.children(index, backward);
                continue;
            }
            if visitor.entries(branch.first, branch.count.into()).is_break() {
                return;
            }
        }
        // Up to the first node whose other child still waits.
        loop {
            let Some(above) = branches.get(branch.up as usize).filter(|_| index != 0) else {
                return;
            };
            let [near, far] = above.children(branch.up, backward);
            if index == near {
                index = far;
                break;
            }
            (index, branch) = (branch.up, above);
        }
    }
}

/// Checks that nodes are one tree over the entries `0..count`, in order, and that every box holds
/// what is below it: the children's boxes, or those that `bounds` gives for entries.
///
/// # Errors
/// The first node that does not.
pub(crate) fn check<S: Scalar>(
    branches: &[Branch<S>],
    count: u32,
    bounds: impl Fn(u32) -> Bounds<S>,
) -> Result<(), u32> {
    let mut next = 0_u32;
    for (index, branch) in (0..).zip(branches) {
        let above = branches.get(branch.up as usize).filter(|above| above.count == 0);
        let hangs = if index == 0 {
            branch.up == 0
        } else {
            branch.up < index
                && above.is_some_and(|above| index == branch.up + 1 || index == above.first)
        };
        let holds = |other: &Bounds<S>| branch.bounds.union(other) == branch.bounds;
        let legal = if branch.count == 0 {
            let child = |child: u32| {
                let child = branches.get(child as usize).filter(|child| child.up == index);
                child.is_some_and(|child| holds(&child.bounds))
            };
            branch.first > index + 1 && child(index + 1) && child(branch.first)
        } else {
            let first = next;
            next = next.saturating_add(branch.count.into());
            branch.first == first && next <= count && (first..next).all(|i| holds(&bounds(i)))
        };
        if !(hangs && legal && branch.bounds.is_finite()) {
            return Err(index);
        }
    }
    if next == count && count > 0 { Ok(()) } else { Err(branches.len() as u32) }
}

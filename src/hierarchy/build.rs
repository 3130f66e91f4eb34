//! How a hierarchy is built: from the top down, by what a ray is likely to meet.

use super::Branch;
use crate::bounds::Bounds;
use crate::scalar::{Axis, Number, Real, Scalar, Vector};

/// The most entries of a leaf.
const LEAF: u32 = 4;

/// The places along an axis where a node may be divided are one less than this.
const BINS: usize = 16;

/// How many times an entry may be looked at, in the mean, before nodes are halved unseen.
const EFFORT: u64 = 64;

/// Entries that can change places.
pub(crate) trait Entries<S: Scalar> {
    /// The box around an entry.
    fn bounds(&self, entry: u32) -> Bounds<S>;
    /// Exchanges two entries.
    fn swap(&mut self, a: u32, b: u32);
}

/// How many nodes a hierarchy over so many entries has.
pub(crate) const fn branches_of(entries: u32) -> u32 {
    (2 * entries.div_ceil(LEAF)).saturating_sub(1)
}

/// Puts entries in order and builds a hierarchy over them, in exactly [`branches_of`] nodes.
///
/// Every node that is left to be divided holds whole leaves on its first side, so the places of all nodes
/// are known beforehand, and those to come keep what is still to be done. The time grows as
/// n·log n: after [`EFFORT`] divisions for each entry, in the mean, the rest is halved in the order that it has.
///
/// Source: I. Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies" (2007).
#[inline(never)]
pub(crate) fn build<S: Scalar>(
    entries: &mut impl Entries<S>,
    count: u32,
    branches: &mut [Branch<S>],
) {
    let mut effort = u64::from(count) * EFFORT;
    // Until its turn comes, a node keeps where its entries end as the node above.
    let waiting = |first: u32, end: u32| Branch { first, up: end, ..Branch::vacant() };
    put(branches, 0, waiting(0, count));
    for index in 0..branches_of(count) {
        let Some(branch) = branches.get_mut(index as usize) else {
            return;
        };
        let (first, end) = (branch.first, branch.up);
        if end - first <= LEAF {
            branch.count = (end - first) as u16;
            branch.bounds = (first..end)
                .fold(Bounds::nothing(), |all, entry| all.union(&entries.bounds(entry)));
            continue;
        }
        let (axis, middle) = divide(entries, [first, end], &mut effort);
        let second = index + 2 * ((middle - first) / LEAF);
        (branch.first, branch.axis) = (second, axis);
        put(branches, index + 1, waiting(first, middle));
        put(branches, second, waiting(middle, end));
    }
    join(branches);
}

fn put<S: Scalar>(branches: &mut [Branch<S>], index: u32, branch: Branch<S>) {
    if let Some(slot) = branches.get_mut(index as usize) {
        *slot = branch;
    }
}

/// Gives nodes with children their boxes, from the last to the first, and children the way up.
fn join<S: Scalar>(branches: &mut [Branch<S>]) {
    for index in (0..branches.len() as u32).rev() {
        let Some(&branch) = branches.get(index as usize).filter(|branch| branch.count == 0) else {
            continue;
        };
        let mut bounds = Bounds::nothing();
        for child in [index + 1, branch.first] {
            if let Some(child) = branches.get_mut(child as usize) {
                child.up = index;
                bounds = bounds.union(&child.bounds);
            }
        }
        put(branches, index, Branch { bounds, ..branch });
    }
    if let Some(root) = branches.first_mut() {
        root.up = 0;
    }
}

/// Where entries are divided: those in the bins before `bin` go to the first side.
#[derive(Clone, Copy)]
struct Cut<S: Scalar> {
    axis: Axis,
    low: S,
    extent: S,
    bin: u8,
}

impl<S: Scalar> Cut<S> {
    /// The bin of a box, by its middle.
    fn bin_of(&self, bounds: &Bounds<S>) -> u8 {
        let share = (middle(bounds).get(self.axis) - self.low) / self.extent;
        let bin = (share * S::from_i32(BINS as i32)).floor_i64();
        bin.clamp(0, BINS as i64 - 1) as u8
    }
}

/// Twice the middle of a box.
fn middle<S: Scalar>(bounds: &Bounds<S>) -> S::Vec3 {
    bounds.min + bounds.max
}

/// Divides entries in two and tells along which axis, and where the second part begins. The first part
/// fills whole leaves.
fn divide<S: Scalar>(
    entries: &mut impl Entries<S>,
    [first, end]: [u32; 2],
    effort: &mut u64,
) -> (Axis, u32) {
    let count = end - first;
    let cut = if let Some(rest) = effort.checked_sub(count.into()) {
        *effort = rest;
        best_cut(entries, [first, end])
    } else {
        None
    };
    let Some(cut) = cut else {
        return (Axis::X, first + (count / 2).div_ceil(LEAF) * LEAF);
    };
    let mut split = first;
    for entry in first..end {
        if cut.bin_of(&entries.bounds(entry)) < cut.bin {
            entries.swap(entry, split);
            split += 1;
        }
    }
    // To the nearest whole leaf, by those that lie next to the cut: at most half a leaf of them.
    let most = (count - 1) / LEAF * LEAF;
    let goal = first + ((split - first + LEAF / 2) / LEAF * LEAF).max(LEAF).min(most);
    let key = |entries: &_, entry: u32| middle(&Entries::<S>::bounds(entries, entry)).get(cut.axis);
    while split > goal {
        split -= 1;
        let last = (first..split).fold(split, |best, entry| {
            if key(entries, entry) > key(entries, best) { entry } else { best }
        });
        entries.swap(last, split);
    }
    while split < goal {
        let next = (split..end).fold(split, |best, entry| {
            if key(entries, entry) < key(entries, best) { entry } else { best }
        });
        entries.swap(next, split);
        split += 1;
    }
    (cut.axis, split)
}

/// The cheapest cut by the surface-area heuristic, or `None` where all boxes have one middle.
fn best_cut<S: Scalar>(entries: &impl Entries<S>, [first, end]: [u32; 2]) -> Option<Cut<S>> {
    let mut middles = Bounds::<S>::nothing();
    for entry in first..end {
        let middle = middle(&entries.bounds(entry));
        middles = middles.union(&Bounds { min: middle, max: middle });
    }
    let mut best: Option<(S::Wide, Cut<S>)> = None;
    for axis in Axis::ALL {
        let (low, high) = (middles.min.get(axis), middles.max.get(axis));
        let extent = high - low;
        if !(extent > S::ZERO) {
            continue;
        }
        let found = cheapest(entries, [first, end], Cut { axis, low, extent, bin: 0 });
        best = match (best, found) {
            (Some(best), Some(found)) if best.0 <= found.0 => Some(best),
            (best, found) => found.or(best),
        };
    }
    best.map(|(_, cut)| cut)
}

/// The cheapest cut along one axis, with its cost.
fn cheapest<S: Scalar>(
    entries: &impl Entries<S>,
    [first, end]: [u32; 2],
    cut: Cut<S>,
) -> Option<(S::Wide, Cut<S>)> {
    let mut bins = [(Bounds::<S>::nothing(), 0_u32); BINS];
    for entry in first..end {
        let bounds = entries.bounds(entry);
        if let Some((all, count)) = bins.get_mut(usize::from(cut.bin_of(&bounds))) {
            *all = all.union(&bounds);
            *count += 1;
        }
    }
    let mut costs = [S::Wide::ZERO; BINS];
    let (mut all, mut count) = (Bounds::nothing(), 0);
    for (cost, bin) in costs.iter_mut().zip(&bins).rev() {
        (all, count) = (all.union(&bin.0), count + bin.1);
        *cost = price(&all, count);
    }
    let mut best = None;
    (all, count) = (Bounds::nothing(), 0);
    for (bin, (&(bounds, some), &beyond)) in (0..).zip(bins.iter().zip(&costs)) {
        if count > 0 && count < end - first {
            let cost = price(&all, count) + beyond;
            if !best.is_some_and(|(least, _)| least <= cost) {
                best = Some((cost, Cut { bin, ..cut }));
            }
        }
        (all, count) = (all.union(&bounds), count + some);
    }
    best
}

/// Half the surface of a box times the leaves that its entries fill; 0 for none.
fn price<S: Scalar>(bounds: &Bounds<S>, count: u32) -> S::Wide {
    if count == 0 {
        return S::Wide::ZERO;
    }
    let [x, y, z] = (bounds.max - bounds.min).to_array().map(S::widen);
    let leaves = count.div_ceil(LEAF).min(i32::MAX as u32) as i32;
    (x * y + y * z + z * x) * S::Wide::from_i32(leaves)
}

//! A ray beside a mesh: where it meets triangles, one by one and through the hierarchy.

use core::ops::ControlFlow;

use super::Mesh;
use crate::bounds::Bounds;
use crate::hierarchy::{Branch, Visit, walk};
use crate::scalar::{Number, Real, Scalar, Vector};
use crate::shape::triangle::Shear;
use crate::shape::{Sight, Tables};

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing<S> {
    /// The parameter on the ray.
    pub(super) t: S,
    /// Which triangle.
    pub(super) face: u32,
    /// From the side from which its corners run counterclockwise.
    pub(super) inward: bool,
}

/// A ray in coordinates about a point of it, near the mesh or at its own origin.
pub(super) struct View<'a, S: Scalar> {
    mesh: Mesh,
    tables: &'a Tables<'a, S>,
    branches: &'a [Branch<S>],
    shear: Shear<S::Wide>,
    /// What the vertices are seen from, before the ray is.
    base: S::Vec3,
    /// The middle of these coordinates on the ray, from the base.
    from: S::WideVec,
    /// How far across the ray the face lies in which the ray starts.
    aside: [S::Wide; 2],
    /// The parameter of the middle on the ray.
    shift: S,
    /// The middle, for boxes.
    near: S::Vec3,
    inv_dir: [S::Inverse; 3],
}

impl<'a, S: Scalar> View<'a, S> {
    /// `None` where the mesh is not all there.
    #[inline]
    pub(super) fn new(mesh: &Mesh, sight: &Sight<'a, S>) -> Option<Self> {
        let line = sight.line;
        let branches = mesh.hierarchy(sight.tables);
        let bounds = branches.first()?.bounds;
        let (base, from, shift) = if sight.start.is_some() || bounds.contains(line.origin) {
            (line.origin, S::WideVec::ZERO, S::ZERO)
        } else {
            let base = (bounds.min + bounds.max) * S::HALF;
            let shift = line.approach(base);
            (base, line.recentred(base, shift), shift)
        };
        Some(Self {
            mesh: *mesh,
            tables: sight.tables,
            branches,
            shear: Shear::new(line),
            base,
            from,
            aside: [S::Wide::ZERO; 2],
            shift,
            near: base + S::narrow_vec(from),
            inv_dir: line.inv_dir,
        })
    }

    /// How far rounding may move what this mesh is made of.
    pub(super) fn rounding(&self) -> S::Wide {
        let size = self
            .branches
            .first()
            .map_or(S::ZERO, |root| root.bounds.min.max_abs().max(root.bounds.max.max_abs()));
        S::rounding(size.widen())
    }

    pub(super) fn corners(&self, face: u32) -> Option<[S::Vec3; 3]> {
        self.mesh.corners(face, self.tables)
    }

    /// A vertex across the ray, and the parameter of its depth from the middle.
    #[inline]
    fn across(&self, vertex: S::Vec3) -> [S::Wide; 3] {
        let [x, y, t] = self.shear.across(S::widen_vec(vertex - self.base), self.from);
        let [aside_x, aside_y] = self.aside;
        [x - aside_x, y - aside_y, t]
    }

    /// Where the ray meets the triangle, and whether it goes inward.
    ///
    /// A half-line across the ray meets an odd number of its edges, the rule of
    /// [`Polygon`](crate::Polygon). Whether it meets an edge does not depend on the triangle that the edge is of,
    /// so of the triangles of a closed mesh an even number is met.
    #[inline]
    fn meet(&self, corners: [S::Vec3; 3]) -> Option<(S, bool)> {
        let [a, b, c] = corners.map(|corner| self.across(corner));
        let zero = S::Wide::ZERO;
        let [above_a, above_b, above_c] = [a, b, c].map(|[_, y, _]| y > zero);
        if above_a == above_b && above_a == above_c {
            return None;
        }
        let side = |[px, py, _]: [S::Wide; 3], [qx, qy, _]: [S::Wide; 3]| S::det2(qx, py, qy, px);
        let meets = |p: [S::Wide; 3], q: [S::Wide; 3], upward: bool| {
            if upward { side(p, q) < zero } else { side(p, q) > zero }
        };
        let inside = (above_a != above_b && meets(a, b, above_b))
            ^ (above_b != above_c && meets(b, c, above_c))
            ^ (above_c != above_a && meets(c, a, above_a));
        if !inside {
            return None;
        }
        let (u, v, w) = (side(b, c), side(c, a), side(a, b));
        let ([_, _, at], [_, _, bt], [_, _, ct]) = (a, b, c);
        let sum = u + v + w;
        let t = if sum == zero { at } else { (u / sum) * at + (v / sum) * bt + (w / sum) * ct };
        let t = t.clamp(at.min(bt).min(ct), at.max(bt).max(ct));
        let inward = (sum > zero) == self.shear.is_forward();
        Some((S::narrow(self.shift.widen() + t), inward))
    }

    /// Where the ray meets one of the triangles.
    #[inline]
    pub(super) fn crossing(&self, face: u32) -> Option<Crossing<S>> {
        let (t, inward) = self.meet(self.corners(face)?)?;
        Some(Crossing { t, face, inward })
    }

    /// Moves the ray aside, by no more than rounding may have moved its start off the face in which it
    /// starts, so that it does meet that face; `None` where it cannot, because it runs in the face.
    pub(super) fn settle(&mut self, face: u32) -> Option<bool> {
        if let Some(crossing) = self.crossing(face) {
            return Some(crossing.inward);
        }
        let [a, b, c] = self.corners(face)?.map(|corner| self.across(corner));
        let side = |[px, py, _]: [S::Wide; 3], [qx, qy, _]: [S::Wide; 3]| S::det2(qx, py, qy, px);
        let (u, v, w) = (side(b, c), side(c, a), side(a, b));
        let (zero, one) = (S::Wide::ZERO, S::Wide::ONE);
        let sum = u + v + w;
        if sum == zero {
            return None;
        }
        let least = S::Wide::EPSILON * S::Wide::from_i32(4);
        let [u, v, w] = [u, v, w].map(|part| (part / sum).clamp(least, one));
        let inverse = one / (u + v + w);
        let mean = |a: S::Wide, b: S::Wide, c: S::Wide| (a * u + b * v + c * w) * inverse;
        let aside = [mean(a[0], b[0], c[0]), mean(a[1], b[1], c[1])];
        let most = self.rounding() * S::Wide::from_i32(16);
        if aside.iter().all(|part| part.abs() <= most) {
            self.aside = aside;
            if let Some(crossing) = self.crossing(face) {
                return Some(crossing.inward);
            }
            self.aside = [zero; 2];
        }
        None
    }

    /// Gives each crossing with low < t ≤ high, in no order; what it is answered becomes the new upper end
    /// if it is lower.
    #[inline]
    pub(super) fn each(&self, [low, high]: [S; 2], on: impl FnMut(Crossing<S>) -> S) {
        let backward = self.inv_dir.map(S::is_backward);
        let window = self.local([low, high]);
        walk(self.branches, backward, &mut Search { view: self, low, high, window, on });
    }

    /// A part of the ray in the parameter from the middle, widened by what rounding may take.
    #[inline]
    fn local(&self, [low, high]: [S; 2]) -> [S; 2] {
        let slack = |t: S| {
            let size = t.abs().max(self.shift.abs());
            S::narrow(S::rounding(size.widen()) * S::Wide::from_i32(16))
        };
        [low - self.shift - slack(low), high - self.shift + slack(high)]
    }

    /// The ray may meet triangles of the box between two parameters from the middle. Never false
    /// where it does: the box is widened by more than rounding can make of the test.
    #[inline]
    fn meets(&self, bounds: &Bounds<S>, [mut enter, mut exit]: [S; 2]) -> bool {
        let [x, y, z] = self.inv_dir;
        let mut slab = |min: S, max: S, near: S, inverse: S::Inverse| {
            if S::is_parallel(inverse) {
                return min <= near && near <= max;
            }
            let (a, b) = (S::quotient(min, near, inverse), S::quotient(max, near, inverse));
            let (first, last) = if S::is_backward(inverse) { (b, a) } else { (a, b) };
            enter = enter.max(first);
            exit = exit.min(last);
            true
        };
        slab(bounds.min.x(), bounds.max.x(), self.near.x(), x)
            && slab(bounds.min.y(), bounds.max.y(), self.near.y(), y)
            && slab(bounds.min.z(), bounds.max.z(), self.near.z(), z)
            && enter <= exit
    }
}

/// A walk for crossings.
struct Search<'v, 'a, S: Scalar, F> {
    view: &'v View<'a, S>,
    low: S,
    high: S,
    /// The same from the middle.
    window: [S; 2],
    on: F,
}

impl<S: Scalar, F: FnMut(Crossing<S>) -> S> Visit<S> for Search<'_, '_, S, F> {
    #[inline]
    fn wants(&mut self, bounds: &Bounds<S>) -> bool {
        self.view.meets(bounds, self.window)
    }

    #[inline]
    fn entries(&mut self, first: u32, count: u32) -> ControlFlow<()> {
        for entry in first..first + count {
            let face = self.view.mesh.face(entry, self.view.tables.indices);
            let Some(crossing) = face.and_then(|face| self.view.crossing(face)) else {
                continue;
            };
            if self.low < crossing.t && crossing.t <= self.high {
                let high = (self.on)(crossing);
                if high < self.high {
                    self.high = high;
                    self.window = self.view.local([self.low, high]);
                }
            }
        }
        ControlFlow::Continue(())
    }
}

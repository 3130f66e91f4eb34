//! A ray as a set of patches sees it, and the patches across it one by one.

use super::Patches;
use super::borders::Sides;
use super::hits::{Hit, Hits};
use super::locate::Spot;
use super::net::{Net, Pair};
use super::search::{Root, Search};
use crate::scalar::{Number, Real, Scalar, Vector};
use crate::shape::triangle::Shear;
use crate::shape::{Sight, Tables};

/// How far rounding may move a point across the ray or of a piece of a net, in ε of the greatest coordinate.
const ERROR: i32 = 4;

/// A ray near a set of patches.
struct View<'a, S: Scalar> {
    patches: &'a Patches<S>,
    tables: &'a Tables<'a, S>,
    shear: Shear<S::Wide>,
    heading: S::WideVec,
    /// A point of the ray near the patches, from their centre, and its t.
    origin: S::WideVec,
    shift: S,
    start: Option<Origin<S>>,
}

/// The point of a patch that the ray starts on.
struct Origin<S: Scalar> {
    /// With the sides within rounding of it.
    hit: Hit<S>,
    /// The same with all sides that are so near that a ray along the surface may seem to meet what lies beyond.
    around: Hit<S>,
    /// Up to which t it may, and how high it is then over the surface at most.
    until: S::Wide,
    height: S::Wide,
}

impl<S: Scalar> Patches<S> {
    /// The hits of a ray on all patches that it may meet up to `until`; those that lie beyond the first one
    /// after `after` may be missing.
    #[inline(never)]
    pub(super) fn collect(&self, sight: &Sight<'_, S>, [after, until]: [S; 2], hits: &mut Hits<S>) {
        let view = View::new(self, sight);
        let from = if sight.start.is_some() { S::ZERO } else { -S::FAR };
        for patch in 0..self.count {
            let bounds = self.patch_bounds(sight.tables, patch);
            let until = hits.first(after).map_or(until, |hit| hit.t.min(until));
            if bounds.meets_between(sight.line, [from, until]) {
                view.search(patch, hits);
            }
        }
    }
}

impl<'a, S: Scalar> View<'a, S> {
    fn new(patches: &'a Patches<S>, sight: &Sight<'a, S>) -> Self {
        let Sight { line, tables, .. } = *sight;
        let (shear, heading) = (Shear::new(line), line.heading());
        if let Some(start) = sight.start {
            let spot = patches.place(S::widen_vec(start.local), start.face, tables);
            // To the last digit: the ray starts on the surface by definition.
            let origin = patches.point(tables, spot.patch, spot.at);
            let mut view =
                Self { patches, tables, shear, heading, origin, shift: S::ZERO, start: None };
            view.start = Some(view.starting(&spot, line.dd));
            return view;
        }
        let shift = line.approach(patches.center);
        let origin = line.recentred(patches.center, shift);
        Self { patches, tables, shear, heading, origin, shift, start: None }
    }

    /// What is to be known of the start of the ray.
    fn starting(&self, spot: &Spot<S>, dd: S::Wide) -> Origin<S> {
        let Spot { patch, at, du, dv, .. } = *spot;
        let size = self.patches.size(self.tables, patch);
        let within = |distance: S::Wide| {
            let share = |side: S::WideVec| distance / side.max_abs().max(distance);
            Sides::near(at, [share(du), share(dv)])
        };
        let rounding = size * S::Wide::EPSILON * S::Wide::from_i32(8 * ERROR);
        let hit = Hit { t: S::ZERO, patch, facing: 0, sides: within(rounding), at };
        let distance = size * S::Wide::EPSILON.sqrt() * S::Wide::from_i32(16);
        let around = Hit { sides: within(distance), ..hit };
        Origin { hit, around, until: distance / dd.sqrt(), height: rounding * S::Wide::TWO }
    }

    /// The control points of a patch across the ray, and how far rounding may move them.
    fn net(&self, patch: u16) -> (Net<S::Wide>, S::Wide) {
        let mut net = Net([[[S::Wide::ZERO; 2]; 4]; 4]);
        let mut size = S::Wide::ZERO;
        if let Some(rows) = self.patches.control(self.tables, patch) {
            let center = S::widen_vec(self.patches.center);
            for (place, control) in net.0.iter_mut().flatten().zip(rows.iter().flatten()) {
                let from = S::widen_vec(*control) - center;
                let [x, y, _] = self.shear.across(from, self.origin);
                size = size.max((from - self.origin).max_abs());
                *place = [x, y];
            }
        }
        (net, size * S::Wide::EPSILON * S::Wide::from_i32(ERROR))
    }

    /// The parameter of the ray, from `origin`, at the depth of a point of a patch.
    fn depth(&self, patch: u16, at: Pair<S::Wide>) -> S::Wide {
        let point = self.patches.point(self.tables, patch, at);
        let [_, _, depth] = self.shear.across(point, self.origin);
        depth
    }

    /// Adds the hits on one patch.
    #[inline(never)]
    fn search(&self, patch: u16, hits: &mut Hits<S>) {
        let (net, error) = self.net(patch);
        let own = self.start.as_ref().filter(|start| start.hit.patch == patch);
        let root = S::EPSILON_ROOT.widen();
        let fine = (root * root * S::Wide::from_ratio(1, 64))
            .max(S::Wide::EPSILON * S::Wide::from_ratio(1, 4));
        let mut search = Search::new(&net, fine, own.map(|start| start.hit.at));
        while let Some(root) = search.next() {
            let depth = self.depth(patch, root.at);
            if root.facing == 0 && !self.is_new_point(patch, &root, depth, error, hits) {
                continue;
            }
            let near = root.slack.map(|slack| slack * S::Wide::from_i32(16));
            let hit = Hit {
                t: S::narrow(self.shift.widen() + depth),
                patch,
                facing: root.facing,
                sides: Sides::near(root.at, near),
                at: root.at,
            };
            if self.start.as_ref().is_none_or(|start| self.lies_ahead(start, &hit, depth)) {
                hits.add(hit, root.slack, self.patches, self.tables);
            }
        }
    }

    /// A piece without extent across the ray is a point also along it, not a silhouette; and no piece beside it
    /// has been found to be that point.
    fn is_new_point(
        &self,
        patch: u16,
        root: &Root<S::Wide>,
        depth: S::Wide,
        error: S::Wide,
        hits: &Hits<S>,
    ) -> bool {
        let near = error * S::Wide::from_i32(16) / self.shear.speed();
        let rounding = S::rounding((self.shift.widen() + depth).abs()) * S::Wide::from_i32(4);
        let t = self.shift.widen() + depth;
        let known = hits.iter().any(|hit| {
            hit.patch == patch && hit.facing == 0 && (hit.t.widen() - t).abs() <= near + rounding
        });
        let [u, v] = root.at;
        let [half_u, half_v] = root.slack.map(|size| size * S::Wide::HALF);
        let corners = [(half_u, half_v), (half_u, -half_v), (-half_u, half_v), (-half_u, -half_v)];
        let flat = |(out_u, out_v): (S::Wide, S::Wide)| {
            (self.depth(patch, [u + out_u, v + out_v]) - depth).abs() <= near
        };
        !known && corners.into_iter().all(flat)
    }

    /// A hit that is not the start itself, found again on a patch beside it.
    fn lies_ahead(&self, start: &Origin<S>, hit: &Hit<S>, depth: S::Wide) -> bool {
        if !(hit.t > S::ZERO) {
            return false;
        }
        if depth > start.until {
            return true;
        }
        if self.patches.meet(self.tables, &start.hit, hit) {
            return false;
        }
        if hit.patch == start.hit.patch
            || !self.patches.touch(self.tables, &start.around, hit.patch)
        {
            return true;
        }
        // Along the surface and over a border, rounding may raise what lies beyond.
        let Spot { du, dv, .. } = self.patches.spot(self.tables, hit.patch, hit.at);
        let normal = du.cross(dv).normalize();
        normal.dot(self.heading).abs() * depth > start.height
    }
}

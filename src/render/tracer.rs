//! One sample of a picture: the tree of rays behind it, on a bounded stack.

use super::Depth;
use crate::chance::{Chance, Dimension, hash};
use crate::color::Rgb;
use crate::ray::{Line, Ray, Start};
use crate::scalar::{Number, Real, Scalar};
use crate::scene::Scene;
use crate::shade::{Branch, Surface};
use crate::span::{Boundary, Passage};
use crate::stats::{Event, Tally};

/// A ray that waits for its turn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pending<S: Scalar> {
    ray: Ray<S>,
    start: Option<Start<S>>,
    weight: Rgb<S>,
    depth: u16,
    /// The way that light was mirrored and refracted, a bit for each time.
    path: u16,
    /// How far it has come already, through surfaces that do not show.
    after: S,
}

impl<S: Scalar> Pending<S> {
    /// A ray from the camera.
    pub(super) fn primary(ray: Ray<S>) -> Self {
        Self { ray, start: None, weight: Rgb::WHITE, depth: 0, path: 1, after: S::ZERO }
    }
}

/// What traces a tree of rays, one ray at a time.
#[derive(Clone, Debug)]
pub(super) struct Tracer<'a, S: Scalar, const RAYS: usize, const BOUNDARIES: usize> {
    pub(super) scene: Scene<'a, S>,
    depth: Depth<S>,
    color: Rgb<S>,
    spent: S,
    stack: heapless::Vec<Pending<S>, RAYS>,
    boundaries: [Boundary<S>; BOUNDARIES],
    /// By the depth of a ray: the most light that it can bring for a weight of 1.
    brightest: [S::Wide; RAYS],
}

impl<'a, S: Scalar, const RAYS: usize, const BOUNDARIES: usize> Tracer<'a, S, RAYS, BOUNDARIES> {
    /// For a depth of less than `RAYS`, and a scene whose solids need no more than `BOUNDARIES`.
    pub(super) fn new(scene: &Scene<'a, S>, depth: Depth<S>) -> Self {
        let limits = scene.limits();
        let local = limits.brightest.widen();
        let (mut brightest, mut most) = ([local; RAYS], local);
        for slot in brightest.iter_mut().take(usize::from(depth.depth_max) + 1).rev() {
            *slot = most;
            most = limits.background.widen().max(local + limits.growth.widen() * most);
        }
        Self {
            scene: *scene,
            depth,
            color: Rgb::BLACK,
            spent: S::ZERO,
            stack: heapless::Vec::new(),
            boundaries: [Boundary::vacant(); BOUNDARIES],
            brightest,
        }
    }

    /// The next ray of the tree; none where it has been traced, or was never begun.
    pub(super) fn next(&mut self) -> Option<Pending<S>> {
        self.stack.pop()
    }

    /// The tree is traced to its end.
    pub(super) fn is_finished(&self) -> bool {
        self.stack.is_empty()
    }

    /// The light of the tree, and how much was cut from it; the next tree begins with none.
    pub(super) fn take(&mut self) -> (Rgb<S>, S) {
        let taken = (self.color, self.spent);
        (self.color, self.spent) = (Rgb::BLACK, S::ZERO);
        taken
    }

    /// Forgets a tree that is not traced to its end.
    pub(super) fn clear(&mut self) {
        self.stack.clear();
        self.take();
    }

    /// Adds the share of one ray, and puts the rays that it asks for on the stack.
    pub(super) fn trace(
        &mut self,
        pending: Pending<S>,
        chance: &impl Chance<S>,
        tally: &mut impl Tally,
    ) {
        let Pending { ray, start, mut weight, path, after, .. } = pending;
        let line = Line::new(ray, start);
        let found = self.scene.search(&line, after, &mut self.boundaries, tally);
        let here = found.media.here();
        let distance = found.hit.map_or(S::FAR, |hit| hit.boundary.t);
        weight = weight * self.scene.absorption(here, distance - after);
        let Some(hit) = found.hit else {
            tally.meet(|| 0);
            self.color += self.scene.parts().background.toward(ray.dir) * weight;
            return;
        };
        let Boundary { node, face, passage, .. } = hit.boundary;
        let behind = found.media.behind(hit.object, passage);
        if self.scene.is_hidden(&hit.boundary, [here, behind]) {
            // The same ray goes on behind this boundary, at the same depth: no light is mirrored
            // or refracted here, and no rounding can bring the boundary back.
            self.push(Pending { weight, after: distance, ..pending });
            return;
        }
        let Some(mut surface) = Surface::new(&self.scene, &line, &hit.boundary, tally) else {
            return;
        };
        tally.meet(|| hash(node, face));
        let ratio = if passage == Passage::Touch {
            S::Wide::ONE
        } else {
            let other = if behind == here { Some(hit.object) } else { behind };
            self.scene.ior(here).widen() / self.scene.ior(other).widen()
        };
        let sample = || chance.pair(Dimension::mirrored(path));
        let branches = surface.branches(&self.scene, ray.dir, weight, ratio, sample, tally);
        let (view, diffuse, chance) = (ray.dir, branches.diffuse, (chance, path));
        let local =
            surface.local_light(&self.scene, view, diffuse, chance, &mut self.boundaries, tally);
        self.color += local * weight;
        self.follow(branches.refracted, &pending, Event::RefractedRay, tally);
        self.follow(branches.reflected, &pending, Event::ReflectedRay, tally);
    }

    /// Puts a ray on the stack unless depth control cuts it.
    fn follow(
        &mut self,
        branch: Option<Branch<S>>,
        from: &Pending<S>,
        event: Event,
        tally: &mut impl Tally,
    ) {
        let Some(Branch { ray, start, weight }) = branch else {
            return;
        };
        if from.depth >= self.depth.depth_max {
            tally.count(Event::DepthCut);
            return;
        }
        let (share, depth) = (weight.max_part(), from.depth + 1);
        if share == S::ZERO {
            return;
        }
        let most = self.brightest.get(usize::from(depth)).copied().unwrap_or(S::Wide::FAR);
        let most = S::narrow(most * share.widen());
        if share < self.depth.weight_min {
            tally.count(Event::WeightCut);
            self.spent += most;
            return;
        }
        let budget = self.depth.error_max;
        // Small pieces first: no single ray may take more than a 64th.
        if most <= (budget - self.spent).min(budget * S::from_ratio(1, 64)) {
            tally.count(Event::BudgetCut);
            self.spent += most;
            return;
        }
        tally.count(event);
        let path = from.path << 1 | u16::from(event == Event::ReflectedRay);
        self.push(Pending { ray, start: Some(start), weight, depth, path, after: S::ZERO });
    }

    /// One ray is taken from the stack before at most two are put on it, each one deeper, so
    /// the room for `depth_max + 1` that the constructor asked for is enough.
    fn push(&mut self, pending: Pending<S>) {
        let pushed = self.stack.push(pending);
        debug_assert!(pushed.is_ok(), "the ray stack holds depth_max + 1");
    }
}

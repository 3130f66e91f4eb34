//! A picture, one ray at a time: the recursion of Whitted's algorithm on a bounded stack.
//!
//! A pixel is a weighted sum of the local light at every surface that its tree of rays
//! meets, so nothing has to return: take a ray from the stack, add its share of local light,
//! put its mirrored and its refracted ray on the stack. With at most two children a ray the
//! stack never holds more than `depth_max + 1`.

use core::ops::Range;

use crate::camera::Lens;
use crate::color::Rgb;
use crate::error::{Item, SceneError};
use crate::needs::{self, has};
use crate::ray::{Line, Ray, Start};
use crate::scalar::{Number, Real, Scalar};
use crate::scene::Scene;
use crate::shade::{Branch, Surface};
use crate::span::{Boundary, Passage};
use crate::stats::{Event, Tally};

/// When a tree of rays ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Depth<S> {
    /// Static: how many times light may be mirrored or refracted on its way. 0 gives local light only.
    pub depth_max: u16,
    /// Dynamic: a ray whose weight (its greatest share of the pixel) is below this is cut; 0 cuts none.
    pub weight_min: S,
    /// Bounded error: rays are cut only while all that they could have brought to the pixel
    /// stays within this, in units of linear light; 0 cuts none.
    pub error_max: S,
}

impl<S: Scalar> Depth<S> {
    /// Static control alone.
    pub const fn fixed(depth_max: u16) -> Self {
        Self { depth_max, weight_min: S::ZERO, error_max: S::ZERO }
    }

    fn check(&self) -> Result<(), SceneError> {
        let at = Item::Depth;
        for (value, field) in [(self.weight_min, "weight_min"), (self.error_max, "error_max")] {
            if !value.is_finite() {
                return Err(SceneError::NotFinite { at, field });
            }
            if value < S::ZERO {
                return Err(SceneError::OutOfRange { at, field, allowed: "at least 0" });
            }
        }
        Ok(())
    }
}

/// A finished pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pixel<S> {
    /// The column, from the left.
    pub x: u32,
    /// The row, from the top.
    pub y: u32,
    /// The linear light.
    pub color: Rgb<S>,
    /// How much light the rays that were cut by weight or budget could have added, at most:
    /// the pixel is within this of the one that only `depth_max` cuts. In fixed point the weights of
    /// rays are rounded too, to half a step each; those roundings are not counted here.
    pub spent: S,
}

/// What one step did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step<S> {
    /// One ray was traced; the pixel is not finished.
    Traced,
    /// One ray was traced, and it was the last of this pixel.
    Pixel(Pixel<S>),
    /// There was nothing left to do.
    Done,
}

/// A ray that waits for its turn.
#[derive(Clone, Copy, Debug)]
struct Pending<S: Scalar> {
    ray: Ray<S>,
    start: Option<Start<S>>,
    weight: Rgb<S>,
    depth: u16,
    /// How far it has come already, through surfaces that do not show.
    after: S,
}

/// A picture in the making: plain data that can be stored at any step and taken up again.
///
/// `RAYS` is the room of the ray stack, at least `depth_max + 1`. `BOUNDARIES` is the room for
/// the boundaries of one solid; a scene tells what it needs in its
/// [`limits`](crate::scene::Limits::boundaries).
#[derive(Clone, Debug)]
pub struct Render<
    'a,
    S: Scalar,
    const RAYS: usize = 9,
    const BOUNDARIES: usize = 64,
    T: Tally = (),
    const NEEDS: u64 = { needs::ALL },
> {
    scene: Scene<'a, S, NEEDS>,
    lens: Lens<S>,
    depth: Depth<S>,
    width: u32,
    rows: Range<u32>,
    x: u32,
    color: Rgb<S>,
    spent: S,
    stack: heapless::Vec<Pending<S>, RAYS>,
    boundaries: [Boundary<S>; BOUNDARIES],
    /// By the depth of a ray: the most light that it can bring for a weight of 1.
    brightest: [S::Wide; RAYS],
    tally: T,
}

impl<'a, S: Scalar, const RAYS: usize, const BOUNDARIES: usize, const NEEDS: u64>
    Render<'a, S, RAYS, BOUNDARIES, (), NEEDS>
{
    /// A picture of so many pixels, not counting what happens.
    ///
    /// # Errors
    /// As [`with_tally`](Render::with_tally).
    pub fn new(
        scene: &Scene<'a, S, NEEDS>,
        width: u32,
        height: u32,
        depth: Depth<S>,
    ) -> Result<Self, SceneError> {
        Self::with_tally(scene, width, height, depth, ())
    }
}

impl<'a, S: Scalar, const RAYS: usize, const BOUNDARIES: usize, T: Tally, const NEEDS: u64>
    Render<'a, S, RAYS, BOUNDARIES, T, NEEDS>
{
    /// A picture of so many pixels that tells what happens.
    ///
    /// # Errors
    /// If the picture has no pixels or more than 2²⁴ in a row or column, if depth control is
    /// negative or not finite, if the stack is smaller than `depth_max + 1`, or if a solid may
    /// need more boundaries than there is room for.
    pub fn with_tally(
        scene: &Scene<'a, S, NEEDS>,
        width: u32,
        height: u32,
        depth: Depth<S>,
        tally: T,
    ) -> Result<Self, SceneError> {
        let legal = 1..=1 << 24;
        if !legal.contains(&width) || !legal.contains(&height) {
            return Err(SceneError::PictureSize { width, height });
        }
        depth.check()?;
        let depth_max = u32::from(depth.depth_max);
        if depth_max as usize >= RAYS {
            return Err(SceneError::StackTooSmall { depth_max, limit: RAYS as u32 });
        }
        let limits = scene.limits();
        scene.check_room(BOUNDARIES)?;
        let local = limits.brightest.widen();
        let (mut brightest, mut most) = ([local; RAYS], local);
        for slot in brightest.iter_mut().take(depth_max as usize + 1).rev() {
            *slot = most;
            most = limits.background.widen().max(local + limits.growth.widen() * most);
        }
        Ok(Self {
            scene: *scene,
            lens: Lens::new(&scene.parts().camera, width, height),
            depth,
            width,
            rows: 0..height,
            x: 0,
            color: Rgb::BLACK,
            spent: S::ZERO,
            stack: heapless::Vec::new(),
            boundaries: [Boundary::vacant(); BOUNDARIES],
            brightest,
            tally,
        })
    }

    /// The same picture, of which only these rows are rendered; rows beyond it are left out. To be
    /// said before the first step.
    #[must_use]
    pub fn only_rows(mut self, rows: Range<u32>) -> Self {
        self.rows = rows.start.max(self.rows.start)..rows.end.min(self.rows.end);
        self
    }

    /// Who was told what happened.
    pub const fn tally(&self) -> &T {
        &self.tally
    }

    /// Traces one ray with its shadow rays.
    pub fn step(&mut self) -> Step<S> {
        let pending = match self.stack.pop() {
            Some(pending) => pending,
            None if self.rows.is_empty() => return Step::Done,
            None => {
                self.tally.count(Event::PrimaryRay);
                let ray = self.lens.ray(self.x, self.rows.start, [S::HALF, S::HALF]);
                Pending { ray, start: None, weight: Rgb::WHITE, depth: 0, after: S::ZERO }
            }
        };
        self.trace(pending);
        if !self.stack.is_empty() {
            return Step::Traced;
        }
        let pixel = Pixel { x: self.x, y: self.rows.start, color: self.color, spent: self.spent };
        (self.color, self.spent) = (Rgb::BLACK, S::ZERO);
        self.x += 1;
        if self.x == self.width {
            (self.x, self.rows.start) = (0, self.rows.start + 1);
        }
        Step::Pixel(pixel)
    }

    /// Adds the share of one ray, and puts the rays that it asks for on the stack.
    fn trace(&mut self, pending: Pending<S>) {
        let Pending { ray, start, mut weight, depth, after } = pending;
        let line = Line::new(ray, start);
        let found = self.scene.search(&line, after, &mut self.boundaries, &mut self.tally);
        let here = found.media.here();
        let distance = found.hit.map_or(S::FAR, |hit| hit.boundary.t);
        weight = weight * self.scene.absorption(here, distance - after);
        let Some(hit) = found.hit else {
            self.color += self.scene.parts().background.toward(ray.dir) * weight;
            return;
        };
        let passage = hit.boundary.passage;
        let behind = found.media.behind(hit.object, passage);
        if self.scene.is_hidden(&hit.boundary, [here, behind]) {
            // The same ray goes on behind this boundary, at the same depth: no light is mirrored
            // or refracted here, and no rounding can bring the boundary back.
            self.push(Pending { weight, after: distance, ..pending });
            return;
        }
        let tally = &mut self.tally;
        let Some(mut surface) = Surface::new(&self.scene, &line, &hit.boundary, tally) else {
            return;
        };
        let ratio = if passage == Passage::Touch || !has(NEEDS, needs::MIRRORS | needs::GLASS) {
            S::Wide::ONE
        } else {
            let other = if behind == here { Some(hit.object) } else { behind };
            self.scene.ior(here).widen() / self.scene.ior(other).widen()
        };
        let branches = surface.branches(&self.scene, ray.dir, weight, ratio, &mut self.tally);
        let (view, diffuse) = (ray.dir, branches.diffuse);
        let local =
            surface.local_light(&self.scene, view, diffuse, &mut self.boundaries, &mut self.tally);
        self.color += local * weight;
        self.follow(branches.refracted, depth, Event::RefractedRay);
        self.follow(branches.reflected, depth, Event::ReflectedRay);
    }

    /// Puts a ray on the stack unless depth control cuts it.
    fn follow(&mut self, branch: Option<Branch<S>>, depth: u16, event: Event) {
        let Some(Branch { ray, start, weight }) = branch else {
            return;
        };
        if depth >= self.depth.depth_max {
            self.tally.count(Event::DepthCut);
            return;
        }
        let (share, depth) = (weight.max_part(), depth + 1);
        if share == S::ZERO {
            return;
        }
        let most = self.brightest.get(usize::from(depth)).copied().unwrap_or(S::Wide::FAR);
        let most = S::narrow(most * share.widen());
        if share < self.depth.weight_min {
            self.tally.count(Event::WeightCut);
            self.spent += most;
            return;
        }
        let budget = self.depth.error_max;
        // Small pieces first: no single ray may take more than a 64th.
        if most <= (budget - self.spent).min(budget * S::from_ratio(1, 64)) {
            self.tally.count(Event::BudgetCut);
            self.spent += most;
            return;
        }
        self.tally.count(event);
        self.push(Pending { ray, start: Some(start), weight, depth, after: S::ZERO });
    }

    /// One ray is taken from the stack before at most two are put on it, each one deeper, so
    /// the room for `depth_max + 1` that the constructor asked for is enough.
    fn push(&mut self, pending: Pending<S>) {
        let pushed = self.stack.push(pending);
        debug_assert!(pushed.is_ok(), "the ray stack holds depth_max + 1");
    }
}

/// The pixels in order, row by row.
impl<S: Scalar, const RAYS: usize, const BOUNDARIES: usize, T: Tally, const NEEDS: u64> Iterator
    for Render<'_, S, RAYS, BOUNDARIES, T, NEEDS>
{
    type Item = Pixel<S>;

    fn next(&mut self) -> Option<Pixel<S>> {
        loop {
            match self.step() {
                Step::Traced => {}
                Step::Pixel(pixel) => return Some(pixel),
                Step::Done => return None,
            }
        }
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let rows = self.rows.len();
        match rows.checked_mul(self.width as usize) {
            Some(pixels) => {
                let left = pixels - self.x as usize;
                (left, Some(left))
            }
            None => (usize::MAX, None),
        }
    }
}

//! A picture, one ray at a time: the recursion of Whitted's algorithm on a bounded stack.
//!
//! A sample of a pixel is a weighted sum of the local light at every surface that its tree of rays
//! meets, so nothing has to return: take a ray from the stack, add its share of local light,
//! put its mirrored and its refracted ray on the stack. With at most two children a ray the
//! stack never holds more than `depth_max + 1`.
//!
//! Which samples make a pixel is a type of its own, the [`Plan`]: one in the middle ([`Centre`]),
//! several ([`Sampled`]). All share the same steps, and who samples nothing stores nothing for it.

mod depth;
mod plan;
mod sampled;
mod tracer;

pub use depth::Depth;
pub use plan::{AnyOrder, Centre, Plan};
pub use sampled::Sampled;

use core::ops::Range;

use crate::camera::Film;
use crate::chance::{Chance, Dimension};
use crate::color::Rgb;
use crate::error::SceneError;
use crate::sampler::Sampler;
use crate::scalar::Scalar;
use crate::scene::Scene;
use crate::stats::{Event, Tally};
use plan::{Listeners, Place};
use tracer::{Pending, Tracer};

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
    /// the pixel is within this of the one that only `depth_max` cuts. Of several samples it is
    /// the mean. In fixed point the weights of rays are rounded too, to half a step each; those
    /// roundings are not counted here.
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

/// A picture in the making: plain data that can be stored at any step and taken up again.
///
/// `RAYS` is the room of the ray stack, at least `depth_max + 1`. `BOUNDARIES` is the room for
/// the boundaries of one solid; a scene tells what it needs in its
/// [`limits`](crate::scene::Limits::boundaries). `P` says which samples make a pixel.
#[derive(Clone, Debug)]
pub struct Render<
    'a,
    S: Scalar,
    const RAYS: usize = 9,
    const BOUNDARIES: usize = 64,
    T: Tally = (),
    P: Plan<S> = Centre,
> {
    tracer: Tracer<'a, S, RAYS, BOUNDARIES>,
    film: Film<S>,
    /// The columns that are rendered begin here.
    left: u32,
    /// They end before here.
    right: u32,
    x: u32,
    /// The row that is rendered, and the one before which to end.
    rows: Range<u32>,
    tally: T,
    plan: P,
}

impl<'a, S: Scalar, const RAYS: usize, const BOUNDARIES: usize> Render<'a, S, RAYS, BOUNDARIES> {
    /// A picture of so many pixels, not counting what happens.
    ///
    /// # Errors
    /// As [`with_tally`](Render::with_tally).
    pub fn new(
        scene: &Scene<'a, S>,
        width: u32,
        height: u32,
        depth: Depth<S>,
    ) -> Result<Self, SceneError> {
        Self::with_tally(scene, width, height, depth, ())
    }
}

impl<'a, S: Scalar, const RAYS: usize, const BOUNDARIES: usize, T: Tally>
    Render<'a, S, RAYS, BOUNDARIES, T>
{
    /// A picture of so many pixels that tells what happens.
    ///
    /// # Errors
    /// If the picture has no pixels or more than 2²⁴ in a row or column, if depth control is
    /// negative or not finite, if the stack is smaller than `depth_max + 1`, or if a solid may
    /// need more boundaries than there is room for.
    pub fn with_tally(
        scene: &Scene<'a, S>,
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
        scene.check_room(BOUNDARIES)?;
        let film = Film::new(&scene.parts().camera, width, height);
        let (rows, plan) = (0..height, Centre);
        let tracer = Tracer::new(scene, depth);
        Ok(Self { tracer, film, left: 0, right: width, x: 0, rows, tally, plan })
    }

    /// The same picture with several samples a pixel.
    ///
    /// # Errors
    /// If there are none, or more than [`SAMPLES_MAX`](crate::sampler::SAMPLES_MAX).
    pub fn sampled(
        self,
        sampler: Sampler,
    ) -> Result<Render<'a, S, RAYS, BOUNDARIES, T, Sampled<S>>, SceneError> {
        Ok(self.planned(Sampled::new(sampler)?))
    }

    fn planned<P: Plan<S>>(self, plan: P) -> Render<'a, S, RAYS, BOUNDARIES, T, P> {
        let Self { tracer, film, left, right, x, rows, tally, plan: Centre } = self;
        Render { tracer, film, left, right, x, rows, tally, plan }
    }
}

impl<S: Scalar, const RAYS: usize, const BOUNDARIES: usize, T: Tally, P: Plan<S>>
    Render<'_, S, RAYS, BOUNDARIES, T, P>
{
    /// The same picture, of which only these rows are rendered; rows beyond it are left out. To be
    /// said before the first step.
    #[must_use]
    pub fn only_rows(mut self, rows: Range<u32>) -> Self {
        self.rows = rows.start.max(self.rows.start)..rows.end.min(self.rows.end);
        self
    }

    /// The same picture, of which only these columns of these rows are rendered; what lies beyond it is
    /// left out. To be said before the first step.
    #[must_use]
    pub fn only_tile(mut self, columns: Range<u32>, rows: Range<u32>) -> Self {
        (self.left, self.right) = (columns.start.max(self.left), columns.end.min(self.right));
        self.x = self.left;
        if self.left >= self.right {
            self.rows.start = self.rows.end;
        }
        self.only_rows(rows)
    }

    /// Who was told what happened.
    pub const fn tally(&self) -> &T {
        &self.tally
    }

    /// Traces one ray with its shadow rays.
    pub fn step(&mut self) -> Step<S> {
        let (x, y) = (self.x, self.rows.start);
        let at = Place { x, y };
        let chance = self.plan.chance(at);
        let pending = match self.tracer.next() {
            Some(pending) => pending,
            None if self.rows.is_empty() => return Step::Done,
            None => {
                self.tally.count(Event::PrimaryRay);
                let (pixel, offset) = self.plan.aim(at);
                let camera = &self.tracer.scene.parts().camera;
                let lens = || chance.pair(Dimension::LENS);
                Pending::primary(self.film.ray(camera, pixel, offset, lens))
            }
        };
        let mut listeners = Listeners { tally: &mut self.tally, plan: &mut self.plan };
        self.tracer.trace(pending, &chance, &mut listeners);
        if !self.tracer.is_finished() {
            return Step::Traced;
        }
        let (color, spent) = self.tracer.take();
        let Some((color, spent)) = self.plan.take(at, color, spent) else {
            return Step::Traced;
        };
        self.x += 1;
        if self.x == self.right {
            (self.x, self.rows.start) = (self.left, y + 1);
        }
        Step::Pixel(Pixel { x, y, color, spent })
    }

    /// Goes to a pixel, in a row that is rendered or in one above; what was begun is forgotten.
    fn go(&mut self, x: u32, y: u32) {
        self.tracer.clear();
        self.plan.restart();
        let inside = (self.left..self.right).contains(&x) && y < self.rows.end;
        (self.x, self.rows.start) = if inside { (x, y) } else { (self.left, self.rows.end) };
    }

    /// Goes to the first pixel of a row, if it is not there; what was begun of another is forgotten.
    /// Beyond the rows that are rendered there is nothing to do.
    pub fn seek_row(&mut self, y: u32) {
        if (self.x, self.rows.start) != (self.left, y) {
            self.go(self.left, y);
        }
    }

    /// Renders a row into as many pixels as it has or as there is room for, from the left, and tells
    /// how many. What was begun of a pixel elsewhere is forgotten; rendering goes on behind.
    pub fn render_row(&mut self, y: u32, row: &mut [Rgb<S>]) -> usize {
        self.seek_row(y);
        let mut count = 0;
        let wide = (self.right - self.left) as usize;
        // The places first: the other way round a pixel would be taken for which there is none.
        for (place, pixel) in row.iter_mut().take(wide).zip(self) {
            *place = pixel.color;
            count += 1;
        }
        count
    }
}

impl<S: Scalar, const RAYS: usize, const BOUNDARIES: usize, T: Tally, P: AnyOrder<S>>
    Render<'_, S, RAYS, BOUNDARIES, T, P>
{
    /// Goes to a pixel; what was begun of another is forgotten. Rendering goes on from there. Beyond
    /// what is rendered there is nothing to do.
    pub fn seek(&mut self, x: u32, y: u32) {
        self.go(x, y);
    }
}

/// The pixels in order, row by row.
impl<S: Scalar, const RAYS: usize, const BOUNDARIES: usize, T: Tally, P: Plan<S>> Iterator
    for Render<'_, S, RAYS, BOUNDARIES, T, P>
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
        match rows.checked_mul((self.right - self.left) as usize) {
            Some(pixels) if pixels > 0 => {
                let left = pixels - (self.x - self.left) as usize;
                (left, Some(left))
            }
            Some(_) => (0, Some(0)),
            None => (usize::MAX, None),
        }
    }
}

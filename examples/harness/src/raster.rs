//! A picture rendered by several threads, row by row; the same bits for any number of them.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::thread;

use nostray::render::Plan;
use nostray::{Depth, Render, Rgb, Sampler, Scalar, Scene, SceneError, Stats, Tally};

/// The room of the ray stack: one more than [`DEPTH_MAX`].
const RAYS: usize = 65;

/// The greatest depth that can be asked for.
pub const DEPTH_MAX: u16 = RAYS as u16 - 1;

/// The boundaries of a solid that most scenes get along with, and those that any scene does.
const BOUNDARIES_FEW: usize = 1024;
const BOUNDARIES_ALL: usize = 65_536;

/// Enough for a few copies of the largest [`Render`].
const STACK_BYTES: usize = 32 << 20;

/// What is to be rendered.
#[derive(Clone, Debug, PartialEq)]
pub struct Order<S> {
    /// Pixels from left to right.
    pub width: u32,
    /// Pixels from top to bottom, of the whole picture.
    pub height: u32,
    /// The rows that are wanted.
    pub rows: Range<u32>,
    /// When a tree of rays ends.
    pub depth: Depth<S>,
    /// How many threads; at least 1.
    pub threads: usize,
    /// Whether to count what happens.
    pub counted: bool,
}

/// Rows of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster<S> {
    /// Pixels from left to right.
    pub width: u32,
    /// Rows that there are.
    pub height: u32,
    /// The linear light, row by row from the top.
    pub pixels: Vec<Rgb<S>>,
    /// The most light that rays cut by weight or budget could have added to any one pixel.
    pub spent: S,
    /// What happened, if it was counted.
    pub stats: Stats,
}

/// Which samples make a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Sampling {
    /// One in its middle.
    #[default]
    Centre,
    /// Several.
    Uniform(Sampler),
}

/// Who looks on while a picture is rendered.
pub struct Onlooker<'o, S> {
    /// Is shown each row when it is finished.
    pub on_row: &'o (dyn Fn(u32, &[Rgb<S>]) + Sync),
    /// Ends it after the rows that are being rendered.
    pub stop: &'o AtomicBool,
}

/// Renders the rows that are asked for with one sample a pixel, and calls `on_row` after each.
///
/// # Errors
/// As [`render_sampled`].
pub fn render<S: Scalar>(
    scene: &Scene<'_, S>,
    order: &Order<S>,
    on_row: &(dyn Fn() + Sync),
) -> Result<Raster<S>, SceneError> {
    let onlooker = Onlooker { on_row: &|_, _| on_row(), stop: &AtomicBool::new(false) };
    render_sampled(scene, order, Sampling::Centre, &onlooker)
}

/// Renders the rows that are asked for, or the first of them if it is told to stop.
///
/// # Errors
/// If the picture has no legal size, if the depth is more than [`DEPTH_MAX`], or if the sampling is
/// not legal.
pub fn render_sampled<S: Scalar>(
    scene: &Scene<'_, S>,
    order: &Order<S>,
    sampling: Sampling,
    onlooker: &Onlooker<'_, S>,
) -> Result<Raster<S>, SceneError> {
    let few = scene.limits().boundaries as usize <= BOUNDARIES_FEW;
    let job = Job { scene, order, sampling, onlooker, next: AtomicU32::new(order.rows.start) };
    match (few, order.counted) {
        (true, false) => job.fill::<BOUNDARIES_FEW, ()>(),
        (true, true) => job.fill::<BOUNDARIES_FEW, Stats>(),
        // So rare that counting what nobody asks for does not matter.
        (false, _) => job.fill::<BOUNDARIES_ALL, Stats>(),
    }
}

/// A tally that can be summed up.
trait Count: Tally + Default {
    fn add_to(&self, stats: &mut Stats);
}

impl Count for () {
    fn add_to(&self, _: &mut Stats) {}
}

impl Count for Stats {
    fn add_to(&self, stats: &mut Stats) {
        stats.add(self);
    }
}

/// One row, by its index.
type Row<S> = (u32, Vec<Rgb<S>>);

/// What one thread made.
struct Share<S> {
    rows: Vec<Row<S>>,
    spent: S,
    stats: Stats,
}

/// What all threads know.
struct Job<'j, 's, S: Scalar> {
    scene: &'j Scene<'s, S>,
    order: &'j Order<S>,
    sampling: Sampling,
    onlooker: &'j Onlooker<'j, S>,
    /// The first row that nobody has taken.
    next: AtomicU32,
}

impl<S: Scalar> Job<'_, '_, S> {
    fn fill<const BOUNDARIES: usize, T: Count>(&self) -> Result<Raster<S>, SceneError> {
        let work = || self.work::<BOUNDARIES, T>();
        let threads = self.order.threads.clamp(1, self.order.rows.len().max(1));
        let shares = thread::scope(|scope| {
            let start = |index: usize| {
                let builder = thread::Builder::new().stack_size(STACK_BYTES);
                builder.name(format!("rows {index}")).spawn_scoped(scope, work)
            };
            // Where the system gives fewer threads than asked for, those that there are do it all.
            let started: Vec<_> = (0..threads).map_while(|index| start(index).ok()).collect();
            let joined = started.into_iter().map(|thread| match thread.join() {
                Ok(share) => share,
                Err(panic) => std::panic::resume_unwind(panic),
            });
            let shares: Result<Vec<_>, _> = joined.collect();
            match shares {
                Ok(shares) if shares.is_empty() => work().map(|share| vec![share]),
                shares => shares,
            }
        })?;
        Ok(gather(self.order, shares))
    }

    /// Renders with the samples that are asked for. An error shows even where there is no row.
    fn work<const BOUNDARIES: usize, T: Count>(&self) -> Result<Share<S>, SceneError> {
        let Order { width, height, depth, .. } = *self.order;
        let render = Render::<S, RAYS, BOUNDARIES, T>::with_tally(
            self.scene,
            width,
            height,
            depth,
            T::default(),
        )?;
        Ok(match self.sampling {
            Sampling::Centre => self.rows(render, 1),
            Sampling::Uniform(sampler) => self.rows(render.sampled(sampler)?, 1),
        })
    }

    /// Renders rows that nobody has taken yet, so many at a time, as long as there are any.
    fn rows<const BOUNDARIES: usize, T: Count, P: Plan<S>>(
        &self,
        mut render: Render<'_, S, RAYS, BOUNDARIES, T, P>,
        many: u32,
    ) -> Share<S> {
        let mut share = Share { rows: Vec::new(), spent: S::ZERO, stats: Stats::default() };
        let end = self.order.rows.end;
        'taken: loop {
            let first = self.next.fetch_add(many, Ordering::Relaxed);
            if first >= end {
                break;
            }
            for y in first..end.min(first.saturating_add(many)) {
                if self.onlooker.stop.load(Ordering::Relaxed) {
                    break 'taken;
                }
                render.seek_row(y);
                let mut pixels = Vec::with_capacity(self.order.width as usize);
                for pixel in render.by_ref().take(self.order.width as usize) {
                    pixels.push(pixel.color);
                    share.spent = share.spent.max(pixel.spent);
                }
                (self.onlooker.on_row)(y, &pixels);
                share.rows.push((y, pixels));
            }
        }
        render.tally().add_to(&mut share.stats);
        share
    }
}

/// Puts the rows of all threads in order, up to the first that is missing.
fn gather<S: Scalar>(order: &Order<S>, shares: Vec<Share<S>>) -> Raster<S> {
    let (mut rows, mut spent, mut stats) = (Vec::new(), S::ZERO, Stats::default());
    for share in shares {
        rows.extend(share.rows);
        spent = spent.max(share.spent);
        stats.add(&share.stats);
    }
    rows.sort_unstable_by_key(|row: &Row<S>| row.0);
    // Where it was stopped, some later rows may be there while earlier ones are not.
    let mut expected = order.rows.clone();
    let rows: Vec<Row<S>> =
        rows.into_iter().take_while(|row| expected.next() == Some(row.0)).collect();
    let height = rows.len() as u32;
    let mut pixels = Vec::with_capacity(rows.len() * order.width as usize);
    for (_, row) in rows {
        pixels.extend_from_slice(&row);
    }
    Raster { width: order.width, height, pixels, spent, stats }
}

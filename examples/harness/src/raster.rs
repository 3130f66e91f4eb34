//! A picture rendered by several threads, row by row; the same bits for any number of them.

use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering};
use std::thread;

use nostray::{Depth, Render, Rgb, Scalar, Scene, SceneError, Stats, Tally};

/// The room of the ray stack: one more than [`DEPTH_MAX`].
const RAYS: usize = 65;

/// The greatest depth that can be asked for.
pub const DEPTH_MAX: u16 = RAYS as u16 - 1;

/// The boundaries of a solid that most scenes get along with, those that parts of meshes need, and those that
/// any scene gets along with.
const BOUNDARIES_FEW: usize = 1024;
const BOUNDARIES_MANY: usize = 16_384;
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

/// Renders the rows that are asked for, and calls `on_row` after each.
///
/// # Errors
/// If the picture has no legal size, or if the depth is more than [`DEPTH_MAX`].
pub fn render<S: Scalar>(
    scene: &Scene<'_, S>,
    order: &Order<S>,
    on_row: &(dyn Fn() + Sync),
) -> Result<Raster<S>, SceneError> {
    let needed = scene.limits().boundaries as usize;
    if needed > BOUNDARIES_MANY {
        // So rare that counting what nobody asks for does not matter.
        return fill::<S, BOUNDARIES_ALL, Stats>(scene, order, on_row);
    }
    match (needed > BOUNDARIES_FEW, order.counted) {
        (true, _) => fill::<S, BOUNDARIES_MANY, Stats>(scene, order, on_row),
        (false, true) => fill::<S, BOUNDARIES_FEW, Stats>(scene, order, on_row),
        (false, false) => fill::<S, BOUNDARIES_FEW, ()>(scene, order, on_row),
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

fn fill<S: Scalar, const BOUNDARIES: usize, T: Count>(
    scene: &Scene<'_, S>,
    order: &Order<S>,
    on_row: &(dyn Fn() + Sync),
) -> Result<Raster<S>, SceneError> {
    let next = AtomicU32::new(order.rows.start);
    let work = || work::<S, BOUNDARIES, T>(scene, order, &next, on_row);
    let threads = order.threads.clamp(1, order.rows.len().max(1));
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
    Ok(gather(order, shares))
}

/// Renders rows that nobody has taken yet, as long as there are any.
fn work<S: Scalar, const BOUNDARIES: usize, T: Count>(
    scene: &Scene<'_, S>,
    order: &Order<S>,
    next: &AtomicU32,
    on_row: &(dyn Fn() + Sync),
) -> Result<Share<S>, SceneError> {
    let mut share = Share { rows: Vec::new(), spent: S::ZERO, stats: Stats::default() };
    loop {
        let row = next.fetch_add(1, Ordering::Relaxed);
        // An error shows even where there is no row left to render.
        let (width, height, depth) = (order.width, order.height, order.depth);
        let render = Render::<S, RAYS, BOUNDARIES, T>::with_tally(
            scene,
            width,
            height,
            depth,
            T::default(),
        )?;
        if row >= order.rows.end {
            return Ok(share);
        }
        let mut render = render.only_rows(row..row + 1);
        let mut pixels = Vec::with_capacity(order.width as usize);
        for pixel in render.by_ref() {
            pixels.push(pixel.color);
            share.spent = share.spent.max(pixel.spent);
        }
        render.tally().add_to(&mut share.stats);
        share.rows.push((row, pixels));
        on_row();
    }
}

/// Puts the rows of all threads in order.
fn gather<S: Scalar>(order: &Order<S>, shares: Vec<Share<S>>) -> Raster<S> {
    let (mut rows, mut spent, mut stats) = (Vec::new(), S::ZERO, Stats::default());
    for share in shares {
        rows.extend(share.rows);
        spent = spent.max(share.spent);
        stats.add(&share.stats);
    }
    rows.sort_unstable_by_key(|row: &Row<S>| row.0);
    let height = rows.len() as u32;
    let mut pixels = Vec::with_capacity(rows.len() * order.width as usize);
    for (_, row) in rows {
        pixels.extend_from_slice(&row);
    }
    Raster { width: order.width, height, pixels, spent, stats }
}

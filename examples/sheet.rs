//! The whole gallery but its first scene on one sheet:
//! `cargo run --release --example sheet -- images/gallery.png`.
//!
//! Each cell is the mean, in linear light, of a picture several times its size.

use std::error::Error;
use std::path::Path;

use nostray::{Depth, Rgb, Stats, Transfer};
use nostray_harness::gallery::{Entry, GALLERY};
use nostray_harness::output::{Format, write};
use nostray_harness::raster::{Order, Raster, render};
use nostray_harness::source::Source;

/// A cell in pixels, without the gap to the next.
const WIDTH: usize = 188;
const HEIGHT: usize = 141;
const GAP: usize = 4;
/// So many pixels of the picture in a row and in a column for one of its cell.
const MEAN_OF: usize = 4;
const COLUMNS: usize = 5;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args_os().nth(1).ok_or("usage: sheet FILE.png")?;
    let path = Path::new(&path);
    let format = Format::of(path).ok_or("the file must end in .png, .ppm or .pfm")?;
    let scenes: Vec<&'static Entry> = GALLERY.iter().skip(1).collect();
    let width = COLUMNS * (WIDTH + GAP) - GAP;
    let height = scenes.len().div_ceil(COLUMNS) * (HEIGHT + GAP) - GAP;
    let mut pixels = vec![Rgb::WHITE; width * height];
    for (index, entry) in scenes.into_iter().enumerate() {
        let cell = cell(entry)?;
        let (left, top) = (index % COLUMNS * (WIDTH + GAP), index / COLUMNS * (HEIGHT + GAP));
        for (y, row) in cell.chunks(WIDTH).enumerate() {
            let to = (top + y) * width + left;
            pixels.splice(to..to + WIDTH, row.iter().copied());
        }
    }
    let (width, height) = (width as u32, height as u32);
    let sheet = Raster { width, height, pixels, spent: 0.0, stats: Stats::default() };
    Ok(write(&sheet, path, format, Transfer::Srgb)?)
}

/// The pixels of a scene's cell, row by row.
fn cell(entry: &'static Entry) -> Result<Vec<Rgb<f32>>, Box<dyn Error>> {
    let loaded = Source::Gallery(entry).load::<f32>()?;
    let scene = loaded.scene()?;
    let (width, height) = ((WIDTH * MEAN_OF) as u32, (HEIGHT * MEAN_OF) as u32);
    let depth = Depth::fixed(8);
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let order = Order { width, height, rows: 0..height, depth, threads, counted: false };
    let picture = render(&scene, &order, &|| ())?;
    let mut sums = vec![Rgb::BLACK; WIDTH * HEIGHT];
    for (index, &color) in picture.pixels.iter().enumerate() {
        let (x, y) = (index % width as usize / MEAN_OF, index / width as usize / MEAN_OF);
        if let Some(sum) = sums.get_mut(y * WIDTH + x) {
            // What is brighter than white must not outshine its neighbours.
            *sum += color.map(|part| if part < 1.0 { part } else { 1.0 });
        }
    }
    let share = 1.0 / (MEAN_OF * MEAN_OF) as f32;
    Ok(sums.into_iter().map(|sum| sum * share).collect())
}

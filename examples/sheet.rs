//! The whole gallery but its first scene on one sheet:
//! `cargo run --release --example sheet -- images/gallery.png`.
//!
//! Each cell is the mean, in linear light, of a picture several times its size.

use std::error::Error;
use std::path::Path;

use nostray::Transfer;
use nostray_harness::gallery::{Entry, GALLERY};
use nostray_harness::output::{Format, write};
use nostray_harness::sheet::Sheet;
use nostray_harness::source::Source;

/// A cell in pixels, without the gap to the next.
const WIDTH: usize = 188;
const HEIGHT: usize = 141;
const GAP: usize = 4;
const COLUMNS: usize = 5;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args_os().nth(1).ok_or("usage: sheet FILE.png")?;
    let path = Path::new(&path);
    let format = Format::of(path).ok_or("the file must end in .png, .ppm or .pfm")?;
    let scenes: Vec<&'static Entry> = GALLERY.iter().skip(1).collect();
    let width = COLUMNS * (WIDTH + GAP) - GAP;
    let height = scenes.len().div_ceil(COLUMNS) * (HEIGHT + GAP) - GAP;
    let mut sheet = Sheet::new(width, height);
    for (index, entry) in scenes.into_iter().enumerate() {
        let place = [index % COLUMNS * (WIDTH + GAP), index / COLUMNS * (HEIGHT + GAP)];
        let loaded = Source::Gallery(entry).load::<f32>()?;
        sheet.place(&loaded.scene()?, place, [WIDTH, HEIGHT])?;
    }
    Ok(write(&sheet.raster(), path, format, Transfer::Srgb)?)
}

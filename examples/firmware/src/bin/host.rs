//! The same picture on the host. `host` says the SHA-256 of its bytes; `host FILE.pgm` writes the grey
//! picture as well; `host --screen DUMP.ppm` compares it with what the emulated display showed.

use std::collections::BTreeMap;
use std::convert::Infallible;
use std::process::ExitCode;
use std::{env, fs};

use embedded_graphics_core::Pixel;
use embedded_graphics_core::geometry::{OriginDimensions, Size};
use embedded_graphics_core::pixelcolor::{Gray4, GrayColor};
use embedded_graphics_core::prelude::DrawTarget;
use nostray_firmware::{HEIGHT, WIDTH, show};

/// A display in memory.
struct Canvas([[u8; WIDTH]; HEIGHT]);

impl OriginDimensions for Canvas {
    fn size(&self) -> Size {
        Size::new(WIDTH as u32, HEIGHT as u32)
    }
}

impl DrawTarget for Canvas {
    type Color = Gray4;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Gray4>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), Infallible> {
        for Pixel(at, color) in pixels {
            self.0[at.y as usize][at.x as usize] = color.luma();
        }
        Ok(())
    }
}

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("host: {why}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), String> {
    let words: Vec<String> = env::args().skip(1).collect();
    let mut canvas = Canvas([[0; WIDTH]; HEIGHT]);
    let digest = show(&mut canvas).map_err(|trouble| format!("{trouble:?}"))?;
    match &words[..] {
        [] => {}
        [option, dump] if option == "--screen" => same_screen(&canvas, dump)?,
        [file] => {
            let mut bytes = format!("P5\n{WIDTH} {HEIGHT}\n15\n").into_bytes();
            bytes.extend(canvas.0.iter().flatten());
            fs::write(file, bytes).map_err(|error| format!("{file}: {error}"))?;
        }
        _ => return Err("usage: host [FILE.pgm | --screen DUMP.ppm]".into()),
    }
    let digest: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
    println!("{digest}");
    Ok(())
}

/// The emulator draws each pixel as a square, in a colour of its own for each level.
fn same_screen(canvas: &Canvas, dump: &str) -> Result<(), String> {
    let bytes = fs::read(dump).map_err(|error| format!("{dump}: {error}"))?;
    let mut parts = bytes.splitn(4, |byte| byte.is_ascii_whitespace());
    let mut part = || parts.next().ok_or("the dump is cut short");
    let (kind, width, height) = (part()?, part()?, part()?);
    let number = |text: &[u8]| String::from_utf8_lossy(text).parse::<usize>().unwrap_or(0);
    let (width, height) = (number(width), number(height));
    let pixels = part()?.strip_prefix(b"255\n").ok_or("the dump has other than 256 levels")?;
    let scale = width / WIDTH;
    if kind != b"P6" || scale == 0 || width != scale * WIDTH || height != scale * HEIGHT {
        return Err(format!("the dump is no {WIDTH}x{HEIGHT} picture: {width}x{height}"));
    }
    let mut colors = BTreeMap::new();
    for (index, color) in pixels.chunks_exact(3).enumerate() {
        let (x, y) = (index % width / scale, index / width / scale);
        let level = canvas.0[y][x];
        if *colors.entry(level).or_insert(color) != color {
            return Err(format!("the display shows another level than {level} at ({x}, {y})"));
        }
    }
    let mut shades: Vec<u32> =
        colors.values().map(|color| color.iter().map(|&part| u32::from(part)).sum()).collect();
    if shades.len() < 12 || !shades.is_sorted() {
        return Err(format!("the levels do not become brighter: {shades:?}"));
    }
    shades.dedup();
    if shades.len() != colors.len() {
        return Err("the display shows two levels alike".into());
    }
    Ok(())
}

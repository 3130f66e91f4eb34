//! What four small displays show of a scene of the gallery, computed in fixed point as a
//! microcontroller would:
//! `cargo run --release --features embedded-graphics --example display -- FILE.png [SCENE]`.
//!
//! From the top left: 65 536 colours; 16 greys; 65 536 colours without dithering, for comparison; black
//! and white.

use std::error::Error;

use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Point, Size};
use embedded_graphics_core::pixelcolor::{BinaryColor, Gray4, Rgb565, Rgb888, RgbColor};
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_simulator::{OutputSettings, SimulatorDisplay};
use nostray::display::{DisplayColor, Look, draw_rows};
use nostray::{Depth, Dither, Q16, Render, Scene};
use nostray_harness::gallery;
use nostray_harness::source::Source;

/// Every display in pixels.
const SIZE: Size = Size::new(320, 240);
/// So many pixels of the sheet in a row and in a column show one of a display.
const SCALE: u32 = 2;
const GAP: u32 = 8;

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let path = words.next().ok_or("usage: display FILE.png [SCENE]")?;
    let name = words.next().unwrap_or_else(|| "showcase".to_owned());
    let entry = gallery::find(&name).ok_or_else(|| format!("the gallery has no {name:?}"))?;
    let loaded = Source::Gallery(entry).load::<Q16>()?;
    let scene = loaded.scene()?;
    let plain = Look { dither: Dither::Off, ..Look::default() };
    let cell = SIZE * SCALE + Size::new_equal(GAP);
    let sheet = Size::new(cell.width * 2 - GAP, cell.height * 2 - GAP);
    let mut sheet = SimulatorDisplay::with_default_color(sheet, Rgb888::WHITE);
    let [right, down] = [cell.x_axis(), cell.y_axis()];
    hang(&panel::<Rgb565>(&scene, Look::default())?, Point::zero(), &mut sheet)?;
    hang(&panel::<Gray4>(&scene, Look::default())?, Point::zero() + right, &mut sheet)?;
    hang(&panel::<Rgb565>(&scene, plain)?, Point::zero() + down, &mut sheet)?;
    hang(&panel::<BinaryColor>(&scene, Look::default())?, Point::zero() + cell, &mut sheet)?;
    let image = sheet.to_rgb_output_image(&OutputSettings::default());
    Ok(image.save_png(path)?)
}

/// A display that shows the scene.
fn panel<C>(scene: &Scene<'_, Q16>, look: Look) -> Result<SimulatorDisplay<C>, Box<dyn Error>>
where
    C: DisplayColor + From<BinaryColor>,
{
    let picture: Render<Q16, 9, 256> =
        Render::new(scene, SIZE.width, SIZE.height, Depth::fixed(8))?;
    let mut display = SimulatorDisplay::with_default_color(SIZE, C::from(BinaryColor::Off));
    let rows = draw_rows(picture, SIZE.width, Point::zero(), look, &mut display)?;
    if rows == SIZE.height { Ok(display) } else { Err(format!("{rows} rows were drawn").into()) }
}

/// Draws a display onto the sheet, enlarged.
fn hang<C>(
    display: &SimulatorDisplay<C>,
    at: Point,
    sheet: &mut SimulatorDisplay<Rgb888>,
) -> Result<(), Box<dyn Error>>
where
    C: DisplayColor + Into<Rgb888>,
{
    let Size { width, height } = display.size() * SCALE;
    let colors = (0..width * height).map(|index| {
        let (x, y) = (index % width / SCALE, index / width / SCALE);
        display.get_pixel(Point::new(x as i32, y as i32)).into()
    });
    Ok(sheet.fill_contiguous(&Rectangle::new(at, Size::new(width, height)), colors)?)
}

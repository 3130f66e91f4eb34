//! A picture for a small grey display, row by row: the part of the firmware that knows nothing of the
//! board, so that the host can compute the same.
#![no_std]

mod scene;

use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{Gray4, GrayColor};
use embedded_graphics_core::prelude::DrawTarget;
use embedded_graphics_core::primitives::Rectangle;
use nostray::{Depth, Q16, Render, Scene, SceneError, Transfer};
use sha2::{Digest, Sha256};

/// The display, in pixels.
pub const WIDTH: usize = 128;
/// Its rows.
pub const HEIGHT: usize = 64;

/// How often light may be mirrored: the ray stack has one entry more.
const DEPTH: u16 = 4;

/// A picture in the making; it is as large as everything that tracing needs.
type Picture = Render<'static, Q16, 5, 16>;

/// Why there is no picture.
#[derive(Debug)]
pub enum Trouble<E> {
    /// The scene is not legal, or needs more room than the picture has.
    Scene(SceneError),
    /// The display does not take it.
    Display(E),
}

/// Renders the picture and shows each row as soon as it is there; gives the SHA-256 of its bytes,
/// red, green and blue.
///
/// # Errors
/// What is wrong with the scene, or what the display says.
pub fn show<D: DrawTarget<Color = Gray4>>(display: &mut D) -> Result<[u8; 32], Trouble<D::Error>> {
    let scene = Scene::new(scene::PARTS).map_err(Trouble::Scene)?;
    let depth = Depth::fixed(DEPTH);
    let picture = Picture::new(&scene, WIDTH as u32, HEIGHT as u32, depth);
    let mut picture = picture.map_err(Trouble::Scene)?;
    let mut hash = Sha256::new();
    for y in 0..HEIGHT {
        let mut row = [Gray4::new(0); WIDTH];
        // The places first: the other way round a pixel would be taken for which there is none.
        for ((x, place), pixel) in row.iter_mut().enumerate().zip(picture.by_ref()) {
            let bytes = pixel.color.to_rgb8(Transfer::Srgb);
            hash.update(bytes);
            *place = grey(bytes, x, y);
        }
        let area = Rectangle::new(Point::new(0, y as i32), Size::new(WIDTH as u32, 1));
        display.fill_contiguous(&area, row).map_err(Trouble::Display)?;
    }
    Ok(hash.finalize().into())
}

/// One of 16 levels for a colour, with the thresholds of a 4×4 Bayer matrix between two levels.
fn grey([red, green, blue]: [u8; 3], x: usize, y: usize) -> Gray4 {
    // Luma of Rec. 709, in 1/256.
    let luma = (54 * u32::from(red) + 183 * u32::from(green) + 19 * u32::from(blue)) >> 8;
    // The matrix from the bits of x and of x ⊕ y, the lowest first.
    let (across, along) = (x as u32 ^ y as u32, y as u32);
    let order = (across & 1) << 3 | (along & 1) << 2 | (across & 2) | (along & 2) >> 1;
    // 255 is level 15; a level is 17 wide.
    Gray4::new(((luma * 16 + order * 17) / (17 * 16)) as u8)
}

//! A picture for a small grey display, row by row: the part of the firmware that knows nothing of the
//! board, so that the host can compute the same.
#![no_std]

mod scene;

use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::Point;
use embedded_graphics_core::pixelcolor::Gray4;
use nostray::display::{Look, draw_rows};
use nostray::{Depth, Dither, Render, Scene, SceneError, Transfer, needs};
use sha2::{Digest, Sha256};

/// The display, in pixels.
pub const WIDTH: usize = 128;
/// Its rows.
pub const HEIGHT: usize = 64;

/// How often light may be mirrored: the ray stack has one entry more.
const DEPTH: u16 = 4;

/// What the scene asks for: for nothing else there is code in flash.
const NEEDS: u64 = scene::PARTS.needs() & !needs::GLASS;

/// A picture in the making; it is as large as everything that tracing needs.
type Picture = Render<'static, f32, 5, 16, (), NEEDS>;

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
    let scene = Scene::limited(scene::PARTS).map_err(Trouble::Scene)?;
    let depth = Depth::fixed(DEPTH);
    let picture = Picture::new(&scene, WIDTH as u32, HEIGHT as u32, depth);
    let mut hash = Sha256::new();
    let pixels = picture
        .map_err(Trouble::Scene)?
        .inspect(|pixel| hash.update(pixel.color.to_rgb8(Transfer::Srgb)));
    let look = Look { transfer: Transfer::Srgb, dither: Dither::Ordered };
    draw_rows(pixels, WIDTH as u32, Point::zero(), look, display).map_err(Trouble::Display)?;
    Ok(hash.finalize().into())
}

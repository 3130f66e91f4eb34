//! A picture on any display that `embedded-graphics` knows, drawn pixel by pixel as it is traced.
//!
//! No row is kept: the display's driver asks for colour after colour, and each is traced when it is
//! asked for. A driver that sends blocks keeps them itself; `examples/band.rs` shows one of 16 rows.
//!
//! With the feature `embedded-graphics`.

use core::iter;

use embedded_graphics_core::Pixel as Dot;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{
    Bgr565, Bgr888, BinaryColor, Gray2, Gray4, Gray8, PixelColor, Rgb555, Rgb565, Rgb666, Rgb888,
    RgbColor,
};
use embedded_graphics_core::primitives::Rectangle;

use crate::color::{Dither, Rgb, Transfer, luma};
use crate::render::Pixel;
use crate::scalar::Scalar;

/// How light becomes what a display shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Look {
    /// The curve between light and the display's levels; without effect on displays of two levels,
    /// whose mean is what the eye sees.
    pub transfer: Transfer,
    /// How light between two levels is shown.
    pub dither: Dither,
}

/// A colour of a display.
pub trait DisplayColor: PixelColor {
    /// What a display shows for linear light at a place.
    fn of_light<S: Scalar>(light: Rgb<S>, look: Look, x: u32, y: u32) -> Self;
}

macro_rules! three_parts {
    ($($color:ident)*) => { $(
        impl DisplayColor for $color {
            #[inline]
            fn of_light<S: Scalar>(light: Rgb<S>, look: Look, x: u32, y: u32) -> Self {
                let [r, g, b] = light.to_rgb8(look.transfer);
                let level = |byte, max| look.dither.level(byte, max, x, y);
                Self::new(level(r, Self::MAX_R), level(g, Self::MAX_G), level(b, Self::MAX_B))
            }
        }
    )* };
}

three_parts!(Rgb555 Rgb565 Bgr565 Rgb666 Rgb888 Bgr888);

macro_rules! grey {
    ($($color:ident $max:literal)*) => { $(
        impl DisplayColor for $color {
            #[inline]
            fn of_light<S: Scalar>(light: Rgb<S>, look: Look, x: u32, y: u32) -> Self {
                let byte = luma(light.to_rgb8(look.transfer));
                Self::new(look.dither.level(byte, $max, x, y))
            }
        }
    )* };
}

grey!(Gray2 3 Gray4 15 Gray8 255);

impl DisplayColor for BinaryColor {
    #[inline]
    fn of_light<S: Scalar>(light: Rgb<S>, look: Look, x: u32, y: u32) -> Self {
        let byte = luma(light.to_rgb8(Transfer::Linear));
        Self::from(look.dither.level(byte, 1, x, y) == 1)
    }
}

impl<S: Scalar> Pixel<S> {
    /// The pixel as a display shows it.
    #[inline]
    pub fn on_display<C: DisplayColor>(&self, look: Look) -> C {
        C::of_light(self.color, look, self.x, self.y)
    }
}

/// Draws pixels that come row by row, each row in one go as soon as the display asks for its colours;
/// gives how many rows there were. `at` is where pixel (0, 0) of the picture comes to lie, and `width`
/// how many pixels a row of the picture has.
///
/// Cut the iterator short to draw a part and go on later.
///
/// # Errors
/// What the display says.
pub fn draw_rows<S: Scalar, D: DrawTarget<Color: DisplayColor>>(
    mut picture: impl Iterator<Item = Pixel<S>>,
    width: u32,
    at: Point,
    look: Look,
    display: &mut D,
) -> Result<u32, D::Error> {
    let mut rows = 0;
    while let Some(first) = picture.next() {
        let area = Rectangle::new(place(at, &first), Size::new(width - first.x, 1));
        let rest = picture.by_ref().take((width - first.x) as usize - 1);
        let mut row = iter::once(first).chain(rest);
        display.fill_contiguous(&area, row.by_ref().map(|pixel| pixel.on_display(look)))?;
        // What lies beyond the display's edge is not asked for, but it is a part of this row.
        row.for_each(drop);
        rows += 1;
    }
    Ok(rows)
}

/// Draws pixels that come in any order.
///
/// # Errors
/// What the display says.
pub fn draw_pixels<S: Scalar, D: DrawTarget<Color: DisplayColor>>(
    picture: impl Iterator<Item = Pixel<S>>,
    at: Point,
    look: Look,
    display: &mut D,
) -> Result<(), D::Error> {
    display.draw_iter(picture.map(|pixel| Dot(place(at, &pixel), pixel.on_display(look))))
}

fn place<S>(at: Point, pixel: &Pixel<S>) -> Point {
    at + Point::new(pixel.x as i32, pixel.y as i32)
}

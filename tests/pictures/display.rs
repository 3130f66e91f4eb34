//! Pictures on displays: what is drawn pixel by pixel is what a picture in memory would show.
#![cfg(feature = "embedded-graphics")]
#![allow(clippy::expect_used, clippy::indexing_slicing, reason = "tests may panic")]

use std::convert::Infallible;

use embedded_graphics_core::Pixel as Dot;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Point, Size};
use embedded_graphics_core::pixelcolor::{
    Bgr565, BinaryColor, Gray2, Gray4, Gray8, GrayColor, PixelColor, Rgb565, Rgb888, RgbColor,
};
use nostray::display::{DisplayColor, Look, draw_pixels, draw_rows};
use nostray::{Depth, Dither, Pixel, Q16, Real, Render, Rgb, Scene, Transfer};
use nostray_harness::gallery;
use nostray_harness::source::{Loaded, Source};

const WIDTH: u32 = 40;
const HEIGHT: u32 = 30;

/// A display that remembers each pixel and how it was sent.
struct Canvas<C> {
    size: Size,
    pixels: Vec<Option<C>>,
    runs: u32,
}

impl<C: PixelColor> Canvas<C> {
    fn new(width: u32, height: u32) -> Self {
        Self {
            size: Size::new(width, height),
            pixels: vec![None; (width * height) as usize],
            runs: 0,
        }
    }
}

impl<C> OriginDimensions for Canvas<C> {
    fn size(&self) -> Size {
        self.size
    }
}

impl<C: PixelColor> DrawTarget for Canvas<C> {
    type Color = C;
    type Error = Infallible;

    /// As the trait asks for: what lies outside is not drawn. Only what lies inside is asked for
    /// where it comes in runs.
    fn draw_iter<I: IntoIterator<Item = Dot<C>>>(&mut self, dots: I) -> Result<(), Infallible> {
        self.runs += 1;
        let (width, height) = (self.size.width as i32, self.size.height as i32);
        for Dot(Point { x, y }, color) in dots {
            if x >= width {
                // A driver that stops at its edge, and leaves the rest of the row where it is.
                break;
            }
            if (0..width).contains(&x) && (0..height).contains(&y) {
                self.pixels[(y * width + x) as usize] = Some(color);
            }
        }
        Ok(())
    }
}

fn loaded() -> Loaded<Q16> {
    let entry = gallery::find("mirrors").expect("a scene of the gallery");
    Source::Gallery(entry).load::<Q16>().expect("it can be read")
}

fn render<'a>(scene: &Scene<'a, Q16>) -> Render<'a, Q16> {
    Render::new(scene, WIDTH, HEIGHT, Depth::fixed(3)).expect("a legal picture")
}

fn shows<C: DisplayColor + std::fmt::Debug>(look: Look) {
    let loaded = loaded();
    let scene = loaded.scene().expect("a legal scene");
    let expected: Vec<Option<C>> = render(&scene)
        .map(|pixel| Some(C::of_light(pixel.color, look, pixel.x, pixel.y)))
        .collect();
    let mut canvas = Canvas::<C>::new(WIDTH, HEIGHT);
    let rows = draw_rows(render(&scene), WIDTH, Point::zero(), look, &mut canvas).expect("drawn");
    assert_eq!((rows, canvas.runs), (HEIGHT, HEIGHT), "each row in one go");
    assert_eq!(canvas.pixels, expected);
    // In the other order, pixel by pixel.
    let mut pixels: Vec<Pixel<Q16>> = render(&scene).collect();
    pixels.reverse();
    let mut canvas = Canvas::<C>::new(WIDTH, HEIGHT);
    draw_pixels(pixels.into_iter(), Point::zero(), look, &mut canvas).expect("drawn");
    assert_eq!(canvas.pixels, expected);
}

#[test]
fn every_kind_of_display_shows_the_picture() {
    for dither in [Dither::Off, Dither::Ordered] {
        for transfer in [Transfer::Srgb, Transfer::Linear] {
            let look = Look { transfer, dither };
            shows::<Rgb888>(look);
            shows::<Rgb565>(look);
            shows::<Bgr565>(look);
            shows::<Gray8>(look);
            shows::<Gray4>(look);
            shows::<Gray2>(look);
            shows::<BinaryColor>(look);
        }
    }
}

/// A display smaller than the picture, and one where it hangs over the edge: what is seen is in
/// its place, and a driver that stops early does not shift the rows below.
#[test]
fn edges_of_the_display_cut_the_picture() {
    let loaded = loaded();
    let scene = loaded.scene().expect("a legal scene");
    let look = Look::default();
    let all: Vec<Rgb565> = render(&scene).map(|pixel| pixel.on_display(look)).collect();
    let mut canvas = Canvas::<Rgb565>::new(17, 13);
    let at = Point::new(5, 4);
    let rows = draw_rows(render(&scene), WIDTH, at, look, &mut canvas).expect("drawn");
    assert_eq!(rows, HEIGHT);
    for (index, &shown) in canvas.pixels.iter().enumerate() {
        let (x, y) = (index as i32 % 17 - 5, index as i32 / 17 - 4);
        let expected = (x >= 0 && y >= 0).then(|| all[(y * WIDTH as i32 + x) as usize]);
        assert_eq!(shown, expected, "({x}, {y})");
    }
}

/// A few rows now and the rest later, from within a row too.
#[test]
fn drawing_can_be_interrupted() {
    let loaded = loaded();
    let scene = loaded.scene().expect("a legal scene");
    let look = Look::default();
    let expected: Vec<Option<Gray4>> =
        render(&scene).map(|pixel| Some(pixel.on_display(look))).collect();
    let (mut canvas, mut picture) = (Canvas::<Gray4>::new(WIDTH, HEIGHT), render(&scene));
    for part in [1, 6, 33, 40, 55, 1000, 9000] {
        let some = picture.by_ref().take(part);
        draw_rows(some, WIDTH, Point::zero(), look, &mut canvas).expect("drawn");
    }
    assert_eq!(canvas.pixels, expected);
}

/// Light between two levels of a display: on average the display shows it, and the ends stay.
#[test]
fn levels_between_are_mixed() {
    let share = |light: f32| {
        let look = Look::default();
        let at = |place: u32| {
            BinaryColor::of_light(Rgb::new(light, light, light), look, place % 16, place / 16)
        };
        (0..256).filter(|&place| at(place).is_on()).count() as f32 / 256.0
    };
    assert_eq!([share(0.0), share(1.0), share(7.0)], [0.0, 1.0, 1.0]);
    for step in 1..64 {
        let light = f32::from_ratio(step, 64);
        assert!((share(light) - light).abs() <= 0.02, "{light}: {}", share(light));
    }
    let grey = |look: Look| {
        let light = Rgb::new(0.2_f32, 0.2, 0.2);
        (0..64).map(|i| u32::from(Gray4::of_light(light, look, i % 8, i / 8).luma())).sum::<u32>()
    };
    // 0.2 is code 124 in sRGB and 51 in proportion, of 255.
    let mean = |look: Look| f64::from(grey(look)) / 64.0 * 17.0;
    assert!((mean(Look::default()) - 124.0).abs() <= 0.5);
    assert!((mean(Look { transfer: Transfer::Linear, ..Look::default() }) - 51.0).abs() <= 0.5);
    let green = Rgb565::of_light(Rgb::new(0.0_f32, 1.0, 0.0), Look::default(), 1, 1);
    assert_eq!((green.r(), green.g(), green.b()), (0, 63, 0));
}

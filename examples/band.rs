//! A picture through a buffer of 16 rows, for displays that take blocks while the next is computed:
//! `cargo run --release --features embedded-graphics --example band -- FILE.png`.
//!
//! Everything that is needed at run time stands in two variables, and their sizes are printed.

use std::error::Error;
use std::mem::size_of_val;

use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor};
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_simulator::{OutputSettings, SimulatorDisplay};
use nostray::display::Look;
use nostray::glam::Vec3;
use nostray::*;

const WIDTH: usize = 240;
const HEIGHT: usize = 320;
const ROWS: usize = 16;

const fn leaf(shape: Shape<f32>, material: u16) -> Node<f32> {
    Node::Leaf(Leaf { shape, material, placement: None })
}

const fn ball(center: Vec3, radius: f32, material: u16) -> Node<f32> {
    leaf(Shape::Sphere(Sphere { center, radius }), material)
}

static PARTS: Parts<f32> = Parts {
    nodes: &[
        leaf(Shape::Plane(Plane { normal: Vec3::Y, offset: 0.0 }), 0),
        ball(Vec3::new(0.0, 1.0, 0.0), 1.0, 1),
        ball(Vec3::new(0.0, 2.7, 0.0), 0.7, 2),
        ball(Vec3::new(0.0, 3.85, 0.0), 0.45, 1),
    ],
    objects: &[
        Object::new(0, 1, 0),
        Object::new(1, 1, 1),
        Object::new(2, 1, 2),
        Object::new(3, 1, 1),
    ],
    materials: &[
        Material { color: Paint::Texture(0), reflect: 0.15, ..Material::PLAIN },
        Material {
            color: Paint::Solid(Rgb::new(0.9, 0.55, 0.2)),
            specular: 0.4,
            reflect: 0.2,
            ..Material::PLAIN
        },
        Material { color: Paint::Solid(Rgb::new(0.1, 0.1, 0.12)), reflect: 0.7, ..Material::PLAIN },
    ],
    textures: &[Texture::new(Pattern::Checker, Ramp::new(0, 2))],
    stops: &[
        Stop::color(0.0, Rgb::new(0.8, 0.8, 0.75)),
        Stop::color(1.0, Rgb::new(0.15, 0.2, 0.3)),
    ],
    lights: &[Light::Point {
        at: Vec3::new(-4.0, 8.0, 6.0),
        color: Rgb::new(0.9, 0.9, 0.85),
        attenuation: Attenuation::NONE,
    }],
    background: Background::Gradient {
        bottom: Rgb::new(0.75, 0.8, 0.9),
        top: Rgb::new(0.15, 0.3, 0.7),
    },
    ambient: Rgb::new(0.15, 0.15, 0.18),
    ..Parts::seen_by(Camera::pinhole(
        Vec3::new(2.2, 3.2, 7.5),
        Vec3::new(0.0, 2.0, 0.0),
        Vec3::Y,
        38.0,
    ))
};

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("usage: band FILE.png")?;
    let scene = Scene::new(PARTS)?;
    let mut picture: Render<f32, 5, 16> =
        Render::new(&scene, WIDTH as u32, HEIGHT as u32, Depth::fixed(4))?;
    let mut band = [Rgb565::BLACK; WIDTH * ROWS];
    println!("picture {} bytes, band {} bytes", size_of_val(&picture), size_of_val(&band));
    // From here on as on the board: fill the band, send it as one block.
    let mut display = SimulatorDisplay::new(Size::new(WIDTH as u32, HEIGHT as u32));
    for top in (0..HEIGHT).step_by(ROWS) {
        // The places first: the other way round a pixel would be taken for which there is none.
        for (place, pixel) in band.iter_mut().zip(picture.by_ref()) {
            *place = pixel.on_display(Look::default());
        }
        let area = Rectangle::new(Point::new(0, top as i32), Size::new(WIDTH as u32, ROWS as u32));
        display.fill_contiguous(&area, band)?;
    }
    Ok(display.to_rgb_output_image(&OutputSettings::default()).save_png(path)?)
}

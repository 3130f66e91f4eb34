//! Every pattern, mapping and relief as a labelled swatch on one page:
//! `cargo run --release --example swatches -- images/swatches.png`.

use std::convert::Infallible;
use std::error::Error;
use std::path::Path;

use letters::mono_font::MonoTextStyle;
use letters::mono_font::ascii::FONT_6X10;
use letters::pixelcolor::BinaryColor;
use letters::prelude::*;
use letters::text::{Alignment, Text};
use nostray::{Rgb, Transfer};
use nostray_harness::Assembly;
use nostray_harness::document::PATTERNS;
use nostray_harness::output::{Format, write};
use nostray_harness::read::{Syntax, read};
use nostray_harness::sheet::Sheet;

/// A swatch in pixels, and the room below it for its label.
const WIDTH: usize = 148;
const HEIGHT: usize = 111;
const LABEL: usize = 16;
const GAP: usize = 8;
const COLUMNS: usize = 6;

/// What a swatch shows: its label, textures of which "t" is the one, and the material.
struct Swatch {
    label: String,
    textures: String,
    material: &'static str,
}

const PAINTED: &str = r#"color: "t", diffuse: 0.8, specular: 0.15"#;
const RAISED: &str = r#"color: (0.72, 0.62, 0.5), diffuse: 0.8, specular: 0.4,
    relief: (texture: "t", depth: 0.16)"#;

/// A pattern by itself, in a size that suits a ball of radius 1.
fn pattern(name: &str) -> Swatch {
    let fields = match name {
        "Brick" => "size: (0.6, 0.22, 0.3)",
        "Hexagons" => "size: 0.5",
        "Gradient" => "size: 2.6, place: [Translate((-1.3, 0, 0))]",
        "Radial" => "size: 1.8, place: [Translate((0.6, 0.6, 0.6))]",
        "Onion" => "size: 0.4, place: [Translate((0.6, 0.6, 0.6))]",
        "Wood" => "size: 0.16, place: [RotateX(75), RotateY(20)]",
        "Marble" => "size: 0.9, place: [RotateZ(30)]",
        "Granite" => "size: 0.25",
        "Cells" | "Crackle" => "size: 0.45",
        "Spots" => "size: 0.5",
        "Dents" => "size: 0.22",
        "Noise" => "size: 0.3",
        "Fbm" | "Turbulence" | "Wrinkles" => "size: 0.7",
        "Waves" => "size: 0.9",
        "Ripples" => "size: 0.3, place: [Translate((0.5, 0.5, 0.5))]",
        "Image" => {
            "made: Globe(width: 512), mapping: Spherical, wrap_v: Clamp, place: [RotateY(-150)]"
        }
        "Agate" | "Leopard" => "size: 0.6",
        _ => "size: 0.5",
    };
    let textures = format!("\"t\": {name}({fields})");
    Swatch { label: name.to_owned(), textures, material: PAINTED }
}

/// A pattern as a relief.
fn relief(name: &str, fields: &str) -> Swatch {
    let textures = format!("\"t\": {name}({fields})");
    Swatch { label: format!("{name}, as a relief"), textures, material: RAISED }
}

/// Bricks in a mapping.
fn mapping(name: &str, label: &str, fields: &str) -> Swatch {
    let textures = format!("\"t\": Brick(mapping: {name}, {fields})");
    Swatch { label: format!("Brick, {label}"), textures, material: PAINTED }
}

fn swatches() -> Vec<Swatch> {
    let mut all: Vec<Swatch> = PATTERNS.iter().map(|name| pattern(name)).collect();
    let around = "size: (0.0625, 0.05, 1)";
    all.extend([
        mapping("Uv", "Uv", around),
        mapping("Planar", "Planar", "size: (0.4, 0.16, 1)"),
        mapping("Spherical", "Spherical", around),
        mapping("Cylindrical", "Cylindrical", "size: (0.0625, 0.16, 1)"),
        mapping("Cubic", "Cubic", "size: (0.2, 0.08, 1)"),
        mapping("Toroidal(major: 0.6)", "Toroidal", "size: (0.0625, 0.0625, 1)"),
        relief("Noise", "size: 0.16"),
        relief("Waves", "size: 0.9"),
        relief("Ripples", "size: 0.3, place: [Translate((0.5, 0.5, 0.5))]"),
        relief("Dents", "size: 0.16"),
        relief("Wrinkles", "size: 0.6"),
        Swatch {
            label: "Checker of Marble and Wood".to_owned(),
            textures: r#""a": Marble(size: 0.5), "b": Wood(size: 0.12, place: [RotateX(80)]),
                "t": Checker(size: 0.6, colors: ["a", "b"])"#
                .to_owned(),
            material: PAINTED,
        },
        Swatch {
            label: "Stripes, warped".to_owned(),
            textures: r#""t": Stripes(size: 0.3, warp: 0.8, octaves: 4)"#.to_owned(),
            material: PAINTED,
        },
    ]);
    all
}

impl Swatch {
    /// A ball before a wall, both of the material.
    fn scene(&self) -> String {
        format!(
            r#"(camera: (eye: (0, 0, 6), look_at: (0, 0, 0), fov: 25), ambient: (0.25, 0.25, 0.27),
            lights: [Directional(toward: (0.5, -0.6, -0.62), color: (0.95, 0.93, 0.9))],
            textures: {{{}}}, materials: {{"m": ({})}}, objects: [
                (solid: Sphere(center: (0, 0, 0), radius: 1.08), material: "m"),
                (solid: Plane(normal: (0, 0, 1), offset: -1.5), material: "m"),
            ])"#,
            self.textures, self.material
        )
    }
}

/// Where letters are drawn.
struct Letters<'a>(&'a mut Sheet);

impl OriginDimensions for Letters<'_> {
    fn size(&self) -> Size {
        Size::new(u32::MAX >> 1, u32::MAX >> 1)
    }
}

impl DrawTarget for Letters<'_> {
    type Color = BinaryColor;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<BinaryColor>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), Infallible> {
        for Pixel(Point { x, y }, color) in pixels {
            if let (Ok(x), Ok(y), true) = (x.try_into(), y.try_into(), color.is_on()) {
                self.0.set(x, y, Rgb::BLACK);
            }
        }
        Ok(())
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args_os().nth(1).ok_or("usage: swatches FILE.png")?;
    let path = Path::new(&path);
    let format = Format::of(path).ok_or("the file must end in .png, .ppm or .pfm")?;
    let swatches = swatches();
    let (wide, high) = (WIDTH + GAP, HEIGHT + LABEL + GAP);
    let rows = swatches.len().div_ceil(COLUMNS);
    let mut sheet = Sheet::new(COLUMNS * wide + GAP, rows * high + GAP);
    let style = MonoTextStyle::new(&FONT_6X10, BinaryColor::On);
    for (index, swatch) in swatches.iter().enumerate() {
        let (left, top) = (GAP + index % COLUMNS * wide, GAP + index / COLUMNS * high);
        let document = read(&swatch.scene(), Syntax::Ron)?;
        let assembly = Assembly::<f32>::of_document(&document)?;
        sheet.place(&assembly.scene()?, [left, top], [WIDTH, HEIGHT])?;
        let middle = Point::new((left + WIDTH / 2) as i32, (top + HEIGHT + 11) as i32);
        Text::with_alignment(&swatch.label, middle, style, Alignment::Center)
            .draw(&mut Letters(&mut sheet))?;
    }
    Ok(write(&sheet.raster(), path, format, Transfer::Srgb)?)
}

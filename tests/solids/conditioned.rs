//! Scenes that are hard on the numbers: very flat solids cut with one another, sizes from 1e-4 to 1e4
//! side by side, a viewer a million units away. In `f32` no pixel is wrong.
//!
//! A pixel may differ from `f64` where a silhouette or the edge of a shadow runs through it so closely
//! that rounding a direction decides: there a picture in `f64` from a viewer who stands aside by
//! as much as a direction in `f32` can tell differs as well, and the pixel lies between the two.
//! `cargo test --test solids conditioned -- --nocapture` prints how many there are.
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]

use nostray::{Depth, Scalar, Transfer};
use nostray_harness::Assembly;
use nostray_harness::raster::{Order, render};
use nostray_harness::read::{Syntax, read};

const WIDTH: u32 = 200;
const HEIGHT: u32 = 150;

/// A scene without its camera, and how it is looked at.
struct View {
    name: &'static str,
    eye: [f64; 3],
    look_at: [f64; 3],
    fov: f64,
    scene: &'static str,
}

const VIEWS: &[View] = &[
    View {
        name: "two unit balls, 1000 times as wide, cut",
        eye: [0.0, 900.0, 2500.0],
        look_at: [0.0, 0.0, 0.0],
        fov: 42.0,
        scene: r#"
            materials: { "red": (color: (0.8, 0.2, 0.1), specular: 0.4), "sky": (color: (0.3, 0.5, 0.8), reflect: 0.3) },
            objects: [
                (solid: Intersection([
                    With(solid: Sphere(center: (0, 0, 0), radius: 1), place: [Scale((1000, 1, 1000))]),
                    With(solid: Sphere(center: (0, 0, 0), radius: 1), place: [Scale((1000, 1, 1000)), RotateZ(0.05), Translate((300, 0.5, 0))]),
                ]), material: "red"),
                (solid: Sphere(center: (0, 0, 0), radius: 1), material: "sky", place: [Scale((1000, 1000, 1)), RotateY(20), Translate((0, 100, -900))]),
            ],
            lights: [Directional(toward: (-0.3, -1, -0.6), color: (1, 1, 1))],"#,
    },
    View {
        name: "radii of 1e-4 before one of 1e4",
        eye: [0.0, 0.0003, 0.0015],
        look_at: [0.0, 0.0001, 0.0],
        fov: 40.0,
        scene: r#"
            materials: { "small": (color: (0.9, 0.6, 0.1), specular: 0.5, reflect: 0.2), "large": (color: (0.3, 0.6, 0.4)) },
            objects: [
                (solid: Sphere(center: (2000, -10000, -9000), radius: 10000), material: "large"),
                (solid: Sphere(center: (0, 0.0001, 0), radius: 0.0001), material: "small"),
                (solid: Difference([
                    Cylinder(base: (0.0003, 0, 0), top: (0.0003, 0.0004, -0.0001), radius: 0.0001),
                    Sphere(center: (0.0003, 0.0004, 0.00005), radius: 0.00012),
                ]), material: "small"),
                (solid: Cone(base: (-0.0003, 0, -0.0001), base_radius: 0.0001, top: (-0.0003, 0.0004, 0), top_radius: 0), material: "small"),
            ],
            lights: [Directional(toward: (0.5, -1, -0.7), color: (1, 1, 1))],"#,
    },
    View {
        name: "a million units away",
        eye: [600000.0, 200000.0, 775000.0],
        look_at: [0.0, 0.0, 0.0],
        fov: 0.025,
        scene: r#"
            materials: { "white": (color: (0.9, 0.9, 0.85), specular: 0.3), "blue": (color: (0.2, 0.3, 0.7), reflect: 0.2) },
            objects: [
                (solid: Difference([Box(min: (-90, -90, -90), max: (90, 90, 90)), Sphere(center: (60, 60, 60), radius: 95)]), material: "white"),
                (solid: Cone(base: (-60, -90, 170), base_radius: 60, top: (-60, 60, 170), top_radius: 10), material: "blue"),
                (solid: Cylinder(base: (150, -80, -60), top: (190, 90, -20), radius: 25), material: "blue"),
            ],
            lights: [Directional(toward: (-0.2, -0.6, -0.8), color: (1, 1, 1))],"#,
    },
];

/// Writes a picture to look at, if a folder is named for it.
fn keep(view: &View, picture: &[[u8; 3]]) {
    if let Some(folder) = std::env::var_os("NOSTRAY_PICTURES") {
        let name: String = view.name.chars().filter(|c| c.is_alphanumeric()).collect();
        let path = std::path::Path::new(&folder).join(name).with_extension("png");
        let bytes = picture.concat();
        image::save_buffer(path, &bytes, WIDTH, HEIGHT, image::ColorType::Rgb8).expect("written");
    }
}

/// The bytes of a view, from an eye that stands aside by a vector.
fn bytes<S: Scalar>(view: &View, aside: [f64; 3]) -> Vec<[u8; 3]> {
    let moved = |at: [f64; 3]| [0, 1, 2].map(|i| at[i] + aside[i]);
    let ([ex, ey, ez], [lx, ly, lz]) = (moved(view.eye), moved(view.look_at));
    let text = format!(
        "(camera: (eye: ({ex:?}, {ey:?}, {ez:?}), look_at: ({lx:?}, {ly:?}, {lz:?}), fov: {:?}), \
         ambient: (0.15, 0.15, 0.15), background: (0.05, 0.06, 0.1), {})",
        view.fov, view.scene
    );
    let document = read(&text, Syntax::Ron).unwrap_or_else(|e| panic!("{}: {e:?}", view.name));
    let assembly = Assembly::<S>::of_document(&document).expect("a legal scene");
    let scene = assembly.scene().expect("a legal scene");
    let depth = Depth::fixed(3);
    let rows = 0..HEIGHT;
    let order = Order { width: WIDTH, height: HEIGHT, rows, depth, threads: 2, counted: false };
    let raster = render(&scene, &order, &|| ()).expect("a legal picture");
    raster.pixels.iter().map(|color| color.to_rgb8(Transfer::Srgb)).collect()
}

/// How far a direction in `f32` can be off at the distance of what is looked at.
fn blur(view: &View) -> f64 {
    let way = [0, 1, 2].map(|i| view.look_at[i] - view.eye[i]);
    let distance: f64 = way.iter().map(|x| x.abs()).sum();
    distance * f64::from(f32::EPSILON) * 2.0
}

#[test]
fn no_pixel_is_wrong() {
    for view in VIEWS {
        let blur = blur(view);
        let mut truths = vec![bytes::<f64>(view, [0.0; 3])];
        for sign in [-blur, blur] {
            for axis in 0..3 {
                let mut aside = [0.0; 3];
                aside[axis] = sign;
                truths.push(bytes::<f64>(view, aside));
            }
        }
        let coarse = bytes::<f32>(view, [0.0; 3]);
        keep(view, &coarse);
        let (mut shown, mut edge, mut wrong) = (0, 0, Vec::new());
        let background = truths[0][0];
        for (index, color) in coarse.iter().enumerate() {
            shown += u32::from(truths[0][index] != background);
            let near = |truth: &[u8; 3]| (0..3).all(|i| color[i].abs_diff(truth[i]) <= 1);
            if near(&truths[0][index]) {
                continue;
            }
            let between = (0..3).all(|i| {
                let range = truths.iter().map(|truth| truth[index][i]);
                let (low, high) = (range.clone().min(), range.max());
                low.is_some_and(|low| color[i] >= low.saturating_sub(1))
                    && high.is_some_and(|high| color[i] <= high.saturating_add(1))
            });
            if between {
                edge += 1;
            } else {
                wrong.push((index as u32 % WIDTH, index as u32 / WIDTH, *color, truths[0][index]));
            }
        }
        let pixels = coarse.len();
        println!(
            "{}: {pixels} pixels, {shown} shown, {edge} decided by rounding, {} wrong",
            view.name,
            wrong.len()
        );
        assert!(shown * 5 > pixels as u32, "{}: only {shown} pixels show something", view.name);
        assert!(wrong.is_empty(), "{}: {:?}", view.name, &wrong[..wrong.len().min(9)]);
        assert!(edge * 1000 <= pixels, "{}: {edge} pixels decided by rounding", view.name);
    }
}

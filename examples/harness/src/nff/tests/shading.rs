//! What the numbers of a file do to light.

use nostray::{Pixel, Scalar};

use super::super::load;
use super::{draw, read};

const SIDE: u32 = 33;

/// The colour of a pixel by its column and row.
fn at<S: Scalar>(picture: &[Pixel<S>], x: u32, y: u32) -> [f64; 3] {
    let pixel = &picture[(y * SIDE + x) as usize];
    assert_eq!((pixel.x, pixel.y), (x, y));
    pixel.color.to_array().map(S::to_f64)
}

/// The colour in the middle of a text's picture.
fn middle(text: &str) -> [f64; 3] {
    at(&draw(&read(text), SIDE, SIDE), SIDE / 2, SIDE / 2)
}

fn near(got: [f64; 3], wanted: [f64; 3]) -> bool {
    got.iter().zip(wanted).all(|(got, wanted)| (got - wanted).abs() < 1e-9)
}

/// A view along y with z up, against a background of three different parts.
fn view(rest: &str) -> String {
    format!("b 0.5 0.25 0.125 v from 0 -5 0 at 0 0 0 up 0 0 1 angle 45\n{rest}")
}

#[test]
fn the_picture_is_not_mirrored() {
    // Looking along +y with z up, +x is on the right.
    let balls = "l 0 -5 0
        f 1 0 0 1 0 1 0 1  s 1 0 0 0.5
        f 0 1 0 1 0 1 0 1  s 0 0 1 0.5";
    let picture = draw(&read(&view(balls)), SIDE, SIDE);
    // 1 at distance 5 is this share of the way to the edge of 45 degrees.
    let away = (0.2 / (22.5_f64).to_radians().tan() * 16.5) as u32;
    let (middle, sky) = (SIDE / 2, [0.5, 0.25, 0.125]);
    let red = at(&picture, middle + away, middle);
    let green = at(&picture, middle, middle - away);
    assert!(red[0] > 0.9 && red[1] == 0.0 && red[2] == 0.0, "{red:?}");
    assert!(green[1] > 0.9 && green[0] == 0.0 && green[2] == 0.0, "{green:?}");
    assert_eq!(at(&picture, middle - away, middle), sky);
    assert_eq!(at(&picture, middle, middle + away), sky);
}

#[test]
fn the_angle_is_the_whole_height() {
    // At distance 5 and 45 degrees the half height is 5·tan 22.5°.
    let half = 5.0 * (22.5_f64).to_radians().tan();
    for (share, seen) in [(1.001, true), (0.9, false)] {
        let z = half * share;
        let quad = format!("f 1 1 1 1 0 1 0 1 p 4 -9 0 -{z} 9 0 -{z} 9 0 {z} -9 0 {z}");
        let picture = draw(&read(&view(&format!("l 0 -5 0 {quad}"))), SIDE, SIDE);
        let lit = at(&picture, SIDE / 2, 0) != [0.5, 0.25, 0.125];
        assert_eq!(lit, seen, "{share} of the height");
        assert_eq!(at(&picture, SIDE / 2, SIDE - 1) != [0.5, 0.25, 0.125], seen);
    }
}

#[test]
fn weights_mean_what_the_format_says() {
    // Seen and lit head on: Kd·colour + Ks for each light, and Ks of what is mirrored.
    let ball = "l 0 -5 0  f 0.8 0.4 0.2 0.5 0.25 40 0 0  s 0 0 0 1";
    let wanted = [0.4 + 0.25 + 0.125, 0.2 + 0.25 + 0.0625, 0.1 + 0.25 + 0.03125];
    assert!(near(middle(&view(ball)), wanted), "{:?}", middle(&view(ball)));
    // Two lights in one place are √2 as bright as one; colours are taken as they stand.
    let two = view(&ball.replace("l 0 -5 0", "l 0 -5 0 l 0 -5 0"));
    let lit = |part: f64, sky: f64| (part + 0.25) * 2_f64.sqrt() + sky * 0.25;
    assert!(near(middle(&two), [lit(0.4, 0.5), lit(0.2, 0.25), lit(0.1, 0.125)]));
    let tinted = view(&ball.replace("l 0 -5 0", "l 0 -5 0 1 0 2"));
    assert!(near(middle(&tinted), [0.65 + 0.125, 0.0625, 0.35 * 2.0 + 0.03125]));
    // No light at all but the sky's.
    let dark = view("f 1 1 1 1 0 1 0 0 s 0 0 0 1");
    assert_eq!(middle(&dark), [0.0; 3]);
}

#[test]
fn shine_is_the_exponent_of_the_highlight() {
    // A plane seen from 45 degrees aside of the mirrored light: cos(45°) to the power of Shine.
    let plane = |shine: &str| {
        view(&format!("l 0 -5 5 f 0 0 0 0 1 {shine} 0 0 p 4 -1 0 -1 1 0 -1 1 0 1 -1 0 1"))
    };
    let sky = [0.5, 0.25, 0.125];
    for shine in [0.0, 1.0, 2.0, 2.5, 17.0] {
        let bright = (0.5_f64).sqrt().powf(shine);
        let wanted = sky.map(|part| bright + part);
        let got = middle(&plane(&shine.to_string()));
        assert!(near(got, wanted), "{shine}: {got:?}, not {wanted:?}");
    }
    assert!(near(middle(&plane("100000")), sky));
    // More than single precision holds as a coordinate, and still a number.
    let scene = load::<f32>(&plane("1e300")).expect("read");
    let picture = draw(&scene, SIDE, SIDE);
    assert!(picture.iter().all(|pixel| pixel.color.is_finite()));
}

#[test]
fn glass_bends_light_and_sheets_do_not() {
    let sky = [0.5, 0.25, 0.125];
    let target = "l 0 -9 9 f 1 0 0 1 0 1 0 0 s 0 5 0 1\n";
    let bare = draw(&read(&view(target)), SIDE, SIDE);
    let clear = "f 1 1 1 0 0 1 1 1.5";
    let sheet = format!("{target}{clear} p 4 -9 -2 -9 9 -2 -9 9 -2 9 -9 -2 9");
    let through = draw(&read(&view(&sheet)), SIDE, SIDE);
    for (a, b) in bare.iter().zip(&through) {
        let (a, b) = (a.color.to_array(), b.color.to_array());
        assert!(near(a, b), "a sheet of glass changed {a:?} into {b:?}");
    }
    // A ball in front turns the picture upside down: what is above is seen below.
    let above = "l 0 -9 9 f 1 0 0 1 0 1 0 0 s 0 9 1.5 1\n";
    let lens = draw(&read(&view(&format!("{above}{clear} s 0 0 0 1.5"))), SIDE, SIDE);
    let bare = draw(&read(&view(above)), SIDE, SIDE);
    let half = SIDE / 2;
    let seen = |picture, y| !near(at(picture, half, y), sky);
    assert!(seen(&bare, half - 4) && !seen(&bare, half + 6), "without a lens");
    assert!(seen(&lens, half + 6) && !seen(&lens, half - 4), "with a lens");
    // Light loses nothing but what T takes, once on the way in and once on the way out.
    let dim = view("f 1 1 1 0 0 1 0.5 1.5 s 0 0 0 1");
    assert!(near(middle(&dim), sky.map(|part| part * 0.25)));
}

#[test]
fn negative_radii_are_their_magnitude() {
    let light = "l 1 -5 1 f 1 0.5 0.25 0.7 0.3 9 0 0\n";
    for (negative, positive) in [
        ("s 0 0 0 -1", "s 0 0 0 1"),
        ("c 0 0 -1 -1 0 0 1 -1", "c 0 0 -1 1 0 0 1 1"),
        ("c 0 0 -1 -1 0 0 1 -0.5", "c 0 0 -1 1 0 0 1 0.5"),
        ("c 0 0 -1 -1 0 0 1 0", "c 0 0 -1 1 0 0 1 0"),
    ] {
        let draw = |text: &str| draw(&read(&view(&format!("{light}{text}"))), SIDE, SIDE);
        assert_eq!(draw(negative), draw(positive), "{negative}");
        assert_ne!(at(&draw(negative), SIDE / 2, SIDE / 2), [0.5, 0.25, 0.125]);
    }
}

#[test]
fn patches_are_shaded_by_their_normals() {
    let surface = "l 0 -5 0 f 1 1 1 1 0 1 0 0\n";
    let patch = |count: usize, normal: &str| {
        // No edge goes through the middle.
        let corners = ["-2 0 -2", "2 0 -2", "2 0 3", "-2 0 2"];
        let lines: Vec<_> = corners[..count].iter().map(|c| format!("{c} {normal}\n")).collect();
        view(&format!("{surface}pp {count}\n{}", lines.concat()))
    };
    // The cosine between the light and the normal, whatever the normal's length.
    let slanted = 0.8;
    for count in [3, 4] {
        assert!(near(middle(&patch(count, "0 -1 0")), [1.0; 3]), "{count} corners");
        assert!(near(middle(&patch(count, "0.6 -0.8 0")), [slanted; 3]), "{count} corners");
        assert!(near(middle(&patch(count, "60 -80 0")), [slanted; 3]), "{count} corners");
        assert!(near(middle(&patch(count, "6e-310 -8e-310 0")), [slanted; 3]), "{count} corners");
        assert_eq!(read(&patch(count, "0.6 -0.8 0")).flattened, 0);
    }
    // One normal of no length: flat, and counted.
    let flat = patch(4, "0.6 -0.8 0").replacen("0.6 -0.8 0", "0 0 0", 1);
    assert!(near(middle(&flat), [1.0; 3]), "{:?}", middle(&flat));
    assert_eq!(read(&flat).flattened, 1);
    assert_eq!(read(&flat).skipped, 0);
}

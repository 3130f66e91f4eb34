//! Whatever is read without an error is a legal scene.

use nostray::camera::Lens;
use nostray::{Depth, Render, Scalar, Vector};

use super::super::load;

/// A sequence of numbers that look random, the same each time (D. E. Knuth's MMIX generator).
struct Random(u64);

impl Random {
    fn below(&mut self, end: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % end
    }

    fn pick<'a>(&mut self, words: &[&'a str]) -> &'a str {
        words[self.below(words.len() as u64) as usize]
    }
}

/// Mostly plain numbers, some at the ends of the ranges, few that are refused everywhere.
const NUMBERS: [&str; 25] = [
    "0", "0", "0", "1", "1", "2", "3", "0.5", "0.25", "-1", "-2", "1.5", "7", "1e-3", "1e-7",
    "1e-15", "1e-40", "1e-200", "1e-310", "-0", "1e6", "1e15", "1e18", "1e120", "0.1",
];

const VIEW: &str = "v from 0.1 -5 0.3 at 0 0 0 up 0 0 1 angle 45 f 1 1 1 1 0 1 0 1\n";

/// An entity with about as many numbers as it needs.
fn entity(random: &mut Random) -> String {
    let name =
        random.pick(&["b", "l", "l", "f", "f", "s", "s", "c", "c", "p", "p", "p", "pp", "pp"]);
    let vertices = 3 + random.below(4);
    let numbers = match name {
        "b" => 3,
        "l" => 3 + 3 * random.below(2),
        "s" => 4,
        "p" => 3 * vertices,
        "pp" => 6 * vertices,
        _ => 8,
    };
    let mut text = name.to_string();
    if name.starts_with('p') {
        text += &format!(" {vertices}");
    }
    for _ in 0..numbers {
        // Seldom more than the plain ones, or hardly any entity would be legal.
        let kinds = if random.below(12) == 0 { NUMBERS.len() } else { 12 };
        text += " ";
        text += random.pick(&NUMBERS[..kinds]);
    }
    text + "\n"
}

fn view(random: &mut Random) -> String {
    let mut text = "v".to_string();
    for key in ["from", "at", "up"] {
        text += &format!(" {key}");
        for _ in 0..3 {
            text += " ";
            text += random.pick(&NUMBERS);
        }
    }
    text + " angle " + random.pick(&NUMBERS) + "\n"
}

/// Reads and draws, and tells whether the text was accepted.
fn accepted<S: Scalar>(text: &str) -> bool {
    let Ok(read) = load::<S>(text) else { return false };
    let scene = read.builder.scene();
    let scene = scene.unwrap_or_else(|error| panic!("{}: {error} in\n{text}", S::NAME));
    let lens = Lens::new(&scene.parts().camera, 2, 2);
    assert!(lens.ray(0, 0, [S::HALF; 2]).dir.is_finite(), "{}: no view in\n{text}", S::NAME);
    let render: Render<S> = Render::new(&scene, 2, 2, Depth::fixed(2)).expect("a picture");
    assert_eq!(render.count(), 4);
    true
}

#[test]
fn what_is_read_is_legal() {
    let mut random = Random(2026);
    let (mut single, mut double) = (0, 0);
    for _ in 0..6000 {
        let text = VIEW.to_string() + &entity(&mut random);
        single += u32::from(accepted::<f32>(&text));
        double += u32::from(accepted::<f64>(&text));
    }
    assert!((1500..5900).contains(&single), "{single} accepted in single precision");
    assert!((single..5950).contains(&double), "{double} accepted in double precision");
}

#[test]
fn every_view_that_is_read_is_legal() {
    let mut random = Random(7);
    let (mut single, mut double) = (0, 0);
    for _ in 0..6000 {
        let text = view(&mut random);
        single += u32::from(accepted::<f32>(&text));
        double += u32::from(accepted::<f64>(&text));
    }
    assert!((500..5900).contains(&single), "{single} accepted in single precision");
    assert!((single..5950).contains(&double), "{double} accepted in double precision");
}

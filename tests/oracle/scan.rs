//! The inside of a field along a line, by dense sampling in double precision: no interval, no slope
//! and no polynomial, so that it shares nothing with what it judges.
#![allow(dead_code, unreachable_pub, reason = "each test program uses a part of the oracle")]
#![allow(clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

use super::Random;

/// Where a function is less than `level` between two ends, in ascending order. Neighbouring samples
/// of one sign whose middle one is nearest to the level are searched for a dip between them.
pub fn spans(
    f: impl Fn(f64) -> f64,
    level: f64,
    [from, to]: [f64; 2],
    samples: u32,
) -> Vec<[f64; 2]> {
    let f = |t: f64| f(t) - level;
    let at = |i: u32| from + (to - from) * f64::from(i) / f64::from(samples);
    let values: Vec<f64> = (0..=samples).map(|i| f(at(i))).collect();
    let mut changes = Vec::new();
    for i in 1..=samples {
        let (a, b) = (values[i as usize - 1], values[i as usize]);
        if (a < 0.0) != (b < 0.0) {
            changes.push(bisect(f, [at(i - 1), at(i)]));
        }
        let Some(&c) = values.get(i as usize + 1) else { continue };
        let one_side = (a < 0.0) == (b < 0.0) && (b < 0.0) == (c < 0.0);
        if one_side && b.abs() <= a.abs() && b.abs() <= c.abs() {
            let dip = nearest_to_zero(f, [at(i - 1), at(i + 1)]);
            if (f(dip) < 0.0) != (b < 0.0) {
                changes.push(bisect(f, [at(i - 1), dip]));
                changes.push(bisect(f, [dip, at(i + 1)]));
            }
        }
    }
    changes.sort_by(f64::total_cmp);
    let mut ends = changes;
    if values[0] < 0.0 {
        ends.insert(0, from);
    }
    if ends.len() % 2 == 1 {
        ends.push(to);
    }
    ends.chunks(2).map(|pair| [pair[0], pair[1]]).collect()
}

fn bisect(f: impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2]) -> f64 {
    let negative = f(low) < 0.0;
    for _ in 0..100 {
        let middle = low + (high - low) / 2.0;
        if (f(middle) < 0.0) == negative { low = middle } else { high = middle }
    }
    high
}

/// By the golden section.
fn nearest_to_zero(f: impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2]) -> f64 {
    let ratio = (5_f64.sqrt() - 1.0) / 2.0;
    for _ in 0..80 {
        let (a, b) = (high - (high - low) * ratio, low + (high - low) * ratio);
        if f(a).abs() < f(b).abs() { high = b } else { low = a }
    }
    low + (high - low) / 2.0
}

/// By central differences.
pub fn gradient(f: impl Fn([f64; 3]) -> f64, p: [f64; 3], step: f64) -> [f64; 3] {
    [0, 1, 2].map(|i: usize| {
        let moved = |by: f64| [0, 1, 2].map(|j: usize| if i == j { p[j] + by } else { p[j] });
        (f(moved(step)) - f(moved(-step))) / (2.0 * step)
    })
}

/// The part of a line in a box; `None` beside it.
pub fn within_box(
    origin: [f64; 3],
    dir: [f64; 3],
    min: [f64; 3],
    max: [f64; 3],
) -> Option<[f64; 2]> {
    let (mut from, mut to) = (f64::NEG_INFINITY, f64::INFINITY);
    for i in 0..3 {
        if dir[i] == 0.0 {
            if origin[i] < min[i] || origin[i] > max[i] {
                return None;
            }
            continue;
        }
        let (a, b) = ((min[i] - origin[i]) / dir[i], (max[i] - origin[i]) / dir[i]);
        (from, to) = (from.max(a.min(b)), to.min(a.max(b)));
    }
    (from < to).then_some([from, to])
}

/// A direction at right angles to another.
pub fn across(random: &mut Random, dir: [f64; 3]) -> [f64; 3] {
    let size = super::length(dir);
    let (unit, aside) = (dir.map(|x| x / size), random.direction());
    let along: f64 = (0..3).map(|i| unit[i] * aside[i]).sum();
    let flat = super::along(aside, -along, unit);
    let length = super::length(flat);
    if length < 1e-3 { across(random, dir) } else { flat.map(|x| x / length) }
}

//! The noise fields: range, mean, spectrum, continuity, period, and the same field in every format.
//!
//! `cargo test --test pictures noise -- --nocapture` prints what was measured.
#![allow(clippy::expect_used, clippy::panic, reason = "that is how a test fails")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

use crate::oracle::Random;
use nostray::glam::DVec3;
use nostray::texture::cells::nearest;
use nostray::texture::noise::{
    NOISE_MAX, OCTAVES_MAX, Octaves, Slope, fbm, fbm_slope, noise, noise_slope, turbulence,
    turbulence_slope,
};
use nostray::{Q16, Q32, Scalar, Vector};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

const FIVE: Octaves<f64> = Octaves::new(5);

fn place(random: &mut Random, size: f64) -> DVec3 {
    DVec3::from_array(random.cube()) * size
}

fn convert<S: Scalar>(p: DVec3) -> S::Vec3 {
    S::Vec3::from_array(p.to_array().map(S::from_f64))
}

/// A place on a grid of 2⁻¹², which every format holds exactly.
fn gridded(random: &mut Random, size: f64) -> DVec3 {
    (place(random, size) * 4096.0).floor() / 4096.0
}

/// Mean, standard deviation, least and greatest.
fn statistics(values: impl Iterator<Item = f64>) -> [f64; 4] {
    let (mut n, mut sum, mut squares) = (0.0, 0.0, 0.0);
    let (mut least, mut most) = (f64::MAX, f64::MIN);
    for value in values {
        assert!(value.is_finite());
        n += 1.0;
        sum += value;
        squares += value * value;
        (least, most) = (least.min(value), most.max(value));
    }
    let mean = sum / n;
    [mean, f64::sqrt(squares / n - mean * mean), least, most]
}

#[test]
fn the_range_and_the_mean_are_those_on_record() {
    let mut random = Random::new(11);
    let mut places = move || place(&mut random, 1000.0);
    let [mean, deviation, least, most] =
        statistics((0..1_000_000).map(|_| noise::<f64>(places(), 3)));
    println!("noise: mean {mean:.4}, deviation {deviation:.4}, {least:.4} to {most:.4}");
    assert!(mean.abs() <= 0.002 && (deviation - 0.27).abs() <= 0.01);
    assert!(least >= -NOISE_MAX && most <= NOISE_MAX && least < -0.85 && most > 0.85);

    let mut random = Random::new(12);
    let mut places = move || place(&mut random, 1000.0);
    let [mean, deviation, least, most] =
        statistics((0..200_000).map(|_| fbm::<f64>(places(), 3, &FIVE)));
    println!("fbm of 5: mean {mean:.4}, deviation {deviation:.4}, {least:.4} to {most:.4}");
    assert!(mean.abs() <= 0.003 && least >= -NOISE_MAX && most <= NOISE_MAX);

    let mut random = Random::new(13);
    let mut places = move || place(&mut random, 1000.0);
    let [mean, deviation, least, most] =
        statistics((0..200_000).map(|_| turbulence::<f64>(places(), 3, &FIVE)));
    println!("turbulence of 5: mean {mean:.4}, deviation {deviation:.4}, {least:.4} to {most:.4}");
    assert!((mean - 0.22).abs() <= 0.01 && least >= 0.0 && most <= NOISE_MAX);
}

/// The greatest that any choice of gradients can make of a place in a cell: the corners' gradients are free
/// of each other, and the best one of a corner gives the sum of the two greater distances along the axes.
#[test]
fn no_choice_of_gradients_leaves_the_range() {
    let fade = |t: f64| t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let (mut most, steps) = (0.0_f64, 60);
    for n in 0..=steps * steps * steps / 8 {
        let m = steps / 2;
        let p = [n % m, n / m % m, n / (m * m)]
            .map(|v| f64::from(v) / f64::from(steps) + 0.5 / f64::from(steps));
        let mut sum = 0.0;
        for corner in 0..8 {
            let mut weight = 1.0;
            let mut away = [0.0; 3];
            for (axis, (away, v)) in away.iter_mut().zip(p).enumerate() {
                let far = corner >> axis & 1 == 1;
                weight *= if far { fade(v) } else { 1.0 - fade(v) };
                *away = if far { 1.0 - v } else { v };
            }
            let [x, y, z] = away;
            sum += weight * (x + y + z - x.min(y).min(z));
        }
        most = most.max(sum);
    }
    println!("the greatest that gradients can make: {most:.5}");
    assert!(most <= NOISE_MAX && most > NOISE_MAX - 0.002);
}

/// The shares of the power of the field along lines in any direction, by cycles per unit of length.
#[test]
fn the_power_lies_where_it_is_said_to() {
    const LEN: usize = 256;
    const STEP: f64 = 1.0 / 8.0;
    let mut random = Random::new(14);
    let mut power = [0.0; LEN / 2];
    for _ in 0..200 {
        let (from, dir) = (place(&mut random, 500.0), DVec3::from_array(random.direction()));
        let line: Vec<f64> = (0..LEN)
            .map(|n| {
                // A window, so that the ends do not show.
                let window = f64::sin(std::f64::consts::PI * n as f64 / LEN as f64).powi(2);
                noise::<f64>(from + dir * (STEP * n as f64), 8) * window
            })
            .collect();
        for (k, power) in power.iter_mut().enumerate() {
            let turn = |n: usize| std::f64::consts::TAU * (k * n) as f64 / LEN as f64;
            let re: f64 = line.iter().enumerate().map(|(n, v)| v * f64::cos(turn(n))).sum();
            let im: f64 = line.iter().enumerate().map(|(n, v)| v * f64::sin(turn(n))).sum();
            *power += re * re + im * im;
        }
    }
    let whole: f64 = power.iter().sum();
    let below = |cycles: f64| {
        let last = (cycles * STEP * LEN as f64) as usize;
        power.iter().take(last).sum::<f64>() / whole
    };
    for cycles in [0.1, 0.2, 0.33, 0.5, 1.0, 1.5] {
        println!("below {cycles} cycles: {:.3}", below(cycles));
    }
    assert!(below(1.0) >= 0.985 && (below(0.33) - 0.5).abs() <= 0.05);
}

/// The field and its gradient just before and just behind a wall of cells.
fn no_step_at_walls(field: impl Fn(DVec3) -> Slope<f64>) {
    let mut random = Random::new(15);
    for n in 0..20_000 {
        let mut p = place(&mut random, 40.0);
        let axis = n % 3;
        let mut away = DVec3::ZERO;
        if let (Some(v), Some(step)) = (p.as_mut().get_mut(axis), away.as_mut().get_mut(axis)) {
            (*v, *step) = (v.floor(), 1e-9);
        }
        let (before, behind) = (field(p - away), field(p + away));
        assert!((before.value - behind.value).abs() <= 1e-7, "{p}: {before:?} {behind:?}");
        let jump = (before.gradient - behind.gradient).abs().max_element();
        assert!(jump <= 1e-6, "{p}: {before:?} {behind:?}");
    }
}

#[test]
fn neither_the_field_nor_its_gradient_steps_at_a_cell() {
    no_step_at_walls(|p| noise_slope::<f64>(p, 4));
    no_step_at_walls(|p| fbm_slope::<f64>(p, 4, &FIVE));
}

#[test]
fn gradients_are_the_slopes_of_the_fields() {
    let mut random = Random::new(16);
    type Field<'a, T> = &'a dyn Fn(DVec3) -> T;
    let fields: [(Field<'_, f64>, Field<'_, Slope<f64>>); 3] = [
        (&|p| noise::<f64>(p, 6), &|p| noise_slope::<f64>(p, 6)),
        (&|p| fbm::<f64>(p, 6, &FIVE), &|p| fbm_slope::<f64>(p, 6, &FIVE)),
        (&|p| turbulence::<f64>(p, 6, &FIVE), &|p| turbulence_slope::<f64>(p, 6, &FIVE)),
    ];
    for (value, slope) in fields {
        let mut off = 0;
        for _ in 0..5_000 {
            let p = place(&mut random, 40.0);
            let found = slope(p);
            assert!((found.value - value(p)).abs() <= 1e-14);
            let expected = DVec3::from_array(
                [DVec3::X, DVec3::Y, DVec3::Z]
                    .map(|axis| (value(p + axis * 1e-6) - value(p - axis * 1e-6)) / 2e-6),
            );
            assert!(found.gradient.abs().max_element() <= 4.0 * 5.0);
            off += usize::from((found.gradient - expected).abs().max_element() > 1e-7);
        }
        // Turbulence has creases, and a difference across one is not a slope.
        assert!(off <= 5, "{off} gradients differ");
    }
}

/// What one format makes of the fields, at most so far from f64.
fn the_same_field<S: Scalar>(error_max: f64) {
    let mut random = Random::new(17);
    let mut worst = [0.0_f64; 4];
    for _ in 0..20_000 {
        let p = gridded(&mut random, 100.0);
        let here = convert::<S>(p);
        let five = Octaves::new(5);
        let found = [
            noise::<S>(here, 7),
            fbm::<S>(here, 7, &five),
            turbulence::<S>(here, 7, &five),
            nearest::<S>(here, 7).first,
        ];
        let expected = [
            noise::<f64>(p, 7),
            fbm::<f64>(p, 7, &FIVE),
            turbulence::<f64>(p, 7, &FIVE),
            nearest::<f64>(p, 7).first,
        ];
        for ((worst, found), expected) in worst.iter_mut().zip(found).zip(expected) {
            *worst = worst.max((found.to_f64() - expected).abs());
        }
        assert_eq!(noise_slope::<S>(here, 7).value, noise::<S>(here, 7));
    }
    println!("{}: greatest differences from f64 {worst:?}", S::NAME);
    assert!(worst.iter().all(|worst| *worst <= error_max), "{}: {worst:?}", S::NAME);
    assert!(S::NAME == "f64" || worst.iter().all(|worst| *worst > 0.0));
}

#[test]
fn every_format_has_the_same_field() {
    the_same_field::<f32>(2e-6);
    the_same_field::<f64>(0.0);
    the_same_field::<Q16>(4e-4);
    the_same_field::<Q32>(6e-9);
}

#[test]
fn the_field_repeats_after_the_period_and_not_before() {
    let mut random = Random::new(18);
    let period = 4_294_967_296.0;
    let mut same = 0;
    for _ in 0..20_000 {
        let p = gridded(&mut random, 1000.0);
        let field = |p: DVec3| (noise::<f64>(p, 2), fbm::<f64>(p, 2, &FIVE));
        assert_eq!(field(p), field(p + DVec3::new(period, -period, 2.0 * period)));
        same += u32::from(field(p) == field(p + DVec3::X * (period / 2.0)));
        same += u32::from(field(p) == field(p + DVec3::Z * 256.0));
    }
    assert!(same < 10, "{same} places are the same elsewhere");
}

/// Near, far, negative and huge places, every fourth of them a corner of the lattice.
#[test]
fn a_million_places_keep_the_range_and_the_period() {
    let mut random = Random::new(21);
    let period = DVec3::new(-4_294_967_296.0, 8_589_934_592.0, 4_294_967_296.0);
    let sizes = [4.0, 1e3, 1e6, 1e11, 1e18, 1e300];
    for (index, size) in (0..1_000_000).zip(sizes.into_iter().cycle()) {
        let p = gridded(&mut random, size);
        let p = if index % 4 == 0 { p.floor() } else { p };
        let value = noise::<f64>(p, 4);
        assert!((-NOISE_MAX..=NOISE_MAX).contains(&value), "{value} at {p}");
        // Up to there a sum on the grid is exact.
        if size <= 1e11 {
            assert_eq!(noise::<f64>(p + period, 4), value, "{p}");
        }
    }
}

#[test]
fn corners_of_the_lattice_are_nought_and_octaves_are_not() {
    let mut random = Random::new(19);
    let mut noughts = 0;
    for _ in 0..1000 {
        let p = place(&mut random, 1e6).floor();
        assert_eq!(noise::<f64>(p, 1), 0.0);
        noughts += u32::from(fbm::<f64>(p, 1, &FIVE) == 0.0);
    }
    assert!(noughts < 5);
}

#[test]
fn cells_have_no_step_in_their_distances() {
    let mut random = Random::new(20);
    let mut changed = 0;
    for _ in 0..50_000 {
        let p = place(&mut random, 50.0);
        let q = p + DVec3::from_array(random.direction()) * 1e-3;
        let (a, b) = (nearest::<f64>(p, 3), nearest::<f64>(q, 3));
        assert!((a.first - b.first).abs() <= 1.001e-3 && (a.second - b.second).abs() <= 1.001e-3);
        assert!(a.first <= a.second);
        if a.cell != b.cell {
            changed += 1;
            assert!(a.second - a.first <= 2.1e-3, "a cell ends where two points are equally near");
        }
    }
    assert!(changed > 50);
}

/// Any number that a format has.
fn any_place<S: Scalar>() -> impl Strategy<Value = (S, S, S)> {
    let number = || {
        prop_oneof![
            any::<f64>().prop_map(S::from_f64),
            (-1e4..1e4).prop_map(S::from_f64),
            (-40_000_i32..40_000).prop_map(S::from_i32),
            Just(S::FAR),
            Just(-S::FAR),
            // Not a number, where there is such a thing.
            Just(S::FAR + -S::FAR),
            Just(S::TINY),
            Just(-S::TINY),
        ]
    };
    (number(), number(), number())
}

fn finite_anywhere<S: Scalar>((x, y, z): (S, S, S), seed: u32, count: u8, gain: f64) {
    let p = S::Vec3::new(x, y, z);
    let sum = Octaves { count, gain: S::from_f64(gain) };
    let most = S::from_f64(NOISE_MAX + 0.001);
    let slopes =
        [noise_slope::<S>(p, seed), fbm_slope(p, seed, &sum), turbulence_slope(p, seed, &sum)];
    for (slope, again) in
        slopes.into_iter().zip([noise::<S>(p, seed), fbm(p, seed, &sum), turbulence(p, seed, &sum)])
    {
        assert!(slope.value == again && again >= -most && again <= most);
        assert!(slope.gradient.is_finite());
    }
    let nearest = nearest::<S>(p, seed);
    let (first, second) = (nearest.first, nearest.second);
    assert!(first >= S::ZERO && first <= second && second < S::from_i32(3));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default() })]

    #[test]
    fn no_place_is_out_of_range(
        single in any_place::<f32>(),
        double in any_place::<f64>(),
        coarse in any_place::<Q16>(),
        fine in any_place::<Q32>(),
        seed: u32,
        count in 1..=OCTAVES_MAX,
        gain in 0.0..=1.0,
    ) {
        finite_anywhere::<f32>(single, seed, count, gain);
        finite_anywhere::<f64>(double, seed, count, gain);
        finite_anywhere::<Q16>(coarse, seed, count, gain);
        finite_anywhere::<Q32>(fine, seed, count, gain);
    }
}

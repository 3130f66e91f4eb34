//! The fused operations of the scalars against exact arithmetic.
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]

mod oracle;

use nostray::ray::Line;
use nostray::{Ray, Vector};
use oracle::{Float, Random, Real, along, array, dot, point, ulp, vector};

/// A number of any sign and of one of many magnitudes.
fn wide<S: Float>(random: &mut Random) -> S {
    S::from_f64(random.decades(-4.0, 4.0) * random.sign())
}

/// A number moved by a few units in the last place.
fn nudged<S: Float>(random: &mut Random, x: S) -> S {
    x + x * S::EPSILON * S::from_i32(random.below(5) as i32 - 2)
}

fn determinants<S: Float>(cases: u32) {
    let mut random = Random::new(1);
    let mut ties = 0;
    for _ in 0..cases {
        let [a, b, c] = [0; 3].map(|_| wide::<S>(&mut random));
        // So that a·b and c·d are equal or nearly so.
        let d = nudged(&mut random, a * b / c);
        let exact = Real::of(a) * Real::of(b) - Real::of(c) * Real::of(d);
        let found = S::det2(a, b, c, d);
        assert_eq!(Real::of(found).sign(), exact.sign(), "{a}·{b} − {c}·{d}");
        ties += u32::from(a * b == c * d);
    }
    assert!(ties > cases / 20, "{ties} rounded ties");
}

fn quotients<S: Float>(cases: u32) {
    let mut random = Random::new(2);
    let mut equal = 0;
    for n in 0..cases {
        let ([a, o, d], e) = ([0; 3].map(|_| wide::<S>(&mut random)), wide::<S>(&mut random));
        let p = wide::<S>(&mut random);
        let mut b = nudged(&mut random, (a - o) / d * e + p);
        let mut second = (b, p, e);
        if n % 4 == 0 {
            // The same quotient, times a power of two.
            b = (a - o) * S::TWO;
            second = (b, S::ZERO, d * S::TWO);
        }
        let exact = |(a, o, d): (S, S, S)| (Real::of(a) - Real::of(o)) / Real::of(d);
        let difference = exact((a, o, d)) - exact(second);
        let found = S::precedes((a, o, d), second);
        equal += u32::from(difference.sign() == 0);
        // Quotients that are equal may differ in the last of the 300 bits.
        let sign = if difference.abs().to_f64() < 1e-70 { 0 } else { difference.sign() };
        assert_eq!(found, sign < 0, "{a} {o} {d} {second:?}");
        assert!(!(found && S::precedes(second, (a, o, d))));
    }
    assert!(equal > cases / 50, "{equal} equal quotients");
}

fn products<S: Float>(cases: u32) {
    let mut random = Random::new(3);
    for _ in 0..cases {
        let a = vector::<S>(random.cube());
        let [x, y, _] = random.cube();
        // Nearly at right angles.
        let z = -(a.x().to_f64() * x + a.y().to_f64() * y) / a.z().to_f64();
        let b = vector::<S>([x, y, z]);
        let exact = dot(&point::<S>(a), &point::<S>(b));
        let error = (Real::of(S::dot_wide(a, b)) - &exact).abs().to_f64();
        let size = (0..3).map(|i| (array::<S>(a)[i] * array::<S>(b)[i]).abs()).sum::<f64>();
        let eps = S::EPSILON.to_f64();
        assert!(error <= ulp::<S>(exact.to_f64()) + 4.0 * eps * eps * size, "{a:?} {b:?}");
    }
}

fn recentring<S: Float>(cases: u32) {
    let mut random = Random::new(4);
    for _ in 0..cases {
        let (center, dir) = (random.cube(), random.direction());
        let distance = random.decades(0.0, 7.0);
        let origin = vector::<S>(along(center, -distance, dir));
        let (center, dir) = (vector::<S>(center), vector::<S>(dir));
        let k = S::from_f64(distance);
        let found = Line::new(Ray { origin, dir }, None).recentred(center, k);
        for i in 0..3 {
            let [o, c, d, found] = [origin, center, dir, found].map(|v| Real::of(v.to_array()[i]));
            let exact = o - c + Real::of(k) * d;
            let error = (found - &exact).abs().to_f64();
            let eps = S::EPSILON.to_f64();
            let bound = ulp::<S>(exact.to_f64()) + 4.0 * eps * eps * distance;
            assert!(error <= bound, "{error:e} at {distance:e}");
        }
    }
}

#[test]
fn determinants_have_their_exact_sign() {
    determinants::<f32>(20_000);
    determinants::<f64>(20_000);
}

#[test]
fn quotients_are_ordered_exactly() {
    quotients::<f32>(20_000);
    quotients::<f64>(20_000);
}

#[test]
fn dot_products_are_rounded_once() {
    products::<f32>(20_000);
    products::<f64>(20_000);
}

#[test]
fn recentring_does_not_cancel() {
    recentring::<f32>(20_000);
    recentring::<f64>(20_000);
}

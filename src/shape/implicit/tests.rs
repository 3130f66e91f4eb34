//! Programs and what is refused of them; the work that the worst of them make.

extern crate std;

use std::vec::Vec;

use super::program::*;
use super::*;
use crate::fixed_point::{Q16, Q32};
use crate::ray::{Line, Ray};

/// x² + y² + z² − numbers[0].
const BALL: &[u8] = &[X, SQUARE, Y, SQUARE, ADD, Z, SQUARE, ADD, NUMBER, 0, SUB];

/// sin x · cos y + sin y · cos z + sin z · cos x.
const GYROID: &[u8] = &[X, SIN, Y, COS, MUL, Y, SIN, Z, COS, MUL, ADD, Z, SIN, X, COS, MUL, ADD];

fn flaw(code: &[u8]) -> Option<(u32, &'static str)> {
    check(code, &[1.0_f64, -1.0]).err().map(|flaw| (flaw.byte, flaw.what))
}

#[test]
fn what_is_no_formula_is_refused_at_its_byte() {
    assert_eq!(flaw(BALL), None);
    assert_eq!(flaw(&[]), Some((0, "leaves no result")));
    assert_eq!(flaw(&[X, Y]), Some((2, "leaves more than one result")));
    assert_eq!(flaw(&[X, ADD]), Some((1, "takes more from the stack than there is")));
    assert_eq!(flaw(&[NEG]), Some((0, "takes more from the stack than there is")));
    assert_eq!(flaw(&[X, COS + 1]), Some((1, "is not an operation")));
    assert_eq!(flaw(&[X, 255]), Some((1, "is not an operation")));
    assert_eq!(flaw(&[X, NUMBER]), Some((1, "lacks the byte that belongs to it")));
    assert_eq!(flaw(&[NUMBER, 2]), Some((0, "names a number beyond those of the program")));
    assert_eq!(flaw(&[X, REAL_POWER, 1]), Some((1, "needs a number greater than 0")));
    assert_eq!(flaw(&[X, Y, SMOOTH_MIN, 1]), Some((2, "needs a number greater than 0")));
    assert_eq!(flaw(&[X, POWER, 0]), Some((1, "needs an exponent of at least 1")));
    assert_eq!(flaw(&[X, COPY, 1]), Some((1, "copies an entry that is not there")));
    assert_eq!(flaw(&[X; STACK_MAX + 1]), Some((8, "needs more room than the stack has")));
}

fn value(code: &[u8], numbers: &[f64], p: [f64; 3]) -> f64 {
    assert_eq!(check(code, numbers), Ok(()), "{code:?}");
    run::<f64, f64>(code, numbers, p.map(Dual::constant)).value
}

#[test]
fn every_operation_does_what_the_table_says() {
    let p = [3.0, -2.0, 0.5];
    let numbers = [4.0, 1.5];
    let of = |code: &[u8]| value(code, &numbers, p);
    assert_eq!(of(&[X]), 3.0);
    assert_eq!(of(&[Y, Z, ADD]), -1.5);
    assert_eq!(of(&[Y, Z, SUB]), -2.5);
    assert_eq!(of(&[Y, Z, MUL]), -1.0);
    assert_eq!(of(&[Y, Z, DIV]), -4.0);
    assert_eq!(of(&[Y, X, X, SUB, DIV]), 0.0);
    assert_eq!(of(&[X, Y, COPY, 1, MUL, ADD]), 3.0 - 6.0);
    assert_eq!(of(&[Y, NEG]), 2.0);
    assert_eq!(of(&[Y, ABS]), 2.0);
    assert_eq!(of(&[Y, SQUARE]), 4.0);
    assert_eq!(of(&[Y, POWER, 1]), -2.0);
    assert_eq!(of(&[Y, POWER, 5]), -32.0);
    assert_eq!(of(&[Y, REAL_POWER, 1]), libm::pow(2.0, 1.5));
    assert_eq!(of(&[X, NUMBER, 0, MUL, ROOT]), libm::sqrt(12.0));
    assert_eq!(of(&[Y, ROOT]), 0.0);
    assert_eq!(of(&[X, Y, MIN]), -2.0);
    assert_eq!(of(&[X, Y, MAX]), 3.0);
    // Two that differ by 1 where 4 is the width: ¾² · 4 / 4 less.
    assert_eq!(of(&[X, NUMBER, 0, SMOOTH_MIN, 0]), 3.0 - 0.5625);
    assert_eq!(of(&[X, Y, SMOOTH_MIN, 0]), -2.0);
    assert!((of(&[X, SIN]) - libm::sin(3.0)).abs() < 1e-15);
    assert!((of(&[X, COS]) - libm::cos(3.0)).abs() < 1e-15);
}

#[test]
fn spans_are_bounded_by_the_degrees_of_polynomials() {
    assert_eq!(spans_bound(&[X]), Some(1));
    assert_eq!(spans_bound(BALL), Some(2));
    assert_eq!(spans_bound(&[X, POWER, 7, Y, ADD]), Some(4));
    assert_eq!(spans_bound(&[X, SQUARE, COPY, 0, MUL, NUMBER, 0, SUB]), Some(3));
    // Two planes: each piece has one root at most, and they meet once.
    assert_eq!(spans_bound(&[X, Y, MIN]), Some(2));
    assert_eq!(spans_bound(&[X, ABS, NUMBER, 0, SUB]), Some(2));
    assert_eq!(spans_bound(&[X, NUMBER, 0, DIV]), Some(1));
    for code in [&[X, SIN][..], &[X, ROOT], &[X, Y, DIV], &[X, REAL_POWER, 0]] {
        assert_eq!(spans_bound(code), None);
    }
    // Far beyond any table, but no overflow.
    let mut code = Vec::from([X]);
    code.extend([POWER, 255].repeat(40));
    code.extend([COPY, 0, ABS, MIN]);
    assert_eq!(spans_bound(&code), Some(u32::MAX / 2 + 1));
}

/// The boundaries along a ray in a box from −4 to 4, and the evaluations by intervals.
fn crossings<S: Scalar>(code: &[u8], numbers: &[f64], ray: [[f64; 3]; 2]) -> (u32, u32) {
    let numbers: Vec<S> = numbers.iter().copied().map(S::from_f64).collect();
    let corners = [S::Vec3::splat(S::from_i32(-4)), S::Vec3::splat(S::from_i32(4))];
    let tables = Tables { points: &corners, numbers: &numbers, code, ..Tables::EMPTY };
    let shape = Implicit::<S> {
        center: S::Vec3::ZERO,
        corners: 0,
        code: 0,
        numbers: 0,
        code_len: code.len() as u16,
        numbers_len: numbers.len() as u16,
        spans: 100,
    };
    assert_eq!(shape.check(false, &tables), Ok(()));
    let [origin, dir] = ray;
    let dir = S::unit(S::WideVec::from_array(dir.map(S::Wide::from_f64)));
    let line = Line::new(Ray { origin: S::Vec3::from_array(origin.map(S::from_f64)), dir }, None);
    let sight = Sight { line: &line, place: None, start: None, tables: &tables };
    let Reach { ray, span, .. } = shape.reach(&sight).expect("a ray through the box");
    let start = Dual { value: S::Wide::ZERO, slope: S::Wide::ZERO };
    let along = Along { code, numbers: &numbers, ray, start };
    let inside = along.is_inside(span.enter.t);
    let mut found = Crossings::new(&along, [span.enter.t, span.exit.t], false, inside);
    let (mut count, mut last) = (0, span.enter.t);
    while let Some(t) = found.next(S::FAR) {
        assert!(last <= t && t <= span.exit.t, "{t:?} after {last:?}");
        (count, last) = (count + 1, t);
    }
    assert_eq!(found.inside, along.is_inside(span.exit.t));
    let most = Crossings::<S>::evaluations_max();
    assert!(found.evaluations() <= most, "{} evaluations of {most}", found.evaluations());
    (count, found.evaluations())
}

/// What cannot be told anywhere along a ray, or only in ever smaller pieces, ends within the bound.
fn worst_cases<S: Scalar>() {
    let across = [[-9.0, 0.3, 0.2], [1.0, 0.01, 0.02]];
    let most = Crossings::<S>::evaluations_max();
    // 0 everywhere, by cancellation that intervals cannot see.
    let nothing = &[X, SIN, COPY, 0, SUB];
    let (count, taken) = crossings::<S>(nothing, &[], across);
    assert_eq!(count, 0);
    assert!(taken > most / 2, "{taken} evaluations of {most}");
    // A thousand roots and more.
    let fast = &[NUMBER, 0, X, MUL, SIN];
    let (_, taken) = crossings::<S>(fast, &[3000.0], across);
    assert!(taken > most / 2, "{taken} evaluations of {most}");
    // Of which nothing is known beyond the axis.
    let wild = &[NUMBER, 0, X, DIV, SIN];
    crossings::<S>(wild, &[1.0], across);
    // Overflow in floats, nowhere a number.
    let huge = &[X, POWER, 255, COPY, 0, SUB, X, MUL];
    crossings::<S>(huge, &[], across);
    // A line within the surface: the gyroid contains straight ones.
    let line = [[-9.0, 0.0, core::f64::consts::FRAC_PI_2], [1.0, 0.0, 0.0]];
    crossings::<S>(GYROID, &[], line);
}

#[test]
fn work_is_bounded() {
    worst_cases::<f32>();
    worst_cases::<f64>();
    worst_cases::<Q16>();
    worst_cases::<Q32>();
}

#[test]
fn a_ray_that_touches_is_not_inside() {
    for (height, roots) in [(1.0, 0), (1.0 + 1e-9, 0), (1.0 - 1e-9, 2), (0.5, 2)] {
        let ray = [[-9.0, height, 0.0], [1.0, 0.0, 0.0]];
        assert_eq!(crossings::<f64>(BALL, &[1.0], ray).0, roots, "{height}");
    }
    assert_eq!(crossings::<f32>(BALL, &[1.0], [[-9.0, 1.0, 0.0], [1.0, 0.0, 0.0]]).0, 0);
}

//! Sine and cosine by `+`, `−` and `×` alone, with a stated error.

use crate::scalar::{Real, Scalar};

/// Beyond this magnitude a sine is not told from any other number between −1 and 1.
pub(super) const ARGUMENT_MAX: i32 = 1 << 16;

/// π/2 in three parts, the first two of so few bits that a product with a small whole number is exact.
///
/// Source: W. J. Cody and W. Waite, *Software Manual for the Elementary Functions* (1980), chapter 8.
const QUARTER: [f64; 3] = [201.0 / 128.0, 507.0 / 1_048_576.0, 3.139_164_786_504_813e-7];

/// The coefficients of x¹⁷ to x.
const SINE: [f64; 9] = [
    1.0 / 355_687_428_096_000.0,
    -1.0 / 1_307_674_368_000.0,
    1.0 / 6_227_020_800.0,
    -1.0 / 39_916_800.0,
    1.0 / 362_880.0,
    -1.0 / 5_040.0,
    1.0 / 120.0,
    -1.0 / 6.0,
    1.0,
];

/// The coefficients of x¹⁶ to 1.
const COSINE: [f64; 9] = [
    1.0 / 20_922_789_888_000.0,
    -1.0 / 87_178_291_200.0,
    1.0 / 479_001_600.0,
    -1.0 / 3_628_800.0,
    1.0 / 40_320.0,
    -1.0 / 720.0,
    1.0 / 24.0,
    -1.0 / 2.0,
    1.0,
];

/// How many terms of the series are needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Digits {
    /// Five, for formats of 24 bits: the next one is below 2⁻²⁵.
    Single,
    /// Nine: the next one is below 2⁻⁵⁸.
    Double,
}

impl Digits {
    /// What is enough for a format.
    #[inline]
    pub(crate) fn of<S: Scalar>() -> Self {
        if S::EPSILON_ROOT.to_f64() > 1e-4 { Self::Single } else { Self::Double }
    }
}

/// How far [`sin_cos`] of x may lie from the exact values, up to [`ARGUMENT_MAX`].
pub(super) fn error<T: Real>(x: T, digits: Digits) -> T {
    let rounding = T::EPSILON * (T::from_i32(2) + x.abs() * T::from_ratio(1, 1024));
    match digits {
        Digits::Single => rounding + T::from_ratio(1, 1 << 25),
        Digits::Double => rounding,
    }
}

/// Sine and cosine of an angle in radians, between −1 and 1.
///
/// What the angle is more than a multiple of π/2 goes into the Taylor series.
pub(super) fn sin_cos<T: Real>(x: T, digits: Digits) -> (T, T) {
    let turns = (x * T::from_f64(core::f64::consts::FRAC_2_PI)).nearest();
    let n = T::from_i32(turns);
    let reduced = QUARTER.iter().fold(x, |left, &part| left - n * T::from_f64(part));
    let square = reduced.squared();
    let left_out = if digits == Digits::Single { 4 } else { 0 };
    let series = |terms: &[f64; 9]| {
        let needed = terms.iter().skip(left_out);
        needed.fold(T::ZERO, |sum, &term| sum * square + T::from_f64(term))
    };
    let clamped = |v: T| v.clamp(-T::ONE, T::ONE);
    let (sin, cos) = (clamped(reduced * series(&SINE)), clamped(series(&COSINE)));
    match turns & 3 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

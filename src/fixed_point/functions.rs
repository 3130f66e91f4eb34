//! Sines, logarithms and the like, for [`Wide`]: arguments are reduced, and a series of known
//! error does the rest. Each is within 2⁻⁵⁶ of the exact value, relative or for sines absolute.

use super::Wide;
use crate::scalar::{Number, Real};

/// ln 2.
const LN_2: Wide = Wide::from_parts(0x58b9_0bfb_e8e7_bcd6, -63);

/// Σ (−x²)ⁿ·x^`odd` / (2n + `odd`)!, for |x| ≤ π/4: sine or cosine by their Taylor series.
fn series(x: Wide, odd: i32) -> Wide {
    let square = -x.squared();
    let mut sum = Wide::ONE;
    // Ten terms: (π/4)²⁰ / 20! is below 2⁻⁶⁸.
    for n in (1..=10).rev() {
        let m = 2 * n + odd;
        sum = Wide::ONE + square * sum / Wide::from_i32(m * (m - 1));
    }
    if odd == 1 { x * sum } else { sum }
}

/// Sine and cosine of an angle in radians.
pub(super) fn sin_cos(x: Wide) -> (Wide, Wide) {
    let quarter = Wide::PI * Wide::HALF;
    let turns = (x / quarter).nearest();
    let reduced = x - quarter * Wide::from_parts(turns, 0);
    let (sin, cos) = (series(reduced, 1), series(reduced, 0));
    match turns & 3 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// The angle whose tangent is x, for 0 ≤ x ≤ 1.
fn atan(mut x: Wide) -> Wide {
    // atan x = 2·atan(x / (1 + √(1 + x²))), three times: x is then below 0.1.
    for _ in 0..3 {
        x = x / (Wide::ONE + (Wide::ONE + x.squared()).sqrt());
    }
    let square = -x.squared();
    let mut sum = Wide::ZERO;
    // Eleven terms: 0.0985²² / 23 is below 2⁻⁷⁸.
    for n in (0..11).rev() {
        sum = Wide::ONE / Wide::from_i32(2 * n + 1) + square * sum;
    }
    (x * sum).doubled(3)
}

/// The angle of the point (x, y) in −π..=π; 0 for the origin.
pub(super) fn atan2(y: Wide, x: Wide) -> Wide {
    let (a, b) = (x.abs(), y.abs());
    if a == Wide::ZERO && b == Wide::ZERO {
        return Wide::ZERO;
    }
    let first = if b <= a { atan(b / a) } else { Wide::PI * Wide::HALF - atan(a / b) };
    let half = if x < Wide::ZERO { Wide::PI - first } else { first };
    if y < Wide::ZERO { -half } else { half }
}

/// eˣ; 0 and [`Real::FAR`] beyond what has an exponent.
pub(super) fn exp(x: Wide) -> Wide {
    let power = (x / LN_2).nearest();
    let reduced = x - LN_2 * Wide::from_parts(power, 0);
    let mut sum = Wide::ONE;
    // Sixteen terms: (ln 2 / 2)¹⁷ / 17! is below 2⁻⁷⁴.
    for n in (1..=16).rev() {
        sum = Wide::ONE + reduced * sum / Wide::from_i32(n);
    }
    sum.doubled(power.clamp(-1 << 20, 1 << 20) as i32)
}

/// The natural logarithm of a positive number.
fn ln(x: Wide) -> Wide {
    // m in √½..√2 times a power of two.
    let mut power = x.magnitude_exponent();
    let mut m = x.doubled(-power);
    if m > Wide::from_ratio(7, 5) {
        (m, power) = (m * Wide::HALF, power + 1);
    }
    // ln m = 2·artanh((m − 1)/(m + 1)), of at most 0.18.
    let z = (m - Wide::ONE) / (m + Wide::ONE);
    let square = z.squared();
    let mut sum = Wide::ZERO;
    // Fourteen terms: 0.18²⁸ / 29 is below 2⁻⁷³.
    for n in (0..14).rev() {
        sum = Wide::ONE / Wide::from_i32(2 * n + 1) + square * sum;
    }
    (z * sum).doubled(1) + LN_2 * Wide::from_i32(power)
}

/// `x` to the power `e`, for x ≥ 0; 0⁰ is 1.
pub(super) fn pow(x: Wide, e: Wide) -> Wide {
    if e == Wide::ZERO {
        Wide::ONE
    } else if x <= Wide::ZERO {
        if e > Wide::ZERO { Wide::ZERO } else { Wide::FAR }
    } else {
        exp(e * ln(x))
    }
}

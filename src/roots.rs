//! Real roots of polynomials on an interval: first isolated, then refined.
//!
//! Between two neighbouring roots of its derivative a polynomial is monotone, so it changes its
//! sign there at most once, and whether it does is told by the signs at the two ends. The roots
//! of the derivative come from those of the second derivative in the same way, and so on from the
//! bottom of the chain: no recursion, no list of intervals, and no root that depends on where a
//! search happened to start.
//!
//! A root here is a change of sign. A value of 0 counts as positive, so a double root that is
//! exactly touched from above is none; the number of roots between two ends is odd exactly where
//! the signs at these ends differ, whatever rounding does in between.
//!
//! Two bases are offered. [`crossings`] takes coefficients of powers; [`bernstein_crossings`] those
//! of Bernstein's polynomials on 0..=1, which are better conditioned and whose own changes of sign
//! bound the number of roots (the curve varies no more than its coefficients do), so that most
//! calls end after a glance at them. What knows its values better than by its coefficients takes the
//! [`turning_points`] alone and brings its own function to [`crossings_between`].
//!
//! Source: the chain of derivatives is Fourier's, in the form of A. G. Collins and R. Loos,
//! "Polynomial real root isolation by differentiation" (1976); the variation-diminishing property
//! in G. Farin, *Curves and Surfaces for CAGD*, section 4.

use crate::scalar::Real;

/// The greatest degree of a polynomial.
pub(crate) const DEGREE_MAX: usize = 6;

/// The most steps towards one root; each evaluates the polynomial once. After the first
/// [`NEWTON_MAX`] every step halves what is left of the bracket, down to 2⁻⁶⁴ of it.
pub(crate) const STEPS_MAX: u32 = NEWTON_MAX + 64;

/// The most steps that may be Newton's.
const NEWTON_MAX: u32 = 16;

/// The most evaluations of a polynomial of a degree, and of its derivatives, on the way to all
/// its roots: the ends of each piece and the steps to its root.
pub(crate) const fn evaluations_max(degree: u32) -> u32 {
    let (mut sum, mut order) = (0, 1);
    while order <= degree {
        sum += order * (STEPS_MAX + 1) + 1;
        order += 1;
    }
    sum
}

/// Parameters in ascending order, at most `N` of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Knots<T, const N: usize> {
    at: [T; N],
    len: u32,
}

impl<T: Real, const N: usize> Knots<T, N> {
    /// None.
    pub(crate) fn none() -> Self {
        Self { at: [T::ZERO; N], len: 0 }
    }

    /// The same moved by a function that keeps their order.
    #[must_use]
    pub(crate) fn map(mut self, f: impl Fn(T) -> T) -> Self {
        for t in &mut self.at {
            *t = f(*t);
        }
        self
    }

    /// The parameters.
    pub(crate) fn as_slice(&self) -> &[T] {
        self.at.get(..self.len as usize).unwrap_or(&[])
    }

    /// Replaces the parameters by those between them, and between them and the ends, at which a
    /// function changes its sign that is monotone there.
    fn replace(&mut self, [low, high]: [T; 2], f: impl Fn(T) -> [T; 2]) {
        let mut from = Sample::at(low, &f);
        let (mut read, mut written) = (0_usize, 0_usize);
        loop {
            let end = if read < self.len as usize { self.at.get(read) } else { None };
            let last = end.is_none();
            let to = Sample::at(end.copied().unwrap_or(high), &f);
            if from.negative != to.negative {
                // At most one for each that was read, and one more after the last.
                if let Some(slot) = self.at.get_mut(written) {
                    *slot = refine(&from, &to, &f);
                    written += 1;
                }
            }
            if last {
                break;
            }
            (from, read) = (to, read + 1);
        }
        self.len = written as u32;
    }
}

/// A function at one place.
#[derive(Clone, Copy)]
struct Sample<T> {
    t: T,
    value: T,
    slope: T,
    negative: bool,
}

impl<T: Real> Sample<T> {
    #[inline]
    fn at(t: T, f: impl Fn(T) -> [T; 2]) -> Self {
        let [value, slope] = f(t);
        Self { t, value, slope, negative: value < T::ZERO }
    }

    /// A first guess at the root between two samples of different sign: of a parabola with its
    /// vertex at the end that is much the flatter, or else of the chord.
    #[inline]
    fn guess(&self, other: &Self) -> T {
        let (width, four) = (other.t - self.t, T::TWO + T::TWO);
        let (flat, steep) = (self.slope.abs(), other.slope.abs());
        let share = self.value / (self.value - other.value);
        if flat * four < steep {
            self.t + width * share.sqrt()
        } else if steep * four < flat {
            other.t - width * (T::ONE - share).sqrt()
        } else {
            self.t + width * share
        }
    }
}

/// The parameter between two places of different sign at which a function, given with its slope,
/// changes its sign.
#[inline]
fn refine<T: Real>(from: &Sample<T>, to: &Sample<T>, f: impl Fn(T) -> [T; 2]) -> T {
    if from.value == T::ZERO {
        from.t
    } else if to.value == T::ZERO {
        to.t
    } else {
        bracketed([from.t, to.t], (from.negative, from.guess(to)), T::ZERO, f)
    }
}

/// The parameter between two at which a function, given with its slope, is known to change its sign;
/// told whether it is negative at the first, and where to look first: Newton's steps where they stay in the
/// bracket and shrink to 5/8, bisection otherwise. [`STEPS_MAX`] evaluations at most. A quick step
/// of a few roundings of the greater end is the last one, and so is any that is not longer than `enough`.
#[inline]
pub(crate) fn bracketed<T: Real>(
    [mut low, mut high]: [T; 2],
    (negative, guess): (bool, T),
    enough: T,
    f: impl Fn(T) -> [T; 2],
) -> T {
    let middle = |low: T, high: T| low + (high - low) * T::HALF;
    let eighth = T::HALF * T::HALF * T::HALF;
    let size = low.squared().max(high.squared());
    let near = T::EPSILON * size;
    let fine = T::EPSILON * near * T::from_i32(64);
    let (mut t, mut moved) = (guess, high - low);
    if !(low < t && t < high) {
        t = middle(low, high);
    }
    // The last step was Newton's; it was so, and much shorter than the one before, also Newton's.
    let (mut newtonian, mut quick) = (false, false);
    for step in 0..STEPS_MAX {
        let [value, slope] = f(t);
        if (value < T::ZERO) == negative {
            low = t;
        } else {
            high = t;
        }
        let signed = value / slope;
        let (next, newton) = (t - signed, signed.abs());
        if next == t || value == T::ZERO {
            break;
        }
        let shrinks = newton <= moved * (T::HALF + eighth);
        if quick && !shrinks && moved.squared() <= near {
            // What was about to double its digits and does not even shrink is rounding.
            break;
        }
        if shrinks && low <= next && next <= high && step < NEWTON_MAX {
            quick = newtonian && newton <= moved * eighth;
            (t, moved, newtonian) = (next, newton, true);
            if newton <= enough || (quick && newton.squared() <= fine) {
                break;
            }
        } else {
            let next = middle(low, high);
            if !(low < next && next < high) {
                break;
            }
            (t, moved, newtonian, quick) = (next, (high - low) * T::HALF, false, false);
        }
    }
    t
}

/// Gives where a function changes its sign that is monotone between neighbouring knots, from `low`
/// to `high`, strictly ascending. `f` tells value and slope; only the value decides, and the value at
/// a knot decides for both sides of it. Two changes in one place are none.
#[inline]
pub(crate) fn crossings_between<T: Real>(
    knots: &[T],
    [low, high]: [T; 2],
    f: impl Fn(T) -> [T; 2],
    mut emit: impl FnMut(T),
) {
    let mut from = Sample::at(low, &f);
    let mut waiting = None;
    for &end in knots.iter().chain([&high]) {
        let to = Sample::at(end, &f);
        if from.negative != to.negative {
            let root = refine(&from, &to, &f);
            match waiting {
                Some(last) if last == root => waiting = None,
                Some(last) => {
                    emit(last);
                    waiting = Some(root);
                }
                None => waiting = Some(root),
            }
        }
        from = to;
    }
    if let Some(last) = waiting {
        emit(last);
    }
}

/// Gives, strictly ascending, where a polynomial changes its sign between `low` and `high`, two finite
/// numbers in this order. Coefficients of ascending powers; any of them may be 0. `N` is at most
/// [`DEGREE_MAX`] + 1. At most [`evaluations_max`] of `N − 1` evaluations are made.
///
/// Precision is that of the sum of the terms' magnitudes, so the parameter should count from
/// somewhere near the roots.
pub(crate) fn crossings<T: Real, const N: usize>(
    coefficients: &[T; N],
    ends: [T; 2],
    emit: impl FnMut(T),
) {
    let knots = turning_points(coefficients, ends);
    crossings_between(knots.as_slice(), ends, |t| power_value(coefficients, t), emit);
}

/// Where the derivative of a polynomial changes its sign between `low` and `high`, ascending: there
/// are at most `N − 2` such places, and between two of them the polynomial is monotone.
#[inline(never)]
pub(crate) fn turning_points<T: Real, const N: usize>(
    coefficients: &[T; N],
    ends: [T; 2],
) -> Knots<T, N> {
    const { assert!(N >= 1 && N <= DEGREE_MAX + 1, "a degree beyond the greatest") };
    let mut knots = Knots::none();
    for order in (1..N as i32 - 1).rev() {
        let derivative = power_derivative(coefficients, order);
        let [c, b, a] = leading(&derivative);
        if order + 3 == N as i32 {
            knots = quadratic_knots([c, b, a], ends);
        } else if order + 3 < N as i32 || N == 3 {
            knots.replace(ends, |t| power_value(&derivative, t));
        }
    }
    knots
}

/// Where a polynomial itself changes its sign between `low` and `high`, ascending: as knots of a
/// function whose derivative it is, or has the sign of.
#[inline(never)]
pub(crate) fn knots<T: Real, const N: usize>(coefficients: &[T; N], ends: [T; 2]) -> Knots<T, N> {
    let mut knots = turning_points(coefficients, ends);
    if N == 3 {
        let [c, b, a] = leading(coefficients);
        return quadratic_knots([c, b, a], ends);
    }
    knots.replace(ends, |t| power_value(coefficients, t));
    knots
}

/// The first three coefficients.
#[inline]
fn leading<T: Real, const N: usize>(coefficients: &[T; N]) -> [T; 3] {
    let mut from = coefficients.iter().copied().chain([T::ZERO; 3]);
    [T::ZERO; 3].map(|zero| from.next().unwrap_or(zero))
}

/// The roots of `a·t² + b·t + c` between two ends, in closed form: near enough where they only part
/// what is monotone, for between two that rounding joins next to nothing happens.
fn quadratic_knots<T: Real, const N: usize>([c, b, a]: [T; 3], [low, high]: [T; 2]) -> Knots<T, N> {
    let mut knots = Knots::none();
    let size = a.abs().max(b.abs()).max(c.abs());
    let [a, b, c] = [a / size, b * T::HALF / size, c / size];
    let square = b.squared() - a * c;
    // Nor is it for a size of 0.
    if !(square > T::ZERO) {
        return knots;
    }
    let root = square.sqrt();
    let q = if b < T::ZERO { root - b } else { -(b + root) };
    let (first, second) = (q / a, c / q);
    for t in [first.min(second), first.max(second)] {
        if low < t
            && t < high
            && let Some(slot) = knots.at.get_mut(knots.len as usize)
        {
            *slot = t;
            knots.len += 1;
        }
    }
    knots
}

/// A polynomial and its derivative.
#[inline]
fn power_value<T: Real, const N: usize>(coefficients: &[T; N], t: T) -> [T; 2] {
    let [mut value, mut slope] = [T::ZERO; 2];
    for &coefficient in coefficients.iter().rev() {
        slope = slope * t + value;
        value = value * t + coefficient;
    }
    [value, slope]
}

/// The derivative of some order.
#[inline]
fn power_derivative<T: Real, const N: usize>(coefficients: &[T; N], order: i32) -> [T; N] {
    let mut derivative = [T::ZERO; N];
    let rest = coefficients.iter().skip(order as usize);
    for ((power, to), &from) in (0..).zip(&mut derivative).zip(rest) {
        let factor = (1..=order).fold(1, |product, step| product * (power + step));
        *to = from * T::from_i32(factor);
    }
    derivative
}

/// Gives, strictly ascending, where a polynomial changes its sign on 0..=1. Coefficients in
/// Bernstein's basis of degree `N − 1`; the first and the last are the values at the two ends. `N` is at
/// most [`DEGREE_MAX`] + 1. At most [`evaluations_max`] of `N − 1` evaluations are made, and
/// none where all coefficients have one sign.
///
/// Values are convex combinations of the coefficients, so their error is a few roundings of the
/// greatest of these.
#[inline(never)]
pub(crate) fn bernstein_crossings<T: Real, const N: usize>(
    coefficients: &[T; N],
    emit: impl FnMut(T),
) {
    const { assert!(N >= 1 && N <= DEGREE_MAX + 1, "a degree beyond the greatest") };
    if variations(coefficients, N) == 0 {
        return;
    }
    // The lowest derivative with one change of sign at most: it has just that one.
    let mut order = 0;
    while order + 1 < N && !is_parted(&bernstein_derivative(coefficients, order), N - order) {
        order += 1;
    }
    let ends = [T::ZERO, T::ONE];
    let mut knots = Knots::<T, N>::none();
    while order > 0 {
        let derivative = bernstein_derivative(coefficients, order);
        knots.replace(ends, |u| bernstein_value(&derivative, N - 1 - order, u));
        order -= 1;
    }
    let f = |u| bernstein_value(coefficients, N - 1, u);
    crossings_between(knots.as_slice(), ends, f, emit);
}

/// The curve of the first `len` coefficients has at most one change of sign, and that lies strictly between
/// its ends: where an end is 0 and the curve is not monotone, that is not the place.
#[inline]
fn is_parted<T: Real, const N: usize>(coefficients: &[T; N], len: usize) -> bool {
    let mut ends = coefficients.iter().take(1).chain(coefficients.iter().take(len).skip(len - 1));
    match variations(coefficients, len) {
        0 => true,
        1 => ends.all(|&end| end != T::ZERO),
        _ => false,
    }
}

/// How often neighbours among the first `len` coefficients differ in sign, 0 counting as positive:
/// the curve changes its sign as often, or less often by an even number.
#[inline]
fn variations<T: Real, const N: usize>(coefficients: &[T; N], len: usize) -> u32 {
    let signs = coefficients.iter().take(len).map(|&c| c < T::ZERO);
    let next = signs.clone().skip(1);
    signs.zip(next).map(|(a, b)| u32::from(a != b)).sum()
}

/// The coefficients of the derivative of some order, but for a positive factor.
#[inline]
fn bernstein_derivative<T: Real, const N: usize>(coefficients: &[T; N], order: usize) -> [T; N] {
    let mut derivative = *coefficients;
    for step in 0..order {
        let mut entries = derivative.iter_mut().take(N - step);
        let Some(mut at) = entries.next() else {
            break;
        };
        for next in entries {
            *at = *next - *at;
            at = next;
        }
    }
    derivative
}

/// A polynomial and its derivative, by de Casteljau's algorithm.
#[inline]
fn bernstein_value<T: Real, const N: usize>(coefficients: &[T; N], degree: usize, u: T) -> [T; 2] {
    let (mut row, v) = (*coefficients, T::ONE - u);
    let mut slope = T::ZERO;
    for last in (1..=degree).rev() {
        let mut entries = row.iter_mut().take(last + 1);
        let Some(mut at) = entries.next() else {
            break;
        };
        for next in entries {
            if last == 1 {
                slope = (*next - *at) * T::from_i32(degree as i32);
            }
            *at = *at * v + *next * u;
            at = next;
        }
    }
    let [value, ..] = leading(&row);
    [value, slope]
}

#[cfg(test)]
mod tests;

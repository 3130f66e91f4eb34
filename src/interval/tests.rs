//! What a number gives lies in what an interval around it gives, in every format and operation.

extern crate std;

use super::{Algebra, Digits, Dual, Interval, sine};
use crate::fixed_point::Wide;
use crate::scalar::{Number, Real};

const DIGITS: Digits = Digits::Double;

/// Steele, Lea and Flood's SplitMix64 (2014).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// In 0..1.
    fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Of either sign and many magnitudes, often a small whole number.
    fn number(&mut self) -> f64 {
        match self.bits() % 4 {
            0 => (self.bits() % 9) as f64 - 4.0,
            1 => self.unit() * 2.0 - 1.0,
            2 => (self.unit() * 2.0 - 1.0) * 100.0,
            _ => libm::exp2(self.unit() * 40.0 - 20.0) * (self.unit() - 0.5),
        }
    }

    /// An interval and a point of it.
    fn around<T: Real>(&mut self) -> (Interval<T>, T) {
        let (a, b) = (self.number(), self.number() * 0.1);
        let ends = [T::from_f64(a), T::from_f64(a) + T::from_f64(b).abs()];
        let share = T::from_f64(self.unit());
        let point = match self.bits() % 4 {
            0 => ends[0],
            1 => ends[1],
            _ => (ends[0] + (ends[1] - ends[0]) * share).clamp(ends[0], ends[1]),
        };
        (Interval::between(ends[0], ends[1]), point)
    }
}

fn holds<T: Real>(interval: Interval<T>, x: T) -> bool {
    interval.low <= x && x <= interval.high
}

/// The operations on two operands; the last numbers are a width and an exponent.
fn results<A: Algebra>(a: A, b: A, width: A::Number, e: A::Number) -> [A; 15] {
    let [sin, cos] = a.sin_cos(DIGITS);
    [
        a + b,
        a - b,
        a * b,
        a.over(b),
        a.square(),
        a.whole_power(3),
        a.whole_power(6),
        a.real_power(e),
        a.real_power(-e),
        a.root(),
        sin,
        cos,
        a.lesser(b),
        a.smooth_lesser(b, width),
        a.share(),
    ]
}

fn points_lie_in_intervals<T: Real>() {
    let mut random = Random(1);
    for _ in 0..40_000 {
        let ((a, x), (b, y)) = (random.around::<T>(), random.around::<T>());
        let width = T::from_f64(random.unit() + 0.01);
        let e = T::from_f64(random.unit() * 3.0 + 0.1);
        let outer = results(a, b, width, e);
        let inner = results(x, y, width, e);
        for (operation, (outer, inner)) in outer.into_iter().zip(inner).enumerate() {
            assert!(
                holds(outer, inner) || !inner.is_finite(),
                "operation {operation} of {x:?} in {a:?}, {y:?} in {b:?}: {inner:?} not in {outer:?}"
            );
        }
    }
}

#[test]
fn points_lie_in_intervals_in_every_format() {
    points_lie_in_intervals::<f32>();
    points_lie_in_intervals::<f64>();
    points_lie_in_intervals::<Wide>();
}

/// The intervals of `f32` hold what is computed without its rounding.
#[test]
fn intervals_hold_the_exact_values() {
    let mut random = Random(2);
    for _ in 0..40_000 {
        let ((a, x), (b, y)) = (random.around::<f32>(), random.around::<f32>());
        let (width, e) = (random.unit() as f32 + 0.01, random.unit() as f32 * 3.0 + 0.1);
        let outer = results(a, b, width, e);
        let inner = results(f64::from(x), f64::from(y), width.into(), e.into());
        for (operation, (outer, exact)) in outer.into_iter().zip(inner).enumerate() {
            let (low, high) = (f64::from(outer.low), f64::from(outer.high));
            let near = exact.abs() * 1e-14;
            assert!(
                low <= exact + near && exact - near <= high,
                "operation {operation} of {x} in {a:?}, {y} in {b:?}: {exact} not in {outer:?}"
            );
        }
    }
}

/// The width of a result shrinks with that of the operand, down to its rounding.
#[test]
fn intervals_are_tight() {
    for x in [0.3, 1.5, -2.0, 40.0] {
        for width in [1e-1, 1e-3, 1e-6, 0.0] {
            let around = Interval::between(x, x + width);
            for result in results(around, around, 0.5, 1.5) {
                let spread = result.high - result.low;
                let slope = 6.0 * 50_f64 * 50.0 * 50.0 * 50.0 * 50.0 * (width + 1e-13);
                assert!(spread <= slope || spread.is_infinite(), "{x} {width}: {result:?}");
            }
            let [sin, _] = around.sin_cos(DIGITS);
            assert!(sin.high - sin.low <= width + width * width + 1e-13);
        }
    }
}

#[test]
fn sines_are_as_exact_as_they_say() {
    let mut random = Random(3);
    for _ in 0..20_000 {
        let x = Number::clamp(random.number() * 10.0, -65_536.0, 65_536.0);
        let (sin, cos) = libm::sincos(x);
        let (s, c) = sine::sin_cos(x, DIGITS);
        let error = sine::error(x, DIGITS);
        assert!((s - sin).abs() <= error && (c - cos).abs() <= error, "{x}: {s} for {sin}");
        let (s, c) = sine::sin_cos(Wide::from_f64(x), DIGITS);
        let error = sine::error(Wide::from_f64(x), DIGITS).to_f64() + 1e-16;
        assert!((s.to_f64() - sin).abs() <= error && (c.to_f64() - cos).abs() <= error, "{x}");
        let narrow = x as f32;
        let (sin, cos) = libm::sincos(narrow.into());
        let (s, c) = sine::sin_cos(narrow, Digits::Single);
        let error = f64::from(sine::error(narrow, Digits::Single));
        let near = |a: f32, b: f64| (f64::from(a) - b).abs() <= error;
        assert!(near(s, sin) && near(c, cos), "{narrow}: {s} for {sin}, {c} for {cos}");
    }
}

/// The slope of a formula lies in the slope of the formula over an interval, and is what the values
/// change by.
#[test]
fn slopes_lie_in_the_slopes_of_intervals() {
    fn formula<A: Algebra>(t: Dual<A>, width: A::Number) -> Dual<A> {
        let waves = t.value.sin_cos(DIGITS);
        let u = t.square() - t.sine(waves);
        let v = (t * u + Dual::constant(A::Number::TWO)).magnitude().root();
        u.smooth_lesser(v, width) * t.cosine(waves) + v.whole_power(3).over(u.square() + v)
    }
    let mut random = Random(4);
    let mut told = 0;
    for _ in 0..20_000 {
        let low = random.unit() * 6.0 - 3.0;
        let high = low + random.unit() * 0.1;
        let x = low + (high - low) * random.unit();
        let slope = |a: Interval<f64>| Dual { value: a, slope: Interval::between(1.0, 1.0) };
        let outer = formula(slope(Interval::between(low, high)), 0.5);
        let inner = formula(Dual { value: x, slope: 1.0 }, 0.5);
        assert!(holds(outer.value, inner.value) && holds(outer.slope, inner.slope), "{x}");
        told += u32::from(outer.slope.is_positive() || outer.slope.is_negative());
        let step = 1e-6;
        let [before, after] = [x - step, x + step].map(|x| Dual { value: x, slope: 1.0 });
        let change = (formula(after, 0.5).value - formula(before, 0.5).value) / (2.0 * step);
        let bend = 1e-3 * (1.0 + inner.slope.abs());
        assert!((change - inner.slope).abs() <= bend, "{x}: {change} for {}", inner.slope);
    }
    assert!(told > 10_000, "{told} slopes were told from 0");
}

//! The numbers of fixed point against exact arithmetic: operators round once and saturate, the wide
//! number keeps 62 bits, its functions 52.
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_types,
    reason = "a measure of errors need not be the same to the bit"
)]

mod oracle;

use nostray::fixed_point::{Unit16, Wide};
use nostray::{
    Affine, Fixed, Form, Item, Material, Number, Q16, Q32, Real as _, Rgb, Scalar, SceneBuilder,
    SceneError, Vector,
};
use oracle::{Random, Real};

/// The nearest step to `n / 2^shift`, ties upward, within the range of an `i32`.
fn nearest(n: i128, shift: u32) -> i32 {
    let rounded = (n + (1 << (shift - 1))) >> shift;
    rounded.clamp(-i128::from(i32::MAX), i128::from(i32::MAX)) as i32
}

/// Bits of all magnitudes, often at the ends.
fn bits(random: &mut Random) -> i32 {
    match random.below(8) {
        0 => [0, 1, -1, i32::MAX, i32::MIN, 1 << 16, -(1 << 16)][random.below(7)],
        _ => (random.bits() as i32) >> random.below(31),
    }
}

#[test]
fn operators_round_once_and_saturate() {
    let mut random = Random::new(1);
    for _ in 0..200_000 {
        let (a, b) = (bits(&mut random), bits(&mut random));
        let (x, y) = (Q16::from_bits(a), Q16::from_bits(b));
        let (a, b) = (i128::from(a), i128::from(b));
        assert_eq!((x * y).to_bits(), nearest(a * b, 16), "{x} · {y}");
        assert_eq!((x + y).to_bits(), nearest((a + b) << 1, 1), "{x} + {y}");
        assert_eq!((x - y).to_bits(), nearest((a - b) << 1, 1), "{x} − {y}");
        assert_eq!((-x).to_bits(), nearest(-a << 1, 1), "−{x}");
        let quotient = (x / y).to_bits();
        if b == 0 {
            assert_eq!(quotient, nearest(a.signum() << 40, 1), "{x} / 0");
        } else {
            let exact = (a as f64) * 65_536.0 / b as f64;
            let clamped = exact.clamp(-f64::from(i32::MAX), f64::from(i32::MAX));
            assert!((f64::from(quotient) - clamped).abs() <= 0.5, "{x} / {y}");
        }
        let root = i128::from(x.sqrt().to_bits());
        let square = a.max(0) << 16;
        assert!((root * root - square).abs() <= root, "√{x}");
        let (u, v) = (Unit16::from_bits(a as i32), Unit16::from_bits(b as i32));
        assert_eq!((u * v).to_bits(), nearest(a * b, 30), "{u} · {v}");
    }
}

#[test]
fn reciprocals_divide_to_a_step() {
    let mut random = Random::new(2);
    for _ in 0..200_000 {
        let d = Unit16::from_bits(bits(&mut random).clamp(-(1 << 30), 1 << 30));
        let (to, from) = (Q16::from_bits(bits(&mut random)), Q16::from_bits(bits(&mut random)));
        let inverse = Q16::reciprocal(d);
        let found = f64::from(Q16::quotient(to, from, inverse).to_bits());
        let way = f64::from(to.to_bits()) - f64::from(from.to_bits());
        assert_eq!(Q16::is_parallel(inverse), d.to_bits() == 0);
        let most = f64::from(i32::MAX);
        let exact = if d.to_bits() == 0 {
            way.signum() * if way == 0.0 { 0.0 } else { most }
        } else {
            (way * f64::powi(2.0, 30) / f64::from(d.to_bits())).clamp(-most, most)
        };
        assert!((found - exact).abs() <= 1.5, "({to} − {from}) / {d}: {found} for {exact}");
    }
}

/// A wide number of any magnitude, and its exact value: the sum of two that f64 can hold.
fn wide(random: &mut Random) -> (Wide, Real) {
    let (high, low) = (random.decades(-9.0, 9.0) * random.sign(), random.within(0.0, 1e-7));
    let sum = Wide::from_f64(high) + Wide::from_f64(low * high);
    (sum, exact(sum))
}

/// The exact value of a wide number, in two pieces of f64.
fn exact(x: Wide) -> Real {
    let high = x.to_f64();
    let rest = (x - Wide::from_f64(high)).to_f64();
    Real::from(high) + Real::from(rest)
}

fn relative(found: Wide, expected: &Real) -> f64 {
    let error = (exact(found) - expected).abs().to_f64();
    if error == 0.0 { 0.0 } else { error / expected.abs().to_f64() }
}

#[test]
fn wide_operators_keep_their_bits() {
    let mut random = Random::new(3);
    let bound = f64::powi(2.0, -62);
    for _ in 0..50_000 {
        let ((x, a), (y, b)) = (wide(&mut random), wide(&mut random));
        assert!(relative(x + y, &(&a + &b)) <= bound, "{x:?} + {y:?}");
        assert!(relative(x - y, &(&a - &b)) <= bound, "{x:?} − {y:?}");
        assert!(relative(x * y, &(&a * &b)) <= bound, "{x:?} · {y:?}");
        assert!(relative(x / y, &(&a / &b)) <= bound, "{x:?} / {y:?}");
        assert!(relative(x.abs().sqrt(), &a.abs().sqrt()) <= bound, "√{x:?}");
        assert_eq!(x < y, (&a - &b).sign() < 0);
        // Products that are equal but for the last bits.
        let near = x * y / x;
        let sign = (&a * &b - &a * &exact(near)).sign();
        let found = Q32::det2(x, y, x, near);
        assert_eq!((found > Wide::ZERO, found < Wide::ZERO), (sign > 0, sign < 0), "{x:?} {y:?}");
    }
}

#[test]
fn nothing_is_lost_at_the_ends() {
    let (zero, one, far) = (Wide::ZERO, Wide::ONE, Wide::FAR);
    assert_eq!(one / zero, far);
    assert_eq!(-one / zero, -far);
    assert_eq!(zero / zero, zero);
    assert_eq!(far * far, far);
    assert_eq!(far + far, far);
    assert_eq!(Wide::TINY.powi(1 << 12), zero);
    assert_eq!((-one).sqrt(), zero);
    assert!(!far.is_finite() && one.is_finite() && zero.is_finite());
    assert_eq!(Wide::from_f64(f64::NAN), zero);
    assert_eq!(Wide::from_f64(f64::NEG_INFINITY), -far);
    assert_eq!(Q16::from_f64(1e9), Q16::FAR);
    assert_eq!(Q16::from_f64(-1e9), -Q16::FAR);
    assert_eq!(Q32::from_f64(0.5).to_f64(), 0.5);
    assert_eq!(
        Q32::narrow(Wide::from_f64(1.5 * f64::powi(2.0, 30))).to_f64(),
        1.5 * f64::powi(2.0, 30)
    );
    assert_eq!(Q16::ONE.to_unit_bits(), u32::MAX);
    assert_eq!(Q16::HALF.to_unit_bits(), 1 << 31);
    assert_eq!((-Q16::HALF).to_unit_bits(), 0);
    assert_eq!((-Q16::HALF).floor_i64(), -1);
}

#[test]
fn functions_agree_with_those_of_double_precision() {
    let mut random = Random::new(4);
    let bound = f64::powi(2.0, -51);
    let near = |found: Wide, expected: f64, scale: f64, what: &str| {
        let error = (found.to_f64() - expected).abs();
        assert!(error <= bound * expected.abs().max(scale), "{what}: {found:?} for {expected}");
    };
    for _ in 0..20_000 {
        let x = random.within(-30.0, 30.0);
        let w = Wide::from_f64(x);
        near(w.sin_cos().0, libm::sin(x), 1.0, "sine");
        near(w.sin_cos().1, libm::cos(x), 1.0, "cosine");
        near(w.exp(), libm::exp(x), 0.0, "exponential");
        let y = random.within(-30.0, 30.0);
        near(Wide::from_f64(y).atan2(w), libm::atan2(y, x), 0.0, "arctangent");
        let cosine = random.within(-1.0, 1.0);
        near(Wide::from_f64(cosine).acos(), libm::acos(cosine), 0.0, "arccosine");
        let (base, e) = (random.decades(-3.0, 1.0), random.within(-9.0, 9.0));
        let power = Wide::from_f64(base).pow(Wide::from_f64(e));
        let error = (power.to_f64() / libm::pow(base, e) - 1.0).abs();
        assert!(error <= bound, "{base} to the power {e}");
    }
    assert_eq!(Wide::ZERO.pow(Wide::ZERO), Wide::ONE);
    assert_eq!(Wide::ZERO.pow(Wide::ONE), Wide::ZERO);
    assert_eq!(Wide::from_i32(-1 << 30).exp(), Wide::ZERO);
    assert_eq!(Wide::ZERO.atan2(Wide::ZERO), Wide::ZERO);
    assert_eq!(Wide::ZERO.atan2(-Wide::ONE), Wide::PI);
}

/// What the format cannot hold with its accuracy is refused by name.
fn refusals<S: Scalar>() {
    let most = S::COORD_MAX;
    let beyond = most.next_up();
    let small = S::LENGTH_MIN * S::HALF;
    let try_ball = |center: S, radius: S| {
        let mut builder = SceneBuilder::<S, Fixed<1, 1, 1, 1>>::new();
        let material = builder.material(Material::matte(Rgb::WHITE)).expect("room");
        let center = S::Vec3::new(center, S::ZERO, S::ZERO);
        builder.leaf(Form::Sphere { center, radius }, &Affine::identity(), material)
    };
    let at = Item::Node(0);
    assert_eq!(try_ball(most, most), Ok(()));
    assert_eq!(try_ball(beyond, S::ONE), Err(SceneError::TooLarge { at, field: "center" }));
    assert_eq!(try_ball(-beyond, S::ONE), Err(SceneError::TooLarge { at, field: "center" }));
    assert_eq!(try_ball(S::ZERO, beyond), Err(SceneError::TooLarge { at, field: "radius" }));
    assert_eq!(try_ball(S::ZERO, small), Err(SceneError::NotPositive { at, field: "radius" }));
    assert_eq!(try_ball(S::ZERO, S::ZERO), Err(SceneError::NotPositive { at, field: "radius" }));
}

#[test]
fn what_is_out_of_range_is_refused_by_name() {
    refusals::<Q16>();
    refusals::<Q32>();
}

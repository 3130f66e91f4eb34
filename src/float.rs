//! `f32` and `f64` as scalars, on glam's plain `Vec3` and `DVec3`.
//!
//! Only addition, subtraction, multiplication, division and the square root are used on
//! the path of a ray; IEEE 754 makes these the same everywhere.

use crate::math::{double, single};
use crate::scalar::{Number, Real, Scalar, Vector};

/// Dekker's split of each coordinate of a direction into two halves that multiply exactly.
#[derive(Clone, Copy, Debug)]
pub struct SplitDir<F> {
    high: [F; 3],
    low: [F; 3],
}

macro_rules! float {
    ($float:ident, $vec:ty, $math:ident, $name:literal, $split:literal, $root:literal, $coord:expr, $length:expr, $bytes:literal) => {
        impl Vector for $vec {
            type Scalar = $float;
            const ZERO: Self = <$vec>::ZERO;

            #[inline]
            fn new(x: $float, y: $float, z: $float) -> Self {
                <$vec>::new(x, y, z)
            }
            #[inline]
            fn x(self) -> $float {
                self.x
            }
            #[inline]
            fn y(self) -> $float {
                self.y
            }
            #[inline]
            fn z(self) -> $float {
                self.z
            }
            #[inline]
            fn dot(self, other: Self) -> $float {
                self.x * other.x + self.y * other.y + self.z * other.z
            }
            #[inline]
            fn cross(self, other: Self) -> Self {
                <$vec>::new(
                    self.y * other.z - self.z * other.y,
                    self.z * other.x - self.x * other.z,
                    self.x * other.y - self.y * other.x,
                )
            }
        }

        impl Number for $float {
            const ZERO: Self = 0.0;
            const HALF: Self = 0.5;
            const ONE: Self = 1.0;

            #[inline]
            fn is_finite(self) -> bool {
                self - self == 0.0
            }
        }

        impl Real for $float {
            const TWO: Self = 2.0;
            const PI: Self = core::$float::consts::PI;
            const EPSILON: Self = $float::EPSILON;
            const FAR: Self = $float::INFINITY;
            const TINY: Self = $float::MIN_POSITIVE;

            #[inline]
            fn from_i32(n: i32) -> Self {
                n as $float
            }
            #[inline]
            fn from_ratio(n: i32, d: i32) -> Self {
                n as $float / d as $float
            }
            #[inline]
            fn from_f64(x: f64) -> Self {
                x as $float
            }
            #[inline]
            fn to_f64(self) -> f64 {
                self.into()
            }
            #[inline]
            fn nearest(self) -> i32 {
                // The cast drops what is behind the point, and saturates.
                (if self < 0.0 { self - 0.5 } else { self + 0.5 }) as i32
            }
            #[inline]
            fn next_up(self) -> Self {
                $float::next_up(self)
            }
            #[inline]
            fn sqrt(self) -> Self {
                if self > 0.0 { $math::sqrt(self) } else { 0.0 }
            }
            #[inline]
            fn two_product(self, other: Self) -> (Self, Self) {
                let (p, (ah, al), (bh, bl)) = (self * other, self.split(), other.split());
                (p, Self::product_error(p, ah, al, bh, bl))
            }
            #[inline]
            fn two_sum(self, other: Self) -> (Self, Self) {
                let sum = self + other;
                let part = sum - self;
                (sum, (self - (sum - part)) + (other - part))
            }
            fn sin_cos(self) -> (Self, Self) {
                $math::sin_cos(self)
            }
            fn atan2(self, x: Self) -> Self {
                $math::atan2(self, x)
            }
            fn acos(self) -> Self {
                $math::acos(Number::clamp(self, -1.0, 1.0))
            }
            fn exp(self) -> Self {
                $math::exp(self)
            }
            fn pow(self, e: Self) -> Self {
                $math::pow(self, e)
            }
        }

        impl Scalar for $float {
            type Vec3 = $vec;
            type Unit = $float;
            type Dir = $vec;
            type Wide = $float;
            type WideVec = $vec;
            type Inverse = $float;
            type Aim = SplitDir<$float>;
            type Bytes = [u8; $bytes];

            const NAME: &'static str = $name;
            const REFINES: bool = true;
            const PAIRS: bool = true;
            const EPSILON_ROOT: Self = $root;
            const COORD_MAX: Self = $coord;
            const LENGTH_MIN: Self = $length;

            #[inline]
            fn to_le_bytes(self) -> Self::Bytes {
                self.to_bits().to_le_bytes()
            }
            #[inline]
            fn to_unit_bits(self) -> u32 {
                // The cast saturates, and takes what is not a number to 0.
                (self * 4_294_967_296.0) as u32
            }
            #[inline]
            fn floor_i64(self) -> i64 {
                $math::floor(self) as i64
            }
            #[inline]
            fn floor(self) -> Self {
                $math::floor(self)
            }
            #[inline]
            fn widen(self) -> Self {
                self
            }
            #[inline]
            fn narrow(wide: Self) -> Self {
                wide
            }
            #[inline]
            fn from_unit(unit: Self) -> Self {
                unit
            }
            #[inline]
            fn widen_unit(unit: Self) -> Self {
                unit
            }
            #[inline]
            fn narrow_unit(wide: Self) -> Self {
                wide
            }

            #[inline]
            fn unit(v: $vec) -> $vec {
                Vector::normalize(v)
            }
            #[inline]
            fn toward(v: $vec) -> ($vec, Self) {
                let length = Vector::length(v);
                if length == 0.0 { (v, length) } else { (v * (1.0 / length), length) }
            }
            #[inline]
            fn steer(v: $vec) -> ($vec, Self) {
                (v, 1.0)
            }
            #[inline]
            fn plane(normal: $vec, offset: Self) -> ($vec, Self) {
                (normal, offset)
            }
            #[inline]
            fn along(dir: $vec, t: Self) -> $vec {
                dir * t
            }
            #[inline]
            fn mirror(v: $vec, normal: $vec, cosine: Self) -> $vec {
                v - normal * (cosine * 2.0)
            }

            #[inline]
            fn reciprocal(d: Self) -> Self {
                1.0 / d
            }
            #[inline]
            fn is_parallel(inverse: Self) -> bool {
                !Number::is_finite(inverse)
            }
            #[inline]
            fn is_backward(inverse: Self) -> bool {
                inverse < 0.0
            }
            #[inline]
            fn quotient(to: Self, from: Self, inverse: Self) -> Self {
                (to - from) * inverse
            }

            #[inline]
            fn rounding(magnitude: Self) -> Self {
                magnitude * $float::EPSILON
            }

            #[inline]
            fn det2(a: Self, b: Self, c: Self, d: Self) -> Self {
                let (p, q) = (a * b, c * d);
                if p != q {
                    // Rounding is monotone, so the sign is that of the exact difference.
                    return p - q;
                }
                $float::two_product(a, b).1 - $float::two_product(c, d).1
            }

            #[inline]
            fn dot_wide(a: $vec, b: $vec) -> Self {
                let (x, x_error) = $float::two_product(a.x, b.x);
                let (y, y_error) = $float::two_product(a.y, b.y);
                let (z, z_error) = $float::two_product(a.z, b.z);
                let (xy, xy_error) = $float::two_sum(x, y);
                let (sum, sum_error) = $float::two_sum(xy, z);
                sum + ((x_error + y_error + z_error) + (xy_error + sum_error))
            }

            #[inline]
            fn height(offset: Self, normal: $vec, p: $vec) -> Self {
                offset - Self::dot_wide(normal, p)
            }

            fn precedes((a, o, d): (Self, Self, Self), (b, p, e): (Self, Self, Self)) -> bool {
                // The sign of (a − o)·e − (b − p)·d, turned round where d·e < 0.
                let ((f, f_low), (g, g_low)) = ($float::two_sum(a, -o), $float::two_sum(b, -p));
                let products = [(f, e), (f_low, e), (-g, d), (-g_low, d)];
                let mut sum = [0.0; 8];
                let mut terms = 0;
                for (x, y) in products {
                    let (product, error) = $float::two_product(x, y);
                    for term in [product, error] {
                        $float::grow(&mut sum, terms, term);
                        terms += 1;
                    }
                }
                let sign = sum.into_iter().rev().find(|&part| part != 0.0).unwrap_or(0.0);
                if (d < 0.0) == (e < 0.0) { sign < 0.0 } else { sign > 0.0 }
            }

            #[inline]
            fn aim(dir: $vec) -> SplitDir<$float> {
                let [x, y, z] = dir.to_array().map($float::split);
                SplitDir { high: [x.0, y.0, z.0], low: [x.1, y.1, z.1] }
            }

            #[inline]
            fn heading(dir: $vec, _: &SplitDir<$float>) -> $vec {
                dir
            }
            #[inline]
            fn approach(origin: $vec, centre: $vec, dir: $vec, inv_dd: Self) -> Self {
                -Vector::dot(origin - centre, dir) * inv_dd
            }
            #[inline]
            fn may_pass(origin: $vec, centre: $vec, dir: $vec, inv_dd: Self, radius: Self) -> bool {
                let from = origin - centre;
                let nearest = from - dir * (Vector::dot(from, dir) * inv_dd);
                let reach = Number::abs(from.x) + Number::abs(from.y) + Number::abs(from.z);
                // What rounding may have added to the distance.
                let distance = radius + reach * ($float::EPSILON * 16.0);
                Vector::length_squared(nearest) <= distance * distance
            }

            #[inline]
            fn recentre(
                origin: $vec,
                centre: $vec,
                dir: $vec,
                aim: &SplitDir<$float>,
                k: Self,
            ) -> $vec {
                let parts = $float::recentred(origin, centre, dir, aim, k);
                <$vec>::from_array(parts.map(|(sum, error)| sum + error))
            }

            fn recentre_rest(
                origin: $vec,
                centre: $vec,
                dir: $vec,
                aim: &SplitDir<$float>,
                k: Self,
            ) -> $vec {
                let parts = $float::recentred(origin, centre, dir, aim, k);
                <$vec>::from_array(parts.map(|(sum, error)| error - ((sum + error) - sum)))
            }
        }

        impl ErrorFree for $float {
            type Vec = $vec;

            #[inline]
            fn split(self) -> (Self, Self) {
                let c = $split * self;
                let high = c - (c - self);
                (high, self - high)
            }
            #[inline]
            fn product_error(p: Self, ah: Self, al: Self, bh: Self, bl: Self) -> Self {
                ((ah * bh - p) + ah * bl + al * bh) + al * bl
            }
            fn recentred(
                origin: $vec,
                centre: $vec,
                dir: $vec,
                aim: &SplitDir<$float>,
                k: Self,
            ) -> [(Self, Self); 3] {
                let (k_high, k_low) = $float::split(k);
                let ([hx, hy, hz], [lx, ly, lz]) = (aim.high, aim.low);
                let along = |o: $float, c: $float, d: $float, high: $float, low: $float| {
                    // o − c and k·d, each as an unevaluated sum of two numbers.
                    let (f, f_error) = $float::two_sum(o, -c);
                    let p = k * d;
                    let p_error = $float::product_error(p, k_high, k_low, high, low);
                    let (sum, sum_error) = $float::two_sum(f, p);
                    (sum, sum_error + (f_error + p_error))
                };
                [
                    along(origin.x, centre.x, dir.x, hx, lx),
                    along(origin.y, centre.y, dir.y, hy, ly),
                    along(origin.z, centre.z, dir.z, hz, lz),
                ]
            }
            fn grow(sum: &mut [Self; 8], terms: usize, term: Self) {
                let mut carry = term;
                for part in sum.iter_mut().take(terms) {
                    (carry, *part) = Self::two_sum(carry, *part);
                }
                if let Some(last) = sum.get_mut(terms) {
                    *last = carry;
                }
            }
        }
    };
}

/// Sums and products as two numbers: the rounded result and what was rounded away, exact
/// barring overflow and underflow.
///
/// Source: T. J. Dekker, "A floating-point technique for extending the available precision"
/// (1971); D. E. Knuth, *The Art of Computer Programming*, volume 2, section 4.2.2.
trait ErrorFree: Sized {
    /// Three numbers.
    type Vec;
    /// Two halves that multiply exactly.
    fn split(self) -> (Self, Self);
    /// What a product `p` of two numbers, given by their halves, rounded away.
    fn product_error(p: Self, ah: Self, al: Self, bh: Self, bl: Self) -> Self;
    /// `origin − centre + k·dir`, coordinate by coordinate.
    fn recentred(
        origin: Self::Vec,
        centre: Self::Vec,
        dir: Self::Vec,
        aim: &SplitDir<Self>,
        k: Self,
    ) -> [(Self, Self); 3];
    /// Adds a term to an exact sum of so many parts in ascending order of magnitude.
    ///
    /// Source: J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic" (1997), section 2.4.
    fn grow(sum: &mut [Self; 8], terms: usize, term: Self);
}

float!(
    f32,
    glam::Vec3,
    single,
    "f32",
    4097.0,
    0.00048828125,
    (1_u64 << 50) as f32,
    1.0 / (1_u64 << 50) as f32,
    4
);
float!(f64, glam::DVec3, double, "f64", 134_217_729.0, 1.4901161193847656e-8, 1e120, 1e-120, 8);

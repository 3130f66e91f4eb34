//! The words of [`Scalar`] in fixed point: products of integers are exact, and what they make
//! is rounded once.

use super::number::{Q16, Q32, Unit16, Unit32};
use super::triple::Triple;
use super::wide::Wide;
use crate::scalar::{Number, Scalar, Vector};

macro_rules! scalar {
    (
        $name:ident, $unit:ident, $inverse:ident, $label:literal, $bits:ident, $long:ident, $magnitude:ident,
        $fraction:literal, $behind:literal, $size:literal, $pairs:literal, $root:literal, $coord:expr, $length:expr
    ) => {
        /// The reciprocal of a component of a direction: mantissa / 2^shift, in units that
        /// bring a difference of positions to a parameter.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct $inverse {
            /// 0 for a component that is 0.
            mantissa: $long,
            shift: u8,
            backward: bool,
        }

        impl $name {
            /// `origin − centre + k·dir` along one axis, exact with the digits of both.
            #[inline]
            fn along_axis(origin: Self, centre: Self, dir: $unit, k: Self) -> $long {
                let from = origin.to_bits() as $long - centre.to_bits() as $long;
                (from << $behind).saturating_add(k.to_bits() as $long * dir.to_bits() as $long)
            }
        }

        impl Scalar for $name {
            type Vec3 = Triple<$name>;
            type Unit = $unit;
            type Dir = Triple<$unit>;
            type Wide = Wide;
            type WideVec = Triple<Wide>;
            type Inverse = $inverse;
            type Aim = Triple<Wide>;
            type Bytes = [u8; $size];

            const NAME: &'static str = $label;
            const REFINES: bool = false;
            const PAIRS: bool = $pairs;
            const EPSILON_ROOT: Self = Self::from_bits($root);
            const COORD_MAX: Self = Self::from_bits($coord);
            const LENGTH_MIN: Self = Self::from_bits($length);

            #[inline]
            fn to_le_bytes(self) -> Self::Bytes {
                self.to_bits().to_le_bytes()
            }
            #[inline]
            fn to_unit_bits(self) -> u32 {
                let bits = (self.to_bits() as i64) << (32 - $fraction);
                bits.clamp(0, u32::MAX as i64) as u32
            }
            #[inline]
            fn floor_i64(self) -> i64 {
                (self.to_bits() >> $fraction) as i64
            }
            #[inline]
            fn floor(self) -> Self {
                Self::from_bits(self.to_bits() >> $fraction << $fraction)
            }

            #[inline]
            fn widen(self) -> Wide {
                Wide::from_parts(self.to_bits() as i64, -$fraction)
            }
            #[inline]
            fn narrow(wide: Wide) -> Self {
                Self::from_bits(wide.to_fixed($fraction, $bits::MAX as i64) as $bits)
            }
            #[inline]
            fn from_unit(unit: $unit) -> Self {
                let half = 1 << ($behind - $fraction - 1);
                Self::clamped((unit.to_bits() as $long + half) >> ($behind - $fraction))
            }
            #[inline]
            fn widen_unit(unit: $unit) -> Wide {
                Wide::from_parts(unit.to_bits() as i64, -$behind)
            }
            #[inline]
            fn narrow_unit(wide: Wide) -> $unit {
                $unit::from_bits(wide.to_fixed($behind, $bits::MAX as i64) as $bits)
            }

            fn unit(v: Triple<Wide>) -> Triple<$unit> {
                Self::narrow_dir(v.normalize())
            }
            fn toward(v: Triple<Self>) -> (Triple<$unit>, Self) {
                let wide = Self::widen_vec(v);
                let length = wide.length();
                (Self::narrow_dir(wide.normalize()), Self::narrow(length))
            }
            fn steer(v: Triple<Wide>) -> (Triple<$unit>, Wide) {
                (Self::unit(v), v.length())
            }
            fn plane(normal: Triple<Wide>, offset: Wide) -> (Triple<$unit>, Self) {
                let length = normal.length();
                (Self::unit(normal), Self::narrow(offset / length))
            }
            #[inline]
            fn along(dir: Triple<$unit>, t: Self) -> Triple<Self> {
                let [x, y, z] = dir.to_array().map(|d| {
                    let product = d.to_bits() as $long * t.to_bits() as $long;
                    Self::clamped((product + (1 << ($behind - 1))) >> $behind)
                });
                Triple::new(x, y, z)
            }
            #[inline]
            fn mirror(v: Triple<$unit>, normal: Triple<$unit>, cosine: $unit) -> Triple<$unit> {
                v.zip(normal, |v, n| {
                    let half = ((v.to_bits() as $long) << ($behind - 1)) - cosine.product(n);
                    $unit::clamped((half + (1 << ($behind - 2))) >> ($behind - 1))
                })
            }

            #[inline]
            fn reciprocal(d: $unit) -> $inverse {
                let magnitude = d.to_bits().unsigned_abs() as $magnitude;
                let bits = $magnitude::BITS - magnitude.leading_zeros();
                let power = (1 as $magnitude) << (bits + $behind);
                let mantissa = (power + magnitude / 2).checked_div(magnitude).unwrap_or(0);
                let backward = d.to_bits() < 0;
                $inverse { mantissa: mantissa as $long, shift: bits as u8, backward }
            }
            #[inline]
            fn is_parallel(inverse: $inverse) -> bool {
                inverse.mantissa == 0
            }
            #[inline]
            fn is_backward(inverse: $inverse) -> bool {
                inverse.backward
            }
            #[inline]
            fn quotient(to: Self, from: Self, inverse: $inverse) -> Self {
                let way = to.to_bits() as $long - from.to_bits() as $long;
                let way = if inverse.backward { -way } else { way };
                if inverse.mantissa == 0 {
                    return Self::clamped(($bits::MAX as $long) * way.signum());
                }
                let half = 1 << (inverse.shift - 1);
                let product = way.saturating_mul(inverse.mantissa).saturating_add(half);
                Self::clamped(product >> inverse.shift)
            }

            #[inline]
            fn rounding(_: Wide) -> Wide {
                const STEP: Wide = Wide::from_parts(1, -$fraction - 2);
                STEP
            }
            #[inline]
            fn det2(a: Wide, b: Wide, c: Wide, d: Wide) -> Wide {
                Wide::det2(a, b, c, d)
            }
            #[inline]
            fn dot_wide(a: Triple<Wide>, b: Triple<Wide>) -> Wide {
                Wide::sum_of_products([(a.x, b.x), (a.y, b.y), (a.z, b.z)])
            }
            #[inline]
            fn height(offset: Wide, normal: Triple<Wide>, p: Triple<Wide>) -> Wide {
                let (x, y, z) = (-normal.x, -normal.y, -normal.z);
                Wide::sum_of_products([(offset, Wide::ONE), (x, p.x), (y, p.y), (z, p.z)])
            }
            fn precedes((a, o, d): (Self, Self, $unit), (b, p, e): (Self, Self, $unit)) -> bool {
                let product = |to: Self, from: Self, by: $unit| {
                    (to.to_bits() as i128 - from.to_bits() as i128)
                        .saturating_mul(by.to_bits() as i128)
                };
                let (first, second) = (product(a, o, e), product(b, p, d));
                if d.to_bits().signum() == e.to_bits().signum() {
                    first < second
                } else {
                    first > second
                }
            }

            #[inline]
            fn aim(dir: Triple<$unit>) -> Triple<Wide> {
                Self::widen_dir(dir)
            }
            #[inline]
            fn heading(_: Triple<$unit>, aim: &Triple<Wide>) -> Triple<Wide> {
                *aim
            }
            #[inline]
            fn approach(
                origin: Triple<Self>,
                centre: Triple<Self>,
                dir: Triple<$unit>,
                _: Wide,
            ) -> Self {
                let part = |o: Self, c: Self, d: $unit| {
                    let way = c.to_bits() as $long - o.to_bits() as $long;
                    way.saturating_mul(d.to_bits() as $long)
                };
                let sum = part(origin.x, centre.x, dir.x)
                    .saturating_add(part(origin.y, centre.y, dir.y))
                    .saturating_add(part(origin.z, centre.z, dir.z));
                Self::clamped(sum >> $behind)
            }
            #[inline]
            fn may_pass(
                origin: Triple<Self>,
                centre: Triple<Self>,
                dir: Triple<$unit>,
                inv_dd: Wide,
                radius: Self,
            ) -> bool {
                let k = Self::approach(origin, centre, dir, inv_dd);
                // The nearest point is found to within a few steps.
                let reach = (radius.to_bits() as $long + 16) << $behind;
                let near = |o: Self, c: Self, d: $unit| {
                    let from = Self::along_axis(o, c, d, k);
                    -reach <= from && from <= reach
                };
                near(origin.x, centre.x, dir.x)
                    && near(origin.y, centre.y, dir.y)
                    && near(origin.z, centre.z, dir.z)
            }
            #[inline]
            fn recentre(
                origin: Triple<Self>,
                centre: Triple<Self>,
                dir: Triple<$unit>,
                _: &Triple<Wide>,
                k: Self,
            ) -> Triple<Wide> {
                let along = |o: Self, c: Self, d: $unit| {
                    let exact = Self::along_axis(o, c, d, k);
                    Wide::from_long(exact as i128, -($fraction + $behind))
                };
                Triple::new(
                    along(origin.x, centre.x, dir.x),
                    along(origin.y, centre.y, dir.y),
                    along(origin.z, centre.z, dir.z),
                )
            }
            fn recentre_rest(
                origin: Triple<Self>,
                centre: Triple<Self>,
                dir: Triple<$unit>,
                _: &Triple<Wide>,
                k: Self,
            ) -> Triple<Wide> {
                let along = |o: Self, c: Self, d: $unit| {
                    let exact = Self::along_axis(o, c, d, k);
                    Wide::halves(exact as i128, -($fraction + $behind)).1
                };
                Triple::new(
                    along(origin.x, centre.x, dir.x),
                    along(origin.y, centre.y, dir.y),
                    along(origin.z, centre.z, dir.z),
                )
            }
        }
    };
}

scalar!(Q16, Unit16, Inverse16, "q16", i32, i64, u64, 16, 30, 4, false, 256, 8192 << 16, 16);
scalar!(Q32, Unit32, Inverse32, "q32", i64, i128, u128, 32, 62, 8, true, 65536, 1 << 60, 256);

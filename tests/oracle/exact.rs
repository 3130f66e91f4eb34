//! The exact values of all number formats.
#![allow(dead_code, unreachable_pub, reason = "each test program uses a part of the oracle")]

use nostray::{Q16, Q32, Ray, Real as _, Scalar, Vector};

use super::{Path, Point, Real};

/// A format whose numbers have exact values.
pub trait Exact: Scalar {
    /// Binary digits behind the point, of a format in fixed point.
    const FRACTION: Option<i32>;
    fn real(self) -> Real;
    fn real_unit(unit: Self::Unit) -> Real;

    /// The rounding of a number of this magnitude: the last place of a float, or a step.
    fn last_place(x: f64) -> f64 {
        match Self::FRACTION {
            Some(fraction) => f64::powi(2.0, -fraction),
            None => Self::EPSILON.to_f64() * x.abs().max(f64::MIN_POSITIVE).log2().floor().exp2(),
        }
    }

    /// The exact value of a number of long formulas.
    fn real_wide(wide: Self::Wide) -> Real {
        let high = wide.to_f64();
        let low = (wide - Self::Wide::from_f64(high)).to_f64();
        Real::from(high) + Real::from(low)
    }

    fn point(v: Self::Vec3) -> Point {
        v.to_array().map(Self::real)
    }

    fn path(ray: &Ray<Self>) -> Path {
        Path { origin: Self::point(ray.origin), dir: ray.dir.to_array().map(Self::real_unit) }
    }

    /// A ray whose direction is as long as told, where the format has a say in that.
    fn ray(origin: [f64; 3], dir: [f64; 3]) -> Ray<Self> {
        let wide = Self::WideVec::from_array(dir.map(Self::Wide::from_f64));
        Ray { origin: Self::vector(origin), dir: Self::steer(wide).0 }
    }

    fn vector(v: [f64; 3]) -> Self::Vec3 {
        Self::Vec3::from_array(v.map(Self::from_f64))
    }
}

/// `bits · 2^−fraction`, which f64 could not hold in one piece.
fn fixed(bits: i64, fraction: i32) -> Real {
    let (high, low) = ((bits >> 32) as f64, (bits & 0xffff_ffff) as f64);
    (Real::from(high) * Real::from(4_294_967_296.0) + Real::from(low))
        / Real::from(f64::powi(2.0, fraction))
}

macro_rules! float {
    ($float:ident) => {
        impl Exact for $float {
            const FRACTION: Option<i32> = None;
            fn real(self) -> Real {
                Real::from(f64::from(self))
            }
            fn real_unit(unit: Self) -> Real {
                unit.real()
            }
        }
    };
}

macro_rules! fixed {
    ($name:ident, $fraction:literal, $behind:literal) => {
        impl Exact for $name {
            const FRACTION: Option<i32> = Some($fraction);
            fn real(self) -> Real {
                fixed(self.to_bits().into(), $fraction)
            }
            fn real_unit(unit: Self::Unit) -> Real {
                fixed(unit.to_bits().into(), $behind)
            }
        }
    };
}

float!(f32);
float!(f64);
fixed!(Q16, 16, 30);
fixed!(Q32, 32, 62);

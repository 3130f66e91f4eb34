//! Number formats with the exact value of their numbers.
#![allow(dead_code, unreachable_pub, reason = "each test program uses a part of the oracle")]

use nostray::{Q16, Q32, Scalar, Vector};

use super::{Point, Real};

/// A format, with the exact value of its numbers.
pub trait Exact: Scalar {
    /// How far neighbours are apart, where that is the same everywhere.
    const STEP: Option<f64>;
    fn real(self) -> Real;
    fn real_unit(unit: Self::Unit) -> Real;

    fn real_point(v: Self::Vec3) -> Point {
        v.to_array().map(Self::real)
    }

    fn real_dir(v: Self::Dir) -> Point {
        v.to_array().map(Self::real_unit)
    }

    /// The rounding of a place of a solid of this size.
    fn rounding_of(size: f64) -> f64 {
        Self::STEP.unwrap_or(Self::EPSILON.to_f64() * size)
    }
}

macro_rules! float {
    ($($float:ident)*) => { $(
        impl Exact for $float {
            const STEP: Option<f64> = None;
            fn real(self) -> Real {
                Real::from(f64::from(self))
            }
            fn real_unit(unit: Self) -> Real {
                Real::from(f64::from(unit))
            }
        }
    )* };
}

float!(f32 f64);

/// `bits · 2^−fraction`, which f64 could not hold in one piece.
fn fixed(bits: i64, fraction: i32) -> Real {
    let (high, low) = ((bits >> 32) as f64, (bits & 0xffff_ffff) as f64);
    (Real::from(high) * Real::from(4_294_967_296.0) + Real::from(low))
        / Real::from(f64::powi(2.0, fraction))
}

impl Exact for Q16 {
    const STEP: Option<f64> = Some(1.0 / 65_536.0);
    fn real(self) -> Real {
        fixed(self.to_bits().into(), 16)
    }
    fn real_unit(unit: Self::Unit) -> Real {
        fixed(unit.to_bits().into(), 30)
    }
}

impl Exact for Q32 {
    const STEP: Option<f64> = Some(1.0 / 4_294_967_296.0);
    fn real(self) -> Real {
        fixed(self.to_bits(), 32)
    }
    fn real_unit(unit: Self::Unit) -> Real {
        fixed(unit.to_bits(), 62)
    }
}

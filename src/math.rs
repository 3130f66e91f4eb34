//! The only door to transcendental functions: pinned `libm`, the same bits on every target.
//!
//! The platform's own functions differ between systems, so nothing else in the crate may
//! call a sine, an exponential or a power.

macro_rules! door {
    ($name:ident, $float:ty, $sqrt:path, $sincos:path, $atan2:path, $acos:path, $exp:path, $pow:path, $floor:path) => {
        pub(crate) mod $name {
            #[inline]
            pub(crate) fn sqrt(x: $float) -> $float {
                $sqrt(x)
            }
            #[inline]
            pub(crate) fn floor(x: $float) -> $float {
                $floor(x)
            }
            pub(crate) fn sin_cos(x: $float) -> ($float, $float) {
                $sincos(x)
            }
            pub(crate) fn atan2(y: $float, x: $float) -> $float {
                $atan2(y, x)
            }
            pub(crate) fn acos(x: $float) -> $float {
                $acos(x)
            }
            pub(crate) fn exp(x: $float) -> $float {
                $exp(x)
            }
            pub(crate) fn pow(x: $float, e: $float) -> $float {
                $pow(x, e)
            }
        }
    };
}

door!(
    single,
    f32,
    libm::sqrtf,
    libm::sincosf,
    libm::atan2f,
    libm::acosf,
    libm::expf,
    libm::powf,
    libm::floorf
);
door!(
    double,
    f64,
    libm::sqrt,
    libm::sincos,
    libm::atan2,
    libm::acos,
    libm::exp,
    libm::pow,
    libm::floor
);

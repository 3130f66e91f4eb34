//! What a surface does with light.

use crate::color::Rgb;
use crate::scalar::{Number, Real, Scalar};
use crate::texture::{Channels, Paint};

/// The shape of a highlight.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Highlight {
    /// (R·V)ⁿ with the mirrored light R (B. T. Phong, 1975).
    #[default]
    Phong,
    /// (N·H)ⁿ with the half vector H (J. F. Blinn, 1977).
    Blinn,
}

/// Whether a dielectric reflects more at a grazing angle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fresnel {
    /// The weights stay as they are.
    #[default]
    Off,
    /// C. Schlick's approximation (1994).
    Schlick,
    /// Fresnel's equations for unpolarised light.
    Exact,
}

/// The surface, and the inside, of a solid.
///
/// The light that leaves the surface towards the viewer is
/// `ambient·ka·color + Σ I·(kd·color·max(0, N·L) + ks·max(0, R·V)^shininess)`
/// plus `reflect` times the reflected light, plus `transmit` times the refracted light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material<S: Scalar> {
    /// The colour, or the texture that gives it.
    pub color: Paint<S>,
    /// ka: the share of the ambient light.
    pub ambient: S,
    /// kd: the share of the diffuse reflection.
    pub diffuse: S,
    /// ks: the strength of the highlights.
    pub specular: S,
    /// The exponent of the highlights.
    pub shininess: S,
    /// The shape of the highlights.
    pub highlight: Highlight,
    /// Highlights and mirror images take the surface's colour.
    pub metallic: bool,
    /// The weight of the mirrored ray.
    pub reflect: S,
    /// How far from the mirrored direction mirrored rays go, at most, at a distance of 1: from 0 of a perfect
    /// mirror to 1. Each sample of a pixel follows one of them; a single sample the middle.
    pub roughness: S,
    /// The weight of the refracted ray.
    pub transmit: S,
    /// The index of refraction inside.
    pub ior: S,
    /// Moves weight from transmission and diffuse reflection to the mirrored ray.
    pub fresnel: Fresnel,
    /// Absorption inside, per unit of length: light falls off as e^(−absorb·length).
    pub absorb: Rgb<S>,
    /// The textures that drive other numbers than the colour, and the normals.
    pub channels: Channels,
}

impl<S: Scalar> Material<S> {
    /// White, ka 1, kd 1 and nothing else: what the materials of a `static` scene start from.
    pub const PLAIN: Self = Self {
        color: Paint::Solid(Rgb::WHITE),
        ambient: S::ONE,
        diffuse: S::ONE,
        specular: S::ZERO,
        shininess: S::ONE,
        highlight: Highlight::Phong,
        metallic: false,
        reflect: S::ZERO,
        roughness: S::ZERO,
        transmit: S::ZERO,
        ior: S::ONE,
        fresnel: Fresnel::Off,
        absorb: Rgb::BLACK,
        channels: Channels::NONE,
    };

    /// A dull surface of one colour: ka 1, kd 0.7, nothing else.
    pub fn matte(color: Rgb<S>) -> Self {
        Self {
            color: Paint::Solid(color),
            diffuse: S::from_ratio(7, 10),
            shininess: S::from_i32(32),
            ..Self::PLAIN
        }
    }

    /// Rays pass through.
    #[inline]
    pub fn is_transparent(&self) -> bool {
        self.transmit > S::ZERO
    }

    /// The highlight for a cosine: cosine^shininess.
    #[inline]
    pub(crate) fn lobe(shininess: S, cosine: S::Unit) -> S {
        let whole = shininess.floor_i64();
        match u16::try_from(whole) {
            Ok(n) if S::from_i32(i32::from(n)) == shininess => {
                S::from_unit(cosine.powi(u32::from(n)))
            }
            _ => S::narrow(S::widen_unit(cosine).pow(shininess.widen())),
        }
    }

    /// The share of light that a smooth boundary between two media reflects; `cos_in` and
    /// `cos_out` are the cosines to the normal on the two sides, `ratio` = n₁/n₂.
    pub(crate) fn reflectance(&self, cos_in: S::Wide, cos_out: S::Wide, ratio: S::Wide) -> S::Wide {
        let one = S::Wide::ONE;
        match self.fresnel {
            Fresnel::Off => S::Wide::ZERO,
            // Nothing to reflect at, which the approximation does not know.
            _ if ratio == one => S::Wide::ZERO,
            Fresnel::Schlick => {
                let zero = ((ratio - one) / (ratio + one)).squared();
                // From the denser side the angle that matters is the one outside.
                let cosine = if ratio > one { cos_out } else { cos_in };
                zero + (one - zero) * (one - cosine).powi(5)
            }
            Fresnel::Exact => {
                let s = (ratio * cos_in - cos_out) / (ratio * cos_in + cos_out);
                let p = (ratio * cos_out - cos_in) / (ratio * cos_out + cos_in);
                (s.squared() + p.squared()) * S::Wide::HALF
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_and_broken_exponents_agree() {
        for shininess in [0.0, 1.0, 2.0, 7.0, 32.0, 300.0, 65535.0, 65536.0, 100_000.0, 2.5, 31.75]
        {
            for cosine in [1e-3, 0.5, 0.9, 0.999, 0.99999, 1.0] {
                let expected = libm::pow(cosine, shininess);
                let found = Material::lobe(shininess, cosine);
                assert!((found - expected).abs() <= 1e-11, "{cosine}^{shininess}: {found}");
            }
        }
    }

    #[test]
    fn reflectance_is_zero_between_equal_media_and_one_at_grazing() {
        for fresnel in [Fresnel::Schlick, Fresnel::Exact] {
            let material = Material::<f64> { fresnel, ..Material::matte(Rgb::WHITE) };
            assert_eq!(material.reflectance(0.4, 0.4, 1.0), 0.0);
            assert!((material.reflectance(0.0, 0.745, 1.0 / 1.5) - 1.0).abs() <= 1e-15);
            assert!((material.reflectance(1.0, 1.0, 1.0 / 1.5) - 0.04).abs() <= 1e-15);
            // The same boundary from the other side.
            let (cos_air, cos_glass) = (0.6, libm::sqrt(1.0 - 0.64 / 2.25));
            let there = material.reflectance(cos_air, cos_glass, 1.0 / 1.5);
            let back = material.reflectance(cos_glass, cos_air, 1.5);
            assert!((there - back).abs() <= 1e-15);
        }
    }
}

//! Where light comes from.

use crate::color::Rgb;
use crate::scalar::{Scalar, Vector};

/// How light weakens with the distance r: 1 / (constant + linear·r + quadratic·r²).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attenuation<S> {
    /// Greater than 0, so that the light is bounded.
    pub constant: S,
    /// At least 0.
    pub linear: S,
    /// At least 0.
    pub quadratic: S,
}

impl<S: Scalar> Attenuation<S> {
    /// The same at any distance.
    pub const NONE: Self = Self { constant: S::ONE, linear: S::ZERO, quadratic: S::ZERO };

    #[inline]
    fn at(&self, distance: S) -> S {
        if *self == Self::NONE {
            S::ONE
        } else {
            S::ONE / (self.constant + distance * (self.linear + distance * self.quadratic))
        }
    }
}

/// The edge of a spot light: full inside one cone, nothing outside another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spotlight<S: Scalar> {
    /// The axis of the cones, of unit length, away from the light.
    pub axis: S::Dir,
    /// The cosine of the half angle within which the light is full.
    pub cos_inner: S,
    /// The cosine of the half angle beyond which there is none; less than `cos_inner`.
    pub cos_outer: S,
}

impl<S: Scalar> Spotlight<S> {
    /// The share of the light in a direction away from it, smooth from 0 to 1.
    #[inline]
    fn at(&self, away: S::Dir) -> S {
        let cosine = S::from_unit(self.axis.dot(away));
        if cosine <= self.cos_outer {
            S::ZERO
        } else if cosine >= self.cos_inner {
            S::ONE
        } else {
            let share = (cosine - self.cos_outer) / (self.cos_inner - self.cos_outer);
            share.squared() * (S::from_i32(3) - S::TWO * share)
        }
    }
}

/// A source of light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Light<S: Scalar> {
    /// A point that shines to all sides.
    Point {
        /// Where it is.
        at: S::Vec3,
        /// Its intensity.
        color: Rgb<S>,
        /// How it weakens.
        attenuation: Attenuation<S>,
    },
    /// Parallel light from infinitely far.
    Directional {
        /// Where the light goes, of unit length.
        toward: S::Dir,
        /// Its intensity.
        color: Rgb<S>,
    },
    /// A point that shines into a cone.
    Spot {
        /// Where it is.
        at: S::Vec3,
        /// Its cone.
        cone: Spotlight<S>,
        /// Its intensity.
        color: Rgb<S>,
        /// How it weakens.
        attenuation: Attenuation<S>,
    },
}

/// A light as a point sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Illumination<S: Scalar> {
    /// The unit direction to the light.
    pub toward: S::Dir,
    /// How far the light is.
    pub distance: S,
    /// What arrives if nothing stands between.
    pub color: Rgb<S>,
}

impl<S: Scalar> Light<S> {
    /// What it does to a point, or `None` where it does not shine.
    #[inline]
    pub fn seen_from(&self, point: S::Vec3) -> Option<Illumination<S>> {
        let (at, color, attenuation, cone) = match self {
            Self::Directional { toward, color } => {
                return Some(Illumination { toward: -*toward, distance: S::FAR, color: *color });
            }
            Self::Point { at, color, attenuation } => (*at, *color, attenuation, None),
            Self::Spot { at, cone, color, attenuation } => (*at, *color, attenuation, Some(cone)),
        };
        let (toward, distance) = S::toward(at - point);
        if distance == S::ZERO {
            return None;
        }
        let share = cone.map_or(S::ONE, |cone| cone.at(-toward));
        if share == S::ZERO {
            return None;
        }
        let color = color * (attenuation.at(distance) * share);
        Some(Illumination { toward, distance, color })
    }

    /// The most that arrives anywhere.
    pub(crate) fn brightest(&self) -> Rgb<S> {
        match self {
            Self::Directional { color, .. } => *color,
            Self::Point { color, attenuation, .. } | Self::Spot { color, attenuation, .. } => {
                *color * (S::ONE / attenuation.constant)
            }
        }
    }
}

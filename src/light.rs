//! Where light comes from.

use crate::color::Rgb;
use crate::place::aside;
use crate::sampler::disc;
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

/// A surface that shines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Emitter<S: Scalar> {
    /// A rectangle, or any other parallelogram.
    Rectangle {
        /// Its middle.
        center: S::Vec3,
        /// Two of its edges, from one corner.
        edges: [S::Vec3; 2],
    },
    /// A disc.
    Disc {
        /// Its middle.
        center: S::Vec3,
        /// The unit vector at right angles to it, on either side.
        normal: S::Dir,
        /// Its radius.
        radius: S,
    },
    /// A ball: as the disc of its radius that faces whatever is lit.
    Sphere {
        /// Its middle.
        center: S::Vec3,
        /// Its radius.
        radius: S,
    },
}

impl<S: Scalar> Emitter<S> {
    /// A point of it that shines on `lit`, for a point of the unit square.
    fn point(&self, lit: S::Vec3, [s, t]: [S; 2]) -> S::Vec3 {
        let on_disc = |center: S::Vec3, axis: S::WideVec, radius: S| {
            let ([u, v], [across, along]) = (aside(axis), disc([s, t]));
            center + S::narrow_vec((u * across + v * along) * radius.widen())
        };
        match *self {
            Self::Rectangle { center, edges: [u, v] } => {
                center + u * (s - S::HALF) + v * (t - S::HALF)
            }
            Self::Disc { center, normal, radius } => on_disc(center, S::widen_dir(normal), radius),
            Self::Sphere { center, radius } => {
                let axis = S::widen_dir(S::toward(lit - center).0);
                on_disc(center, axis, radius)
            }
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
    /// A surface, each point of which shines to all sides as a point would, so that its shadows are
    /// soft. Each sample of a pixel sees one point of it; a single sample the middle.
    ///
    /// Nothing is seen of the light itself, and it is in nobody's way.
    Area {
        /// Where it is.
        emitter: Emitter<S>,
        /// Its intensity: what all its points together give.
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
    /// What it does to a point, or `None` where it does not shine. A light with an extent shines from
    /// the point that `sample`, in 0..1 twice, picks; the others do not ask.
    #[inline]
    pub fn seen_from(
        &self,
        point: S::Vec3,
        sample: impl FnOnce() -> [S; 2],
    ) -> Option<Illumination<S>> {
        let (at, color, attenuation, cone) = match self {
            Self::Directional { toward, color } => {
                return Some(Illumination { toward: -*toward, distance: S::FAR, color: *color });
            }
            Self::Point { at, color, attenuation } => (*at, *color, attenuation, None),
            Self::Spot { at, cone, color, attenuation } => (*at, *color, attenuation, Some(cone)),
            Self::Area { emitter, color, attenuation } => {
                (emitter.point(point, sample()), *color, attenuation, None)
            }
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
            Self::Point { color, attenuation, .. }
            | Self::Spot { color, attenuation, .. }
            | Self::Area { color, attenuation, .. } => *color * (S::ONE / attenuation.constant),
        }
    }
}

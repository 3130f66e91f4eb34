//! The structure of a scene file, as it is written in RON or JSON.
//!
//! Everything is in `f64` and as the writer put it: lists of placements are not multiplied,
//! names are not looked up. A field that is not known is an error; one that may be left out
//! says what stands for it.

mod solid;
mod texture;

pub use solid::{Component, Move, Object, Profile, Solid};
pub use texture::{
    Blend, Drawn, Filter, Format, Made, Mapping, PATTERNS, Space, Stop, Texture, Transfer, Wrap,
};

use serde::Deserialize;

use crate::written::{Amount, Background, Paint, Reliefs, Table, Triple, present};

/// A whole scene file.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Document {
    /// The viewer.
    pub camera: Camera,
    /// What lies behind everything; black if left out.
    #[serde(default)]
    pub background: Background,
    /// The light that is everywhere; none if left out.
    #[serde(default)]
    pub ambient: Triple,
    /// The lights.
    #[serde(default)]
    pub lights: Vec<Light>,
    /// The textures, by name, in any order.
    #[serde(default)]
    pub textures: Table<Texture>,
    /// The materials, by name.
    #[serde(default)]
    pub materials: Table<Material>,
    /// The solids.
    #[serde(default)]
    pub objects: Vec<Object>,
}

/// The viewer: a pinhole with `fov`, or parallel rays with `height`.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Camera {
    /// Where the viewer is.
    pub eye: Triple,
    /// The point in the middle of the picture.
    pub look_at: Triple,
    /// A direction that points up in the picture; +y if left out.
    #[serde(default = "upward")]
    pub up: Triple,
    /// The full vertical angle of a pinhole, in degrees; 40 if neither it nor `height` is given.
    #[serde(default, deserialize_with = "present")]
    pub fov: Option<f64>,
    /// The height of an orthographic picture, in the units of the scene.
    #[serde(default, deserialize_with = "present")]
    pub height: Option<f64>,
}

fn upward() -> Triple {
    Triple([0.0, 1.0, 0.0])
}

/// A source of light.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Light {
    /// A point that shines to all sides.
    Point {
        /// Where it is.
        at: Triple,
        /// Its intensity.
        color: Triple,
        /// How it weakens with the distance; not at all if left out.
        #[serde(default)]
        attenuation: Attenuation,
    },
    /// Parallel light from infinitely far.
    Directional {
        /// Where the light goes, of any length but 0.
        toward: Triple,
        /// Its intensity.
        color: Triple,
    },
    /// A point that shines into a cone.
    Spot {
        /// Where it is.
        at: Triple,
        /// The axis of the cone, away from the light, of any length but 0.
        toward: Triple,
        /// The half angle, in degrees, within which the light is full.
        inner: f64,
        /// The half angle, in degrees, beyond which there is none.
        outer: f64,
        /// Its intensity.
        color: Triple,
        /// How it weakens with the distance; not at all if left out.
        #[serde(default)]
        attenuation: Attenuation,
    },
}

/// How light weakens with the distance r: 1 / (constant + linear·r + quadratic·r²).
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Attenuation {
    /// The part that does not depend on the distance; 1 if left out.
    pub constant: f64,
    /// The factor of the distance; 0 if left out.
    pub linear: f64,
    /// The factor of the square of the distance; 0 if left out.
    pub quadratic: f64,
}

impl Default for Attenuation {
    fn default() -> Self {
        Self { constant: 1.0, linear: 0.0, quadratic: 0.0 }
    }
}

/// What a surface does with light, and what fills the solid behind it.
#[derive(Clone, Debug, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Material {
    /// The colour, or the name of a texture; white if left out.
    pub color: Paint,
    /// The share of the ambient light; 1 if left out.
    pub ambient: Amount,
    /// The share of the diffuse reflection; 0.7 if left out.
    pub diffuse: Amount,
    /// The strength of the highlights; 0 if left out.
    pub specular: Amount,
    /// The exponent of the highlights; 32 if left out.
    pub shininess: Amount,
    /// The shape of the highlights; Phong if left out.
    pub highlight: Highlight,
    /// Highlights and mirror images take the surface's colour; not if left out.
    pub metallic: bool,
    /// The weight of the mirrored ray; 0 if left out.
    pub reflect: Amount,
    /// The weight of the refracted ray; 0 if left out.
    pub transmit: Amount,
    /// The index of refraction inside; 1 if left out.
    pub ior: f64,
    /// More reflection at grazing angles; off if left out.
    pub fresnel: Fresnel,
    /// Absorption inside, per unit of length; none if left out.
    pub absorb: Triple,
    /// The textures that are heights over the surface; none if left out.
    pub relief: Reliefs,
}

impl Default for Material {
    fn default() -> Self {
        Self {
            color: Paint::default(),
            ambient: 1.0.into(),
            diffuse: 0.7.into(),
            specular: 0.0.into(),
            shininess: 32.0.into(),
            highlight: Highlight::Phong,
            metallic: false,
            reflect: 0.0.into(),
            transmit: 0.0.into(),
            ior: 1.0,
            fresnel: Fresnel::Off,
            absorb: Triple::default(),
            relief: Reliefs::default(),
        }
    }
}

/// The shape of a highlight.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub enum Highlight {
    /// By the angle between the mirrored light and the viewer.
    Phong,
    /// By the angle between the normal and the half vector.
    Blinn,
}

/// Whether a dielectric reflects more at a grazing angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub enum Fresnel {
    /// The weights stay as they are.
    Off,
    /// Schlick's approximation.
    Schlick,
    /// Fresnel's equations for unpolarised light.
    Exact,
}

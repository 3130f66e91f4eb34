//! From a document to the tables of a scene: names are looked up, placements multiplied.

use std::path::Path as FilePath;

use nostray::{
    Attenuation, Background, Camera, Light, Projection, Real, Rgb, Scalar, Scene, SceneBuilder,
    Spotlight, Vector,
};

use crate::document::{self, Document};
use crate::flaw::{Flaw, Path};
use crate::heap::Heap;
use crate::moves::sin_cos_degrees;
use crate::origin::Origins;
use crate::solids::Planter;
use crate::written::{self, Triple};

/// The tables of a scene, and where in the document each entry came from.
#[derive(Clone, Debug)]
pub struct Assembly<S: Scalar> {
    pub(crate) builder: SceneBuilder<S, Heap>,
    pub(crate) origins: Origins,
}

impl<S: Scalar> Assembly<S> {
    /// Tables that did not come from a document.
    pub fn of_builder(builder: SceneBuilder<S, Heap>) -> Self {
        Self { builder, origins: Origins::default() }
    }

    /// Builds the scene of a document in some number format.
    ///
    /// # Errors
    /// The first thing in the document that makes no scene. What only shows in the whole is
    /// found by [`scene`](Self::scene).
    pub fn of_document(document: &Document) -> Result<Self, Flaw> {
        Self::of_document_in(document, FilePath::new(""))
    }

    /// The same for a document whose images lie in some folder.
    ///
    /// # Errors
    /// As [`of_document`](Self::of_document).
    pub fn of_document_in(document: &Document, folder: &FilePath) -> Result<Self, Flaw> {
        let mut assembly = Self::of_builder(SceneBuilder::new());
        let root = Path::Root;
        assembly.builder.camera = camera(&document.camera, &root.field("camera"))?;
        assembly.builder.background = match document.background {
            written::Background::Constant(color) => Background::Constant(rgb(color)),
            written::Background::Gradient(written::Gradient { bottom, top }) => {
                Background::Gradient { bottom: rgb(bottom), top: rgb(top) }
            }
        };
        assembly.origins.gradient =
            matches!(document.background, written::Background::Gradient { .. });
        assembly.builder.ambient = rgb(document.ambient);
        let textures = assembly.textures(&document.textures, folder)?;
        let materials = assembly.materials(&document.materials, &textures)?;
        for (index, light) in document.lights.iter().enumerate() {
            assembly.light(light, &root.field("lights").entry(index))?;
        }
        let mut planter = Planter::new(&mut assembly.builder, Some(&materials));
        for (index, object) in document.objects.iter().enumerate() {
            planter.object(object, &root.field("objects").entry(index))?;
        }
        Ok(assembly)
    }

    /// The checked scene.
    ///
    /// # Errors
    /// The first thing that is wrong with it, by its path in the document.
    pub fn scene(&self) -> Result<Scene<'_, S>, Flaw> {
        self.builder.scene().map_err(|error| self.origins.flaw(error))
    }

    fn light(&mut self, light: &document::Light, path: &Path<'_>) -> Result<(), Flaw> {
        let variant = match light {
            document::Light::Point { .. } => "Point",
            document::Light::Directional { .. } => "Directional",
            document::Light::Spot { .. } => "Spot",
        };
        let path = path.field(variant);
        let light = match *light {
            document::Light::Point { at, color, attenuation: a } => {
                Light::Point { at: vector::<S>(at), color: rgb(color), attenuation: weakening(a) }
            }
            document::Light::Directional { toward, color } => {
                Light::Directional { toward: unit::<S>(toward, &path)?, color: rgb(color) }
            }
            document::Light::Spot { at, toward, inner, outer, color, attenuation } => {
                let cone = Spotlight {
                    axis: unit::<S>(toward, &path)?,
                    cos_inner: cosine(inner, &path.field("inner"))?,
                    cos_outer: cosine(outer, &path.field("outer"))?,
                };
                let (at, color) = (vector::<S>(at), rgb(color));
                Light::Spot { at, cone, color, attenuation: weakening(attenuation) }
            }
        };
        self.builder.light(light).map_err(|error| Origins::at(&error, path))?;
        self.origins.lights.push(path.to_string());
        Ok(())
    }
}

fn camera<S: Scalar>(written: &document::Camera, path: &Path<'_>) -> Result<Camera<S>, Flaw> {
    let projection = match (written.fov, written.height) {
        (Some(_), Some(_)) => {
            return Err(Flaw::new(path, "has either fov or height, not both"));
        }
        (None, Some(height)) if height <= 0.0 => {
            return Err(Flaw::new(path.field("height"), "must be greater than 0"));
        }
        (None, Some(height)) => Projection::Orthographic { height: S::from_f64(height) },
        (fov, None) => Projection::Pinhole { fov: S::from_f64(fov.unwrap_or(40.0)) },
    };
    Ok(Camera {
        eye: vector::<S>(written.eye),
        look_at: vector::<S>(written.look_at),
        up: vector::<S>(written.up),
        projection,
    })
}

/// A vector in the number format of the scene.
pub(crate) fn vector<S: Scalar>(written: Triple) -> S::Vec3 {
    S::Vec3::from_array(written.0.map(S::from_f64))
}

pub(crate) fn rgb<S: Scalar>(written: Triple) -> Rgb<S> {
    let [r, g, b] = written.0.map(S::from_f64);
    Rgb::new(r, g, b)
}

fn weakening<S: Scalar>(written: document::Attenuation) -> Attenuation<S> {
    Attenuation {
        constant: S::from_f64(written.constant),
        linear: S::from_f64(written.linear),
        quadratic: S::from_f64(written.quadratic),
    }
}

/// The direction `toward` of a light, made a unit vector before it is rounded.
fn unit<S: Scalar>(written: Triple, path: &Path<'_>) -> Result<S::Dir, Flaw> {
    let path = path.field("toward");
    let direction = vector::<f64>(written);
    if !direction.is_finite() {
        return Err(Flaw::new(path, "is not a finite number"));
    }
    if direction == <f64 as Scalar>::Vec3::ZERO {
        return Err(Flaw::new(path, "must not be zero"));
    }
    let unit = Vector::to_array(Vector::normalize(direction)).map(S::Wide::from_f64);
    Ok(S::narrow_dir(S::WideVec::from_array(unit)))
}

fn cosine<S: Scalar>(degrees: f64, path: &Path<'_>) -> Result<S, Flaw> {
    if (0.0..=180.0).contains(&degrees) {
        Ok(S::from_f64(sin_cos_degrees(degrees).1))
    } else {
        Err(Flaw::new(path, "must be between 0 and 180 degrees"))
    }
}

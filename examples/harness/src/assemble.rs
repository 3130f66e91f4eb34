//! From a document to the tables of a scene: names are looked up, placements multiplied.

use std::path::Path as FilePath;

use nostray::{Background, Rgb, Scalar, Scene, SceneBuilder, Vector};

use crate::document::{self, Document};
use crate::flaw::{Flaw, Path};
use crate::heap::Heap;
use crate::lamp;
use crate::origin::Origins;
use crate::solids::Planter;
use crate::viewer::camera;
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
        let path = path.field(lamp::variant(light));
        let light = lamp::light(light, &path)?;
        self.builder.light(light).map_err(|error| Origins::at(&error, path))?;
        self.origins.lights.push(path.to_string());
        Ok(())
    }
}

/// A vector in the number format of the scene.
pub(crate) fn vector<S: Scalar>(written: Triple) -> S::Vec3 {
    S::Vec3::from_array(written.0.map(S::from_f64))
}

/// A colour in the number format of the scene.
pub(crate) fn rgb<S: Scalar>(written: Triple) -> Rgb<S> {
    let [r, g, b] = written.0.map(S::from_f64);
    Rgb::new(r, g, b)
}

//! From a document to the tables of a scene: names are looked up, placements multiplied.

use std::collections::HashMap;

use nostray::{
    Affine, Attenuation, Background, Camera, Checker, Fresnel, Highlight, Light, Mapping, Material,
    Paint, Projection, Real, Rgb, Scalar, Scene, SceneBuilder, Spotlight, Texture, Vector,
};

use crate::document::{self, Document};
use crate::flaw::{Flaw, Path};
use crate::heap::Heap;
use crate::moves::{compose, converted, sin_cos_degrees};
use crate::origin::Origins;
use crate::solids::Planter;
use crate::written::{self, Table, Triple};

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
        let textures = assembly.textures(&document.textures)?;
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

    /// Adds the textures, each after those that it names.
    fn textures<'d>(
        &mut self,
        table: &'d Table<document::Texture>,
    ) -> Result<HashMap<&'d str, u16>, Flaw> {
        let root = Path::Root.field("textures");
        let mut indices = HashMap::new();
        for at in in_order(table)? {
            let Some((name, texture)) = table.0.get(at) else {
                continue;
            };
            let path = root.field(name);
            let path = path.field("Checker");
            let document::Texture::Checker { colors, size, mapping, place } = texture;
            let [even, odd] = &colors.0;
            let checker = Checker {
                paints: [
                    paint(even, &indices, &path.field("colors").entry(0))?,
                    paint(odd, &indices, &path.field("colors").entry(1))?,
                ],
                size: S::Vec3::from_array(size.0.map(S::from_f64)),
                mapping: match mapping {
                    document::Mapping::Uv => Mapping::Uv,
                    document::Mapping::Solid => Mapping::Solid,
                },
                placement: self.texture_placement(*mapping, place, &path.field("place"))?,
            };
            let added = self.builder.texture(Texture::Checker(checker));
            let index = added.map_err(|error| Origins::at(&error, path))?;
            indices.insert(name.as_str(), index);
            self.origins.textures.push(path.to_string());
        }
        Ok(indices)
    }

    fn texture_placement(
        &mut self,
        mapping: document::Mapping,
        place: &[document::Move],
        path: &Path<'_>,
    ) -> Result<Option<u16>, Flaw> {
        if place.is_empty() {
            return Ok(None);
        }
        if mapping == document::Mapping::Uv {
            return Err(Flaw::new(path, "only a pattern with mapping Solid has a place"));
        }
        let to_world: Affine<S> = converted(&compose(place, path)?);
        let added = self.builder.placement(&to_world);
        added.map(Some).map_err(|error| Origins::at(&error, path))
    }

    fn materials<'d>(
        &mut self,
        table: &'d Table<document::Material>,
        textures: &HashMap<&str, u16>,
    ) -> Result<HashMap<&'d str, u16>, Flaw> {
        let root = Path::Root.field("materials");
        let mut indices = HashMap::new();
        for (name, written) in &table.0 {
            let path = root.field(name);
            let material = Material {
                color: paint(&written.color, textures, &path.field("color"))?,
                ambient: S::from_f64(written.ambient),
                diffuse: S::from_f64(written.diffuse),
                specular: S::from_f64(written.specular),
                shininess: S::from_f64(written.shininess),
                highlight: match written.highlight {
                    document::Highlight::Phong => Highlight::Phong,
                    document::Highlight::Blinn => Highlight::Blinn,
                },
                metallic: written.metallic,
                reflect: S::from_f64(written.reflect),
                transmit: S::from_f64(written.transmit),
                ior: S::from_f64(written.ior),
                fresnel: match written.fresnel {
                    document::Fresnel::Off => Fresnel::Off,
                    document::Fresnel::Schlick => Fresnel::Schlick,
                    document::Fresnel::Exact => Fresnel::Exact,
                },
                absorb: rgb(written.absorb),
            };
            let added = self.builder.material(material);
            let index = added.map_err(|error| Origins::at(&error, path))?;
            indices.insert(name.as_str(), index);
            self.origins.materials.push(path.to_string());
        }
        Ok(indices)
    }
}

/// The entries of a table of textures in an order in which each comes after those it names.
fn in_order(table: &Table<document::Texture>) -> Result<Vec<usize>, Flaw> {
    let by_name: HashMap<&str, usize> =
        table.0.iter().enumerate().map(|(index, (name, _))| (name.as_str(), index)).collect();
    let named = |index: usize| {
        let colors =
            table.0.get(index).map(|(_, document::Texture::Checker { colors, .. })| &colors.0);
        colors.into_iter().flatten().filter_map(|paint| match paint {
            written::Paint::Color(_) => None,
            written::Paint::Texture(name) => by_name.get(name.as_str()).copied(),
        })
    };
    // Depth first, on a stack of its own: an entry is placed when all that it names are.
    let mut state = vec![Visit::New; table.0.len()];
    let mut order = Vec::with_capacity(table.0.len());
    for first in 0..table.0.len() {
        let mut waiting = vec![first];
        while let Some(&index) = waiting.last() {
            let Some(visit) = state.get_mut(index).filter(|visit| **visit != Visit::Placed) else {
                waiting.pop();
                continue;
            };
            *visit = Visit::Open;
            let next = named(index).find(|&next| state.get(next) != Some(&Visit::Placed));
            match next {
                None => {
                    waiting.pop();
                    order.push(index);
                    if let Some(visit) = state.get_mut(index) {
                        *visit = Visit::Placed;
                    }
                }
                Some(next) if state.get(next) == Some(&Visit::Open) => {
                    let name = table.0.get(next).map_or("", |(name, _)| name.as_str());
                    let path = Path::Root.field("textures");
                    return Err(Flaw::new(path.field(name), "is made of itself"));
                }
                Some(next) => waiting.push(next),
            }
        }
    }
    Ok(order)
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Visit {
    New,
    Open,
    Placed,
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

fn paint<S: Scalar>(
    written: &written::Paint,
    textures: &HashMap<&str, u16>,
    path: &Path<'_>,
) -> Result<Paint<S>, Flaw> {
    match written {
        written::Paint::Color(color) => Ok(Paint::Solid(rgb(*color))),
        written::Paint::Texture(name) => match textures.get(name.as_str()) {
            Some(&index) => Ok(Paint::Texture(index)),
            None => Err(Flaw::new(path, format!("there is no texture {name:?}"))),
        },
    }
}

/// A vector in the number format of the scene.
pub(crate) fn vector<S: Scalar>(written: Triple) -> S::Vec3 {
    S::Vec3::from_array(written.0.map(S::from_f64))
}

fn rgb<S: Scalar>(written: Triple) -> Rgb<S> {
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

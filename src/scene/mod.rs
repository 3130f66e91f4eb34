//! Everything that a picture is made of, borrowed and checked.

mod build;
mod check;
mod structure;
mod trace;

pub use build::{
    Corners, Fixed, Form, Heights, Metaball, Profile, SceneBuilder, Storage, Store, Triangles,
};
pub use structure::{Structure, structure};
pub use trace::Hit;

use crate::background::Background;
use crate::bounds::Bounds;
use crate::camera::Camera;
use crate::color::Rgb;
use crate::error::{Item, SceneError};
use crate::light::Light;
use crate::material::Material;
use crate::needs;
use crate::place::Placement;
use crate::ray::{Line, Ray};
use crate::scalar::Scalar;
use crate::shape::Tables;
use crate::solid::{Geometry, Node};
use crate::span::{Boundary, Spans};
use crate::texture::{Channel, Image, Paint, Seen, Spot, Stop, Texture, Textures};

/// One solid of a scene: a run of nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Object<S: Scalar> {
    /// The index of its first node.
    pub first: u32,
    /// How many nodes it has.
    pub count: u32,
    /// The material whose index of refraction and absorption fill it.
    pub material: u16,
    /// A box that holds it; rays that miss the box skip the object.
    pub bounds: Option<Bounds<S>>,
}

impl<S: Scalar> Object<S> {
    /// An object of one leaf, or of one operator with its operands, without bounds.
    pub const fn new(first: u32, count: u32, material: u16) -> Self {
        Self { first, count, material, bounds: None }
    }
}

/// The tables of a scene. They may lie in flash, as `static`s.
#[derive(Clone, Copy, Debug)]
pub struct Parts<'a, S: Scalar> {
    /// The leaves and operators of all solids.
    pub nodes: &'a [Node<S>],
    /// The solids.
    pub objects: &'a [Object<S>],
    /// The materials.
    pub materials: &'a [Material<S>],
    /// The textures.
    pub textures: &'a [Texture<S>],
    /// The stops of their ramps.
    pub stops: &'a [Stop<S>],
    /// Their images.
    pub images: &'a [Image],
    /// The bytes of the images.
    pub pixels: &'a [u8],
    /// The textures that drive numbers of materials, and normals.
    pub channels: &'a [Channel<S>],
    /// The lights.
    pub lights: &'a [Light<S>],
    /// The placements of leaves and textures.
    pub placements: &'a [Placement<S>],
    /// What shapes refer to: vertices and the like.
    pub tables: Tables<'a, S>,
    /// The viewer.
    pub camera: Camera<S>,
    /// What lies behind everything.
    pub background: Background<S>,
    /// The light that is everywhere.
    pub ambient: Rgb<S>,
}

impl<S: Scalar> Parts<'_, S> {
    /// The [`needs`] of a scene of these parts, as far as they can be known when it is compiled: mirrors and glass
    /// are among them, for they are so by their numbers.
    pub const fn needs(&self) -> u64 {
        needs::of_parts(self)
    }

    /// Nothing, in the dark: what a `static` scene starts from.
    pub const fn seen_by(camera: Camera<S>) -> Self {
        Self {
            nodes: &[],
            objects: &[],
            materials: &[],
            textures: &[],
            stops: &[],
            images: &[],
            pixels: &[],
            channels: &[],
            lights: &[],
            placements: &[],
            tables: Tables::EMPTY,
            camera,
            background: Background::Constant(Rgb::BLACK),
            ambient: Rgb::BLACK,
        }
    }
}

/// What a scene needs and what it can reach, known before the first ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits<S> {
    /// The boundaries that the evaluation of one solid may hold at a time.
    pub boundaries: u32,
    /// The object that needs so many.
    pub widest: u32,
    /// The surfaces that a ray can go through at most, all objects together.
    pub crossings: u32,
    /// Some material lets light through.
    pub transparent: bool,
    /// The most light of any one surface or of the background, without mirrored and refracted light.
    pub brightest: S,
    /// The most light of the background alone.
    pub background: S,
    /// By how much light can grow from one generation of rays to the one before: the greatest
    /// sum of a material's weights.
    pub growth: S,
}

/// A scene whose every number, index and limit has been checked: nothing that uses it can fail.
///
/// It is made for certain [`needs`], by default for all; for others there is no code.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a, S: Scalar, const NEEDS: u64 = { needs::ALL }> {
    parts: Parts<'a, S>,
    limits: Limits<S>,
}

impl<'a, S: Scalar> Scene<'a, S> {
    /// Checks a scene.
    ///
    /// # Errors
    /// The first thing that is wrong, with its place, its field and the limit.
    pub fn new(parts: Parts<'a, S>) -> Result<Self, SceneError> {
        Self::limited(parts)
    }

    /// Checks a scene that is made for certain [`needs`].
    ///
    /// # Errors
    /// The first thing that is wrong, with its place, its field and the limit; also what the needs do not name.
    pub fn limited<const NEEDS: u64>(
        parts: Parts<'a, S>,
    ) -> Result<Scene<'a, S, NEEDS>, SceneError> {
        let limits = check::check::<S, NEEDS>(&parts)?;
        Ok(Scene { parts, limits })
    }
}

impl<'a, S: Scalar, const NEEDS: u64> Scene<'a, S, NEEDS> {
    /// The tables.
    pub const fn parts(&self) -> &Parts<'a, S> {
        &self.parts
    }

    /// What it needs and what it can reach.
    pub const fn limits(&self) -> &Limits<S> {
        &self.limits
    }

    /// The boundaries of one object along a ray, for t > 0, and whether its origin is inside.
    /// The direction need not have unit length; t counts in lengths of it.
    ///
    /// # Errors
    /// If there is no such object, or if the buffer has less room than [`room`](Self::room) tells.
    pub fn spans<'b>(
        &self,
        object: u32,
        ray: Ray<S>,
        buffer: &'b mut [Boundary<S>],
    ) -> Result<Spans<'b, S>, SceneError> {
        let at = Item::Object(object);
        let needed = self.room(object)?;
        let unknown = self.no_object(object);
        let object = self.parts.objects.get(object as usize).ok_or(unknown)?;
        if needed as usize > buffer.len() {
            return Err(SceneError::SpanOverflow { at, needed, limit: buffer.len() as u32 });
        }
        let line = Line::new(ray, None);
        Ok(self.geometry().evaluate(object.first, object.count, &line, buffer, || ()))
    }

    /// What a paint is at a spot, and which cells of its textures the spot lies in.
    pub fn see(&self, paint: Paint<S>, spot: &Spot<'_, S>) -> Seen<S> {
        self.textures().see(paint, spot, &mut ())
    }

    /// The room that [`spans`](Self::spans) needs for an object: no more than [`limits`](Self::limits) tells,
    /// unless the object is a mesh, which may meet a ray as often as it has triangles, or patches.
    ///
    /// # Errors
    /// If there is no such object.
    pub fn room(&self, object: u32) -> Result<u32, SceneError> {
        let unknown = self.no_object(object);
        let object = self.parts.objects.get(object as usize).ok_or(unknown)?;
        let leaf = self.geometry().leaf(object.first);
        Ok(leaf.map_or(self.limits.boundaries, |leaf| leaf.shape.boundaries_max()))
    }

    fn no_object(&self, index: u32) -> SceneError {
        let len = self.parts.objects.len() as u32;
        SceneError::IndexOutOfRange { at: Item::Object(index), table: "objects", index, len }
    }

    /// There is room for the boundaries of any solid of the scene.
    pub(crate) fn check_room(&self, room: usize) -> Result<(), SceneError> {
        let needed = self.limits.boundaries;
        if needed as usize <= room {
            return Ok(());
        }
        let at = Item::Object(self.limits.widest);
        Err(SceneError::SpanOverflow { at, needed, limit: room as u32 })
    }

    #[inline]
    pub(crate) const fn geometry(&self) -> Geometry<'_, S, NEEDS> {
        Geometry {
            nodes: self.parts.nodes,
            placements: self.parts.placements,
            tables: &self.parts.tables,
        }
    }

    #[inline]
    pub(crate) const fn textures(&self) -> Textures<'a, S, NEEDS> {
        let Parts { textures, stops, images, pixels, placements, .. } = self.parts;
        Textures { textures, stops, images, pixels, placements }
    }

    #[inline]
    pub(crate) fn material(&self, index: u16) -> Option<&'a Material<S>> {
        self.parts.materials.get(usize::from(index))
    }
}

//! Everything that a picture is made of, borrowed and checked.

mod build;
mod check;
mod trace;

pub use build::{Fixed, Form, SceneBuilder, Storage, Store};
pub use trace::Hit;

use crate::background::Background;
use crate::bounds::Bounds;
use crate::camera::Camera;
use crate::color::Rgb;
use crate::error::SceneError;
use crate::light::Light;
use crate::material::Material;
use crate::place::Placement;
use crate::ray::{Line, Ray};
use crate::scalar::Scalar;
use crate::solid::{Geometry, Node};
use crate::span::{Boundary, Spans};
use crate::texture::{Texture, Textures};

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
    /// The lights.
    pub lights: &'a [Light<S>],
    /// The placements of leaves and textures.
    pub placements: &'a [Placement<S>],
    /// The vertices and normals of triangles and polygons.
    pub points: &'a [S::Vec3],
    /// The viewer.
    pub camera: Camera<S>,
    /// What lies behind everything.
    pub background: Background<S>,
    /// The light that is everywhere.
    pub ambient: Rgb<S>,
}

/// What a scene needs and what it can reach, known before the first ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits<S> {
    /// The boundaries that the evaluation of one solid may hold at a time.
    pub boundaries: u32,
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
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a, S: Scalar> {
    parts: Parts<'a, S>,
    limits: Limits<S>,
}

impl<'a, S: Scalar> Scene<'a, S> {
    /// Checks a scene.
    ///
    /// # Errors
    /// The first thing that is wrong, with its place, its field and the limit.
    pub fn new(parts: Parts<'a, S>) -> Result<Self, SceneError> {
        let limits = check::check(&parts)?;
        Ok(Self { parts, limits })
    }

    /// The tables.
    pub const fn parts(&self) -> &Parts<'a, S> {
        &self.parts
    }

    /// What it needs and what it can reach.
    pub const fn limits(&self) -> &Limits<S> {
        &self.limits
    }

    /// The boundaries of one object along a ray, for t > 0, and whether its origin is inside.
    /// The buffer needs the room that [`limits`](Self::limits) tells; `None` for an unknown
    /// object or too small a buffer.
    pub fn spans<'b>(
        &self,
        object: u32,
        ray: Ray<S>,
        buffer: &'b mut [Boundary<S>],
    ) -> Option<Spans<'b, S>> {
        let object = self.parts.objects.get(object as usize)?;
        if buffer.len() < self.limits.boundaries as usize {
            return None;
        }
        let line = Line::new(ray, None);
        Some(self.geometry().evaluate(object.first, object.count, &line, buffer, || ()))
    }

    #[inline]
    pub(crate) const fn geometry(&self) -> Geometry<'a, S> {
        Geometry {
            nodes: self.parts.nodes,
            placements: self.parts.placements,
            points: self.parts.points,
        }
    }

    #[inline]
    pub(crate) const fn textures(&self) -> Textures<'a, S> {
        Textures { textures: self.parts.textures, placements: self.parts.placements }
    }

    #[inline]
    pub(crate) fn material(&self, index: u16) -> Option<&'a Material<S>> {
        self.parts.materials.get(usize::from(index))
    }
}

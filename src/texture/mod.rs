//! Patterns that change a surface from place to place.
//!
//! A parameter that is a colour is a [`Paint`]: one colour, or a texture by index. A texture
//! mixes paints, which may be textures again; it may only name textures before itself, so
//! there are no cycles and the work is bounded.

pub mod cells;
mod checker;
pub mod noise;

pub use checker::{Checker, Mapping};

use crate::color::Rgb;
use crate::place::Placement;
use crate::scalar::Scalar;

/// A colour, or where to find it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Paint<S: Scalar> {
    /// The same everywhere.
    Solid(Rgb<S>),
    /// The texture with this index.
    Texture(u16),
}

/// Where a texture is evaluated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot<S: Scalar> {
    /// The point of the scene.
    pub position: S::Vec3,
    /// The surface's own coordinates.
    pub uv: [S; 2],
}

/// Any of the patterns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Texture<S: Scalar> {
    /// Two paints in alternate cells.
    Checker(Checker<S>),
}

impl<S: Scalar> Texture<S> {
    /// The paints that it is made of.
    pub fn paints(&self) -> [Paint<S>; 2] {
        match self {
            Self::Checker(checker) => checker.paints,
        }
    }

    /// The placement whose local coordinates it lives in.
    pub fn placement(&self) -> Option<u16> {
        match self {
            Self::Checker(checker) => checker.placement,
        }
    }

    /// It asks for the surface's own coordinates.
    pub fn wants_uv(&self) -> bool {
        match self {
            Self::Checker(checker) => checker.mapping == Mapping::Uv,
        }
    }

    /// What it is at a spot.
    fn at(&self, spot: &Spot<S>, placements: &[Placement<S>]) -> Paint<S> {
        match self {
            Self::Checker(checker) => checker.at(spot, placements),
        }
    }
}

/// The textures of a scene.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Textures<'a, S: Scalar> {
    pub(crate) textures: &'a [Texture<S>],
    pub(crate) placements: &'a [Placement<S>],
}

impl<S: Scalar> Textures<'_, S> {
    /// The texture chain behind a paint asks for the surface's own coordinates.
    pub(crate) fn wants_uv(&self, paint: Paint<S>) -> bool {
        // A texture names only earlier ones, so everything up to its index is all it can reach.
        match paint {
            Paint::Solid(_) => false,
            Paint::Texture(index) => {
                self.textures.iter().take(usize::from(index) + 1).any(Texture::wants_uv)
            }
        }
    }

    /// The colour at a spot. Each step goes to an earlier texture, so it ends.
    pub(crate) fn color(&self, mut paint: Paint<S>, spot: &Spot<S>) -> Rgb<S> {
        loop {
            match paint {
                Paint::Solid(color) => return color,
                Paint::Texture(index) => match self.textures.get(usize::from(index)) {
                    Some(texture) => paint = texture.at(spot, self.placements),
                    None => return Rgb::BLACK,
                },
            }
        }
    }
}

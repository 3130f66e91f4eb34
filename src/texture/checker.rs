//! Alternate cells of two paints.

use super::{Paint, Spot};
use crate::place::{Placement, apply};
use crate::scalar::{Scalar, Vector};

/// Which coordinates a pattern is drawn in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mapping {
    /// The surface's own two.
    Uv,
    /// The three of the scene, or of the texture's placement.
    Solid,
}

/// Squares on a surface, or cubes through a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checker<S: Scalar> {
    /// The paint of the cell at the origin, and the other.
    pub paints: [Paint<S>; 2],
    /// The edges of a cell; greater than 0. Two are used of a surface's own coordinates.
    pub size: S::Vec3,
    /// Which coordinates it is drawn in.
    pub mapping: Mapping,
    /// The placement whose local coordinates a solid checker is drawn in.
    pub placement: Option<u16>,
}

impl<S: Scalar> Checker<S> {
    pub(super) fn at(&self, spot: &Spot<S>, placements: &[Placement<S>]) -> Paint<S> {
        let position = match self.mapping {
            Mapping::Uv => S::Vec3::new(spot.uv[0], spot.uv[1], S::ZERO),
            Mapping::Solid => {
                match self.placement.and_then(|index| placements.get(usize::from(index))) {
                    Some(place) => apply::<S>(&place.to_local, spot.position - place.anchor),
                    None => spot.position,
                }
            }
        };
        let cell = |v: S, size: S| (v / size).floor_i64();
        let [x, y, z] = [
            cell(position.x(), self.size.x()),
            cell(position.y(), self.size.y()),
            cell(position.z(), self.size.z()),
        ];
        let [even, odd] = self.paints;
        if (x ^ y ^ z) & 1 == 0 { even } else { odd }
    }
}

//! The torus of the builder.

use super::Stand;
use crate::error::{Item, SceneError};
use crate::place::Affine;
use crate::scalar::Scalar;
use crate::scene::build::{SceneBuilder, Storage, Store};
use crate::shape::{Shape, Torus};

impl<S: Scalar, M: Storage> SceneBuilder<S, M> {
    /// A torus by its middle and axis, and the radii of its circle and its tube.
    pub(super) fn realise_torus(
        &mut self,
        [center, axis]: [S::Vec3; 2],
        [major, minor]: [S; 2],
        to_world: &Affine<S>,
    ) -> Result<(Shape<S>, Option<u16>), SceneError> {
        let at = Item::Node(self.nodes.entries().len() as u32);
        let stand = Stand::around(center, axis, to_world, at)?;
        let (major, minor) = (stand.scaled(major), stand.scaled(minor));
        let shape = Torus { center: stand.centre(), major, minor };
        Ok((Shape::Torus(shape), self.stand(&stand)?))
    }
}

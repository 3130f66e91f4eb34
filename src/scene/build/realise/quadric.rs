//! The quadric of the builder.

use super::Stand;
use crate::error::{Item, SceneError};
use crate::place::{Affine, Placement};
use crate::scalar::{Number, Scalar, Vector};
use crate::scene::build::{SceneBuilder, Storage, Store, add, add_narrow};
use crate::shape::{Quadric, Shape};

impl<S: Scalar, M: Storage> SceneBuilder<S, M> {
    /// A quadric with its coefficients in the table of numbers, as they were given: a scale is
    /// left to the placement.
    pub(super) fn realise_quadric(
        &mut self,
        center: S::Vec3,
        coefficients: [S::Vec3; 3],
        constant: S,
        to_world: &Affine<S>,
    ) -> Result<(Shape<S>, Option<u16>), SceneError> {
        let at = Item::Node(self.nodes.entries().len() as u32);
        let first = self.numbers.entries().len() as u32;
        for number in coefficients.iter().flat_map(|v| v.to_array()).chain([constant]) {
            add(&mut self.numbers, "numbers", number)?;
        }
        let to_world = Affine::translate(center).then(to_world);
        let stand = Stand { to_world, factor: S::Wide::ONE };
        let center = stand.centre();
        let placement = if stand.is_upright() {
            None
        } else {
            let placement =
                Placement::new(&to_world).ok_or(SceneError::SingularPlacement { at })?;
            Some(add_narrow(&mut self.placements, "placements", placement)?)
        };
        Ok((Shape::Quadric(Quadric { center, first }), placement))
    }
}

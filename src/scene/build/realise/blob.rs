//! The blob of the builder: its components go into the tables, from the middle of them all on.

use super::Stand;
use crate::error::{Item, SceneError};
use crate::place::Affine;
use crate::scalar::{Number, Real, Scalar, Vector};
use crate::scene::build::{Metaball, SceneBuilder, Storage, Store, add};
use crate::shape::{Blob, Shape};

impl<S: Scalar, M: Storage> SceneBuilder<S, M> {
    pub(super) fn realise_blob(
        &mut self,
        threshold: S,
        components: &[Metaball<S>],
        to_world: &Affine<S>,
    ) -> Result<(Shape<S>, Option<u16>), SceneError> {
        let at = Item::Node(self.nodes.entries().len() as u32);
        let field = "components";
        let count = u16::try_from(components.len());
        let count = count.map_err(|_| SceneError::TooLarge { at, field })?;
        let ends = components.iter().flat_map(|component| component.ends);
        if !ends.clone().all(|end| end.is_finite()) {
            return Err(SceneError::NotFinite { at, field });
        }
        let far = S::Wide::FAR;
        let around = [S::WideVec::splat(far), S::WideVec::splat(-far)];
        let [low, high] = ends.map(S::widen_vec).fold(around, |[low, high], end| {
            [low.zip(end, S::Wide::min), high.zip(end, S::Wide::max)]
        });
        let middle = if count == 0 { S::WideVec::ZERO } else { (low + high) * S::Wide::HALF };
        let middle = S::narrow_vec(middle);
        let stand = Stand::new(&Affine::translate(middle).then(to_world))
            .ok_or(SceneError::SingularPlacement { at })?;
        let points = self.points.entries().len() as u32;
        let numbers = add(&mut self.numbers, "numbers", threshold)?;
        let mut cylinders = 0;
        for &Metaball { ends, radius, strength } in components {
            let [from, to] = ends.map(|end| {
                let local = (S::widen_vec(end) - S::widen_vec(middle)) * stand.factor;
                S::narrow_vec(local)
            });
            let axis = S::widen_vec(to) - S::widen_vec(from);
            cylinders += u16::from(axis.length_squared() > S::Wide::ZERO);
            add(&mut self.points, "points", from)?;
            add(&mut self.points, "points", to)?;
            add(&mut self.numbers, "numbers", stand.scaled(radius))?;
            add(&mut self.numbers, "numbers", strength)?;
        }
        let shape = Blob { center: stand.centre(), points, numbers, count, cylinders };
        Ok((Shape::Blob(shape), self.stand(&stand)?))
    }
}

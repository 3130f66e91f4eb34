//! Implicit solids: their formula, its numbers and their box go into the tables.

use super::super::{SceneBuilder, Storage, Store, add, add_narrow};
use crate::error::{Item, SceneError};
use crate::place::{Affine, Placement};
use crate::scalar::{Scalar, Vector};
use crate::shape::{Implicit, Shape, program};

/// A formula with its numbers, the corners of its box, and how many spans it may have on a ray.
pub(super) struct Formula<'a, S: Scalar> {
    pub(super) corners: [S::Vec3; 2],
    pub(super) code: &'a [u8],
    pub(super) numbers: &'a [S],
    pub(super) spans: Option<u16>,
}

impl<S: Scalar, M: Storage> SceneBuilder<S, M> {
    pub(super) fn realise_implicit(
        &mut self,
        formula: &Formula<'_, S>,
        to_world: &Affine<S>,
    ) -> Result<(Shape<S>, Option<u16>), SceneError> {
        let at = Item::Node(self.nodes.entries().len() as u32);
        let Formula { corners, code, numbers, spans } = *formula;
        program::check(code, numbers).map_err(|flaw| SceneError::Program {
            at,
            byte: flaw.byte,
            what: flaw.what,
        })?;
        let spans = match spans {
            Some(spans) => spans,
            None => program::spans_bound(code).and_then(|bound| u16::try_from(bound).ok()).ok_or(
                SceneError::OutOfRange {
                    at,
                    field: "spans",
                    allowed: "given for a formula that is not of polynomials",
                },
            )?,
        };
        let long = |field| SceneError::TooLarge { at, field };
        let code_len = u16::try_from(code.len()).map_err(|_| long("code"))?;
        let numbers_len = u16::try_from(numbers.len()).map_err(|_| long("numbers"))?;
        let index = self.points.entries().len() as u32;
        for corner in corners {
            add(&mut self.points, "points", corner)?;
        }
        let first_byte = self.code.entries().len() as u32;
        for &byte in code {
            add(&mut self.code, "code", byte)?;
        }
        let first_number = self.numbers.entries().len() as u32;
        for &number in numbers {
            add(&mut self.numbers, "numbers", number)?;
        }
        let (center, placement) = self.own_place(to_world)?;
        let shape = Implicit {
            center,
            corners: index,
            code: first_byte,
            numbers: first_number,
            code_len,
            numbers_len,
            spans,
        };
        Ok((Shape::Implicit(shape), placement))
    }

    /// Where a solid stands whose lengths cannot be changed: a mere translation is its centre.
    pub(super) fn own_place(
        &mut self,
        to_world: &Affine<S>,
    ) -> Result<(S::Vec3, Option<u16>), SceneError> {
        if to_world.rows == Affine::<S>::identity().rows {
            return Ok((S::narrow_vec(to_world.offset), None));
        }
        let at = Item::Node(self.nodes.entries().len() as u32);
        let placement = Placement::new(to_world).ok_or(SceneError::SingularPlacement { at })?;
        let index = add_narrow(&mut self.placements, "placements", placement)?;
        Ok((S::Vec3::ZERO, Some(index)))
    }
}

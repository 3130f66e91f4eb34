//! What a ray sees that meets nothing.

use crate::color::Rgb;
use crate::scalar::{Scalar, Vector};

/// The light of the sky.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Background<S> {
    /// The same in every direction.
    Constant(Rgb<S>),
    /// From one colour straight down, by the height of the direction, to another straight up.
    Gradient {
        /// The colour at −y.
        bottom: Rgb<S>,
        /// The colour at +y.
        top: Rgb<S>,
    },
}

impl<S: Scalar> Background<S> {
    /// The light from a unit direction.
    #[inline]
    pub fn toward(&self, dir: S::Dir) -> Rgb<S> {
        match *self {
            Self::Constant(color) => color,
            Self::Gradient { bottom, top } => {
                let share = ((S::from_unit(dir.y()) + S::ONE) * S::HALF).clamp(S::ZERO, S::ONE);
                bottom * (S::ONE - share) + top * share
            }
        }
    }

    /// The most light from any direction.
    pub(crate) fn brightest(&self) -> S {
        match *self {
            Self::Constant(color) => color.max_part(),
            Self::Gradient { bottom, top } => bottom.max_part().max(top.max_part()),
        }
    }
}

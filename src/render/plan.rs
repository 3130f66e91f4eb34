//! Which samples make a pixel.

use crate::chance::{Chance, Middle};
use crate::color::Rgb;
use crate::scalar::Scalar;
use crate::stats::{Event, Tally};

/// Which samples make a pixel: [`Centre`] or [`Sampled`](super::Sampled).
pub trait Plan<S: Scalar>: sealed::Work<S> {}

/// A plan for which pixels may be rendered in any order.
pub trait AnyOrder<S: Scalar>: Plan<S> {}

/// One sample in the middle of each pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Centre;

/// The pixel that is rendered.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    pub(super) x: u32,
    pub(super) y: u32,
}

pub(super) mod sealed {
    use super::{Chance, Place, Rgb, Scalar};

    /// A plan that may look out for differences.
    pub trait Watch {
        /// Takes note of something that a sample met.
        #[inline]
        fn meet(&mut self, mark: impl FnOnce() -> u32) {
            let _ = mark;
        }
    }

    /// What a plan does.
    pub trait Work<S: Scalar>: Watch {
        /// Where a sample lies in the dimensions beside the place in the pixel.
        type Chance: Chance<S>;

        /// Where the next sample lies: in which pixel, and where in it.
        fn aim(&self, at: Place) -> ([u32; 2], [S; 2]);

        /// Where it lies in the other dimensions.
        fn chance(&self, at: Place) -> Self::Chance;

        /// Takes the light of a finished sample, and what was cut from it; gives those of the pixel
        /// if the sample was its last.
        fn take(&mut self, at: Place, color: Rgb<S>, spent: S) -> Option<(Rgb<S>, S)>;

        /// Forgets what it knows of pixels before.
        fn restart(&mut self);
    }
}

impl<S: Scalar> Plan<S> for Centre {}

impl<S: Scalar> AnyOrder<S> for Centre {}

impl sealed::Watch for Centre {}

impl<S: Scalar> sealed::Work<S> for Centre {
    type Chance = Middle;

    #[inline]
    fn aim(&self, at: Place) -> ([u32; 2], [S; 2]) {
        ([at.x, at.y], [S::HALF; 2])
    }

    #[inline]
    fn chance(&self, _: Place) -> Middle {
        Middle
    }

    #[inline]
    fn take(&mut self, _: Place, color: Rgb<S>, spent: S) -> Option<(Rgb<S>, S)> {
        Some((color, spent))
    }

    #[inline]
    fn restart(&mut self) {}
}

/// A caller who counts, and a plan that looks out for differences.
pub(super) struct Listeners<'l, T, P> {
    pub(super) tally: &'l mut T,
    pub(super) plan: &'l mut P,
}

impl<T: Tally, P: sealed::Watch> Tally for Listeners<'_, T, P> {
    #[inline]
    fn count(&mut self, event: Event) {
        self.tally.count(event);
    }

    #[inline]
    fn meet(&mut self, mark: impl FnOnce() -> u32 + Copy) {
        self.tally.meet(mark);
        self.plan.meet(mark);
    }
}

//! Several samples a pixel, all of the same weight.

use super::plan::{AnyOrder, Place, Plan, sealed};
use crate::chance::{Chance, Dimension};
use crate::color::Rgb;
use crate::error::{Item, SceneError};
use crate::sampler::{SAMPLES_MAX, Sampler, fraction};
use crate::scalar::{Number, Real, Scalar, Vector};

/// Several samples a pixel, each of the same weight.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampled<S: Scalar> {
    sampler: Sampler,
    /// The sample that is traced.
    index: u16,
    /// Of the samples before.
    sum: S::WideVec,
    spent: S::Wide,
}

impl<S: Scalar> Sampled<S> {
    pub(super) fn new(sampler: Sampler) -> Result<Self, SceneError> {
        if !(1..=SAMPLES_MAX).contains(&sampler.samples) {
            let allowed = "between 1 and 256";
            let at = Item::Sampling;
            return Err(SceneError::OutOfRange { at, field: "samples", allowed });
        }
        Ok(Self { sampler, index: 0, sum: S::WideVec::ZERO, spent: S::Wide::ZERO })
    }
}

impl<S: Scalar> Plan<S> for Sampled<S> {}

impl<S: Scalar> AnyOrder<S> for Sampled<S> {}

impl<S: Scalar> sealed::Watch for Sampled<S> {}

impl<S: Scalar> sealed::Work<S> for Sampled<S> {
    type Chance = Throw;

    fn aim(&self, at: Place) -> ([u32; 2], [S; 2]) {
        ([at.x, at.y], self.sampler.offset(at.x, at.y, self.index))
    }

    fn chance(&self, at: Place) -> Throw {
        Throw { sampler: self.sampler, pixel: [at.x, at.y], index: self.index }
    }

    fn take(&mut self, _: Place, color: Rgb<S>, spent: S) -> Option<(Rgb<S>, S)> {
        self.sum += S::WideVec::from_array(color.to_array().map(Scalar::widen));
        self.spent += spent.widen();
        self.index += 1;
        if self.index < self.sampler.samples {
            return None;
        }
        let count = S::Wide::from_i32(i32::from(self.index));
        let [r, g, b] = self.sum.to_array().map(|sum| S::narrow(sum / count));
        let spent = S::narrow(self.spent / count);
        sealed::Work::<S>::restart(self);
        Some((Rgb::new(r, g, b), spent))
    }

    fn restart(&mut self) {
        (self.index, self.sum, self.spent) = (0, S::WideVec::ZERO, S::Wide::ZERO);
    }
}

/// One sample of a pixel.
#[derive(Clone, Copy, Debug)]
pub struct Throw {
    sampler: Sampler,
    pixel: [u32; 2],
    index: u16,
}

impl<S: Scalar> Chance<S> for Throw {
    fn pair(&self, dimension: Dimension) -> [S; 2] {
        self.sampler.point(self.pixel, self.index, dimension).map(fraction)
    }
}

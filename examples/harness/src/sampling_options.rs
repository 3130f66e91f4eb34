//! The options of the command `render` about samples.

use clap::Args;
use nostray::sampler::SAMPLES_MAX;
use nostray::{PixelFilter, Sampler, Scalar, Spread};

use crate::failure::Failure;
use crate::raster::Sampling;
use crate::source::Loaded;

/// Which samples make a pixel.
#[derive(Clone, Debug, Args)]
pub(crate) struct SamplingOptions {
    /// Samples per pixel, at most 256; a single one is the middle of the pixel
    #[arg(long, value_name = "N", default_value_t = 1)]
    samples: u32,
    /// Refines where contrast exceeds T; not supported
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    adaptive: Option<f64>,
    /// How the samples are spread: grid, jitter, rooks or multi-jitter
    #[arg(long, value_name = "NAME", default_value = "multi-jitter", value_parser = spread)]
    spread: Spread,
    /// What the samples are weighed by: box (the pixel) or tent (to the middles of its neighbours)
    #[arg(long, value_name = "NAME", default_value = "box", value_parser = filter)]
    filter: PixelFilter,
    /// Another seed gives other samples, spread in the same way
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u32,
    /// The diameter of the lens, in units of the scene; 0 for a pinhole
    #[arg(long, value_name = "D", allow_negative_numbers = true)]
    aperture: Option<f64>,
    /// How far the plane in focus is from the eye [default: where the camera looks]
    #[arg(long, value_name = "D", allow_negative_numbers = true)]
    focus: Option<f64>,
}

impl SamplingOptions {
    /// Refuses what cannot be done, before any work.
    pub(crate) fn check(&self) -> Result<(), Failure> {
        let usage = |message: String| Err(Failure::usage(message));
        if !(1..=u32::from(SAMPLES_MAX)).contains(&self.samples) {
            return usage(format!("--samples {}: must be between 1 and 256", self.samples));
        }
        if self.adaptive.is_some() {
            return usage("--adaptive: is not supported".to_owned());
        }
        if let Some(aperture) = self.aperture.filter(|value| !(0.0..=1e6).contains(value)) {
            return usage(format!("--aperture {aperture}: must be between 0 and 1000000"));
        }
        if let Some(focus) = self.focus.filter(|value| !(*value > 0.0 && *value <= 1e6)) {
            return usage(format!("--focus {focus}: must be greater than 0, at most 1000000"));
        }
        Ok(())
    }

    /// Puts the lens before the scene's camera.
    pub(crate) fn set_lens<S: Scalar>(&self, loaded: &mut Loaded<S>) -> Result<(), Failure> {
        loaded.set_lens(self.aperture, self.focus).map_err(Failure::usage)
    }

    /// The samples that are asked for.
    pub(crate) fn sampling(&self) -> Sampling {
        if self.samples == 1 {
            return Sampling::Centre;
        }
        Sampling::Uniform(Sampler {
            spread: self.spread,
            filter: self.filter,
            samples: self.samples as u16,
            seed: self.seed,
        })
    }
}

fn spread(text: &str) -> Result<Spread, String> {
    let found = Spread::ALL.into_iter().find(|spread| spread.name() == text);
    found.ok_or_else(|| "is not grid, jitter, rooks or multi-jitter".to_owned())
}

fn filter(text: &str) -> Result<PixelFilter, String> {
    match text {
        "box" => Ok(PixelFilter::Box),
        "tent" => Ok(PixelFilter::Tent),
        _ => Err("is not box or tent".to_owned()),
    }
}

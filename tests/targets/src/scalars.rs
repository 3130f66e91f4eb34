//! The formats that a program was built for.

use crate::{Digests, digests};
use nostray::SceneError;

/// Computes the picture in each format of the build, and hands over its name and digests.
///
/// # Errors
/// If a scene is refused; the formats after it are left out.
pub fn each_scalar(mut done: impl FnMut(&'static str, Digests)) -> Result<(), SceneError> {
    #[cfg(feature = "f32")]
    done("f32", digests::<f32>()?);
    #[cfg(feature = "f64")]
    done("f64", digests::<f64>()?);
    #[cfg(feature = "q16")]
    done("q16", digests::<nostray::Q16>()?);
    #[cfg(feature = "q32")]
    done("q32", digests::<nostray::Q32>()?);
    Ok(())
}

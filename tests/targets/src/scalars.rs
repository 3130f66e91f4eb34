//! The formats that a program was built for.

use crate::{Digests, Extent, digests};
use nostray::SceneError;

/// Computes the pictures in each format of the build, and hands over its name and digests.
///
/// # Errors
/// If a scene is refused; the formats after it are left out.
pub fn each_scalar(
    extent: Extent,
    mut done: impl FnMut(&'static str, Digests),
) -> Result<(), SceneError> {
    #[cfg(feature = "f32")]
    done("f32", digests::<f32>(extent)?);
    #[cfg(feature = "f64")]
    done("f64", digests::<f64>(extent)?);
    #[cfg(feature = "q16")]
    done("q16", digests::<nostray::Q16>(extent)?);
    #[cfg(feature = "q32")]
    done("q32", digests::<nostray::Q32>(extent)?);
    Ok(())
}

//! The camera of a document in the words of the core.

use nostray::{Camera, Projection, Scalar, Vector};

use crate::assemble::vector;
use crate::document;
use crate::flaw::{Flaw, Path};

/// The camera in the number format of the scene.
pub(crate) fn camera<S: Scalar>(
    written: &document::Camera,
    path: &Path<'_>,
) -> Result<Camera<S>, Flaw> {
    let projection = match (written.fov, written.height) {
        (Some(_), Some(_)) => {
            return Err(Flaw::new(path, "has either fov or height, not both"));
        }
        (None, Some(height)) if height <= 0.0 => {
            return Err(Flaw::new(path.field("height"), "must be greater than 0"));
        }
        (None, Some(height)) => Projection::Orthographic { height: S::from_f64(height) },
        (fov, None) => Projection::Pinhole { fov: S::from_f64(fov.unwrap_or(40.0)) },
    };
    let mut camera = Camera {
        eye: vector::<S>(written.eye),
        look_at: vector::<S>(written.look_at),
        up: vector::<S>(written.up),
        projection,
    };
    match (written.aperture, written.focus) {
        (None, None) => {}
        (None, Some(_)) => return Err(Flaw::new(path.field("focus"), "needs an aperture")),
        (Some(aperture), focus) => match open(&mut camera, aperture, focus) {
            Ok(()) => {}
            Err((field, message)) => return Err(Flaw::new(path.field(field), message)),
        },
    }
    Ok(camera)
}

/// Puts a lens of a diameter before the pinhole of a camera, or takes it away where the diameter is
/// 0; in focus at a distance, at first where the camera looks.
///
/// # Errors
/// The parameter that makes no lens, and why.
pub(crate) fn open<S: Scalar>(
    camera: &mut Camera<S>,
    aperture: f64,
    focus: Option<f64>,
) -> Result<(), (&'static str, &'static str)> {
    let (fov, before) = match camera.projection {
        Projection::Orthographic { .. } => {
            return Err(("aperture", "is only for a camera with fov"));
        }
        Projection::Pinhole { fov } => (fov, None),
        Projection::ThinLens { fov, focus, .. } => (fov, Some(focus)),
    };
    // What is not a number is the core's to refuse.
    if aperture < 0.0 {
        return Err(("aperture", "must be at least 0"));
    }
    if focus.is_some_and(|focus| focus <= 0.0) {
        return Err(("focus", "must be greater than 0"));
    }
    let looked_at = || Vector::length(S::widen_vec(camera.look_at) - S::widen_vec(camera.eye));
    let focus = focus.map(S::from_f64).or(before).unwrap_or_else(|| S::narrow(looked_at()));
    camera.projection = if aperture == 0.0 {
        Projection::Pinhole { fov }
    } else {
        Projection::ThinLens { fov, aperture: S::from_f64(aperture), focus }
    };
    Ok(())
}

//! When to stop following light.

use crate::error::{Item, SceneError};
use crate::scalar::Scalar;

/// When a tree of rays ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Depth<S> {
    /// Static: how many times light may be mirrored or refracted on its way. 0 gives local light only.
    pub depth_max: u16,
    /// Dynamic: a ray whose weight (its greatest share of the pixel) is below this is cut; 0 cuts none.
    pub weight_min: S,
    /// Bounded error: rays are cut only while all that they could have brought to the pixel
    /// stays within this, in units of linear light; 0 cuts none.
    pub error_max: S,
}

impl<S: Scalar> Depth<S> {
    /// Static control alone.
    pub const fn fixed(depth_max: u16) -> Self {
        Self { depth_max, weight_min: S::ZERO, error_max: S::ZERO }
    }

    pub(super) fn check(&self) -> Result<(), SceneError> {
        let at = Item::Depth;
        for (value, field) in [(self.weight_min, "weight_min"), (self.error_max, "error_max")] {
            if !value.is_finite() {
                return Err(SceneError::NotFinite { at, field });
            }
            if value < S::ZERO {
                return Err(SceneError::OutOfRange { at, field, allowed: "at least 0" });
            }
        }
        Ok(())
    }
}

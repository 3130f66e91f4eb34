//! The digest of all pictures, for the program in C and for the test that compares the two.

use nostray::{Rgb, Scalar, SceneError};

use crate::digest::Hash;
use crate::pictures;

/// The digest of every pixel of every picture.
pub(crate) fn digest<S: Scalar>() -> Result<u64, SceneError> {
    let mut hash = Hash::new();
    pictures::trace::<S>(1, &mut |color: Rgb<S>| hash.add(color))?;
    Ok(hash.value())
}

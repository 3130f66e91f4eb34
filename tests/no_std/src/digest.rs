//! The digest of the pictures, for the program in C and for the test that compares the two.

use nostray::{Rgb, Scalar, SceneError};

use crate::pictures;

/// FNV-1a (Fowler, Noll, Vo) over the bits of the light of every pixel of every picture.
pub(crate) fn digest<S: Scalar>() -> Result<u64, SceneError> {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    pictures::trace::<S>(1, &mut |color: Rgb<S>| {
        for part in color.to_array() {
            for &byte in part.to_le_bytes().as_ref() {
                hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
            }
        }
    })?;
    Ok(hash)
}

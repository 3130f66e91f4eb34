//! The digest of the light of pixels.

use nostray::{Rgb, Scalar};

/// FNV-1a (Fowler, Noll, Vo) over the bits of the light of pixels.
pub(crate) struct Hash(u64);

impl Hash {
    pub(crate) const fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    pub(crate) fn add<S: Scalar>(&mut self, color: Rgb<S>) {
        for part in color.to_array() {
            for &byte in part.to_le_bytes().as_ref() {
                self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
            }
        }
    }

    pub(crate) const fn value(&self) -> u64 {
        self.0
    }
}

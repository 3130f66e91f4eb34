//! What is left to chance when a pixel has several samples, and the hash that decides it.

use crate::scalar::Scalar;

/// A dimension of what is sampled: the place in the pixel, or one of the others, each with its own
/// shuffle of the same pattern.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dimension(pub(crate) u32);

impl Dimension {
    /// The place in the pixel.
    pub(crate) const PIXEL: Self = Self(0);
    /// The place on the lens.
    pub(crate) const LENS: Self = Self(1);

    /// The direction of a mirrored ray, for the way that its ray came.
    pub(crate) const fn mirrored(path: u16) -> Self {
        Self(2 << 16 | path as u32)
    }

    /// The place on a light, as seen from the end of a ray that came some way.
    pub(crate) const fn light(path: u16, index: u32) -> Self {
        Self(hash(3 << 16 | path as u32, index) | 1 << 31)
    }
}

/// Where the sample that is being traced lies in each dimension.
pub trait Chance<S> {
    /// Two numbers in 0..1.
    fn pair(&self, dimension: Dimension) -> [S; 2];
}

/// The middle of everything.
#[derive(Clone, Copy, Debug)]
pub struct Middle;

impl<S: Scalar> Chance<S> for Middle {
    #[inline]
    fn pair(&self, _: Dimension) -> [S; 2] {
        [S::HALF; 2]
    }
}

/// Bits in which each bit of the word has its share (A. Appleby, MurmurHash3, the last steps).
pub(crate) const fn mixed(mut word: u32) -> u32 {
    word = word.wrapping_add(0x9e37_79b9);
    word = (word ^ (word >> 16)).wrapping_mul(0x85eb_ca6b);
    word = (word ^ (word >> 13)).wrapping_mul(0xc2b2_ae35);
    word ^ (word >> 16)
}

/// A hash of one word more.
#[inline]
pub(crate) const fn hash(key: u32, word: u32) -> u32 {
    mixed(key.rotate_left(5) ^ mixed(word))
}

//! The pictures that every target must compute to the same bits, as digests.
#![no_std]
#![allow(unsafe_code, reason = "marks that an emulator looks for have names of their own")]

#[path = "../../no_std/src/pictures/mod.rs"]
mod pictures;
mod scalars;
#[cfg(target_arch = "wasm32")]
mod wasm;

use nostray::{Rgb, Scalar, SceneError, Transfer};
use sha2::{Digest, Sha256};

pub use scalars::each_scalar;

/// How much of the pictures is traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// Every pixel.
    Whole,
    /// Every picture with fewer pixels, for slow builds.
    Sketch,
    /// Only the first picture, for the smallest boards.
    Basics,
}

impl Extent {
    /// What a program without a choice was built for.
    pub const BUILT: Self = if cfg!(feature = "sketch") {
        Self::Sketch
    } else if cfg!(feature = "basics") {
        Self::Basics
    } else {
        Self::Whole
    };
}

/// SHA-256 of all pictures: of their bytes in sRGB, and of the bits of their light, least significant
/// byte first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Digests {
    /// Of the bytes, red, green, blue.
    pub rgb8: [u8; 32],
    /// Of the light.
    pub light: [u8; 32],
    /// How many pixels there are.
    pub pixels: u32,
}

/// Computes the pictures. Only the tracing lies between [`tracing_begins`] and [`tracing_ends`].
///
/// # Errors
/// If a scene is refused.
#[inline]
pub fn digests<S: Scalar>(extent: Extent) -> Result<Digests, SceneError> {
    let (mut rgb8, mut light, mut pixels) = (Sha256::new(), Sha256::new(), 0);
    tracing_begins();
    let mut sink = |color: Rgb<S>| {
        tracing_ends();
        rgb8.update(color.to_rgb8(Transfer::Srgb));
        for part in color.to_array() {
            light.update(part.to_le_bytes());
        }
        pixels += 1;
        tracing_begins();
    };
    match extent {
        Extent::Whole => pictures::trace(1, &mut sink)?,
        Extent::Sketch => pictures::trace(2, &mut sink)?,
        Extent::Basics => pictures::trace_basics(1, &mut sink)?,
    }
    tracing_ends();
    Ok(Digests { rgb8: rgb8.finalize().into(), light: light.finalize().into(), pixels })
}

/// Where an emulator begins to count instructions.
#[unsafe(no_mangle)]
#[inline(never)]
pub extern "C" fn tracing_begins() {
    core::hint::black_box(());
}

/// Where an emulator ceases to count instructions.
#[unsafe(no_mangle)]
#[inline(never)]
pub extern "C" fn tracing_ends() {
    core::hint::black_box(1);
}

/// Writes what [`Digests`] of a format say as one line: a word, its name, both digests, the pixels.
pub fn write_line(word: &str, name: &str, digests: &Digests, mut put: impl FnMut(&[u8])) {
    put(word.as_bytes());
    put(b" ");
    put(name.as_bytes());
    for digest in [&digests.rgb8, &digests.light] {
        put(b" ");
        for byte in digest {
            put(&[nibble(byte >> 4), nibble(byte & 15)]);
        }
    }
    put(b" ");
    write_number(digests.pixels, &mut put);
    put(b"\n");
}

/// Writes a number in decimal.
pub fn write_number(number: u32, mut put: impl FnMut(&[u8])) {
    let mut power = 1_000_000_000;
    while power > 1 && number < power {
        power /= 10;
    }
    while power > 0 {
        put(&[nibble((number / power % 10) as u8)]);
        power /= 10;
    }
}

const fn nibble(value: u8) -> u8 {
    if value < 10 { b'0' + value } else { b'a' - 10 + value }
}

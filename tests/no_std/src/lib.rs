//! The digests of small pictures, for a caller in C.
//!
//! The panic handler is this crate's own: with `std` anywhere below it, it would be the
//! second one, and the crate would not compile. There is no global allocator: with `alloc`
//! anywhere below it, the crate would not compile either.
#![no_std]

mod digest;
#[cfg(not(feature = "lean"))]
mod everything;
#[cfg(feature = "lean")]
mod lean;
#[cfg(not(feature = "lean"))]
mod pictures;

/// The digest of the lean picture; 0 if the scene is refused.
#[cfg(feature = "lean")]
#[unsafe(no_mangle)]
pub extern "C" fn nostray_digest_lean() -> u64 {
    lean::digest::<{ lean::NEEDS }>().unwrap_or(0)
}

/// The digest of the pictures in Q16.16; 0 if a scene is refused.
#[cfg(not(feature = "lean"))]
#[unsafe(no_mangle)]
pub extern "C" fn nostray_digest_q16() -> u64 {
    everything::digest::<nostray::Q16>().unwrap_or(0)
}

/// The digest of the pictures in Q32.32; 0 if a scene is refused.
#[cfg(not(feature = "lean"))]
#[unsafe(no_mangle)]
pub extern "C" fn nostray_digest_q32() -> u64 {
    everything::digest::<nostray::Q32>().unwrap_or(0)
}

/// The digest of the pictures in `f32`; 0 if a scene is refused.
#[cfg(feature = "float")]
#[unsafe(no_mangle)]
pub extern "C" fn nostray_digest_f32() -> u64 {
    everything::digest::<f32>().unwrap_or(0)
}

/// The digest of the pictures in `f64`; 0 if a scene is refused.
#[cfg(feature = "float")]
#[unsafe(no_mangle)]
pub extern "C" fn nostray_digest_f64() -> u64 {
    everything::digest::<f64>().unwrap_or(0)
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

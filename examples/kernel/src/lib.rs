//! The Rust half of the module: a picture that is rendered row by row in memory of the caller's.
//!
//! Nothing here allocates, and nothing can panic: the panic handler names a function that does
//! not exist, so that the kernel would refuse a module in which it can be reached.
#![no_std]

mod scene;

use core::mem::{align_of, size_of};

use nostray::{Depth, Q16, Q32, Render, Scalar, Scene, SceneError, Transfer, needs};

/// How often light may be mirrored.
const DEPTH: u16 = 4;

/// What the scene asks for, in either format: there is no code for anything else.
const NEEDS: u64 = scene::q16::PARTS.needs() & !needs::GLASS;

/// A picture in the making, in one of the two formats.
#[derive(Debug)]
#[allow(
    clippy::large_enum_variant,
    reason = "there is one of it, in memory that is lent for either"
)]
pub enum Picture {
    /// Numbers of 32 bits.
    Q16(Render<'static, Q16, 5, 16, (), NEEDS>),
    /// Numbers of 64 bits.
    Q32(Render<'static, Q32, 5, 16, (), NEEDS>),
}

impl Picture {
    /// A picture of so many pixels; `wide` asks for 64 bits.
    ///
    /// # Errors
    /// If it has no pixels, or too many in a row or column.
    pub fn new(wide: bool, width: u32, height: u32) -> Result<Self, SceneError> {
        Ok(if wide {
            let scene = Scene::limited(scene::q32::PARTS)?;
            Self::Q32(Render::new(&scene, width, height, Depth::fixed(DEPTH))?)
        } else {
            let scene = Scene::limited(scene::q16::PARTS)?;
            Self::Q16(Render::new(&scene, width, height, Depth::fixed(DEPTH))?)
        })
    }

    /// Renders the next pixels into red, green and blue bytes; how many there were.
    pub fn render(&mut self, bytes: &mut [u8]) -> usize {
        match self {
            Self::Q16(render) => fill(render, bytes),
            Self::Q32(render) => fill(render, bytes),
        }
    }
}

fn fill<S: Scalar>(render: &mut Render<'static, S, 5, 16, (), NEEDS>, bytes: &mut [u8]) -> usize {
    let mut done = 0;
    // The room first: the other way round a pixel would be taken for which there is none.
    for (room, pixel) in bytes.chunks_exact_mut(3).zip(render) {
        for (byte, value) in room.iter_mut().zip(pixel.color.to_rgb8(Transfer::Srgb)) {
            *byte = value;
        }
        done += 1;
    }
    done
}

/// How many bytes a picture takes.
#[unsafe(no_mangle)]
pub extern "C" fn nostray_picture_size() -> usize {
    size_of::<Picture>()
}

/// To what its address must be aligned.
#[unsafe(no_mangle)]
pub extern "C" fn nostray_picture_align() -> usize {
    align_of::<Picture>()
}

/// Begins a picture at an address; 0, or −1 if it cannot be had in this size.
///
/// # Safety
/// `at` points to memory of [`nostray_picture_size`], aligned as asked for, that nobody else uses.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nostray_picture_begin(
    at: *mut Picture,
    wide: bool,
    width: u32,
    height: u32,
) -> i32 {
    let Ok(picture) = Picture::new(wide, width, height) else {
        return -1;
    };
    // SAFETY: as promised by the caller.
    unsafe { at.write(picture) }
    0
}

/// Renders the next pixels of a picture into `3·pixels` bytes; how many there were.
///
/// # Safety
/// `at` holds a picture that was begun, and `bytes` points to so many bytes; nobody else uses either.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nostray_picture_render(
    at: *mut Picture,
    bytes: *mut u8,
    pixels: u32,
) -> u32 {
    // SAFETY: as promised by the caller.
    let (picture, bytes) =
        unsafe { (&mut *at, core::slice::from_raw_parts_mut(bytes, 3 * pixels as usize)) };
    picture.render(bytes) as u32
}

#[cfg(not(feature = "host"))]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    unsafe extern "C" {
        fn nostray_a_panic_can_be_reached() -> !;
    }
    // SAFETY: no such function exists, so this module exists only without the call.
    unsafe { nostray_a_panic_can_be_reached() }
}

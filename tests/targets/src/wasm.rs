//! WebAssembly: a module that exports a function and imports one, which takes a byte.

use crate::{Extent, each_scalar, write_line};

#[link(wasm_import_module = "env")]
unsafe extern "C" {
    /// Takes a byte of what the program says.
    fn put(byte: u32);
}

/// Says the digests; 0 unless the scene was refused.
#[unsafe(no_mangle)]
extern "C" fn report() -> u32 {
    let say = |bytes: &[u8]| {
        for &byte in bytes {
            // SAFETY: the function takes any number.
            unsafe { put(u32::from(byte)) }
        }
    };
    let told =
        each_scalar(Extent::BUILT, |name, digests| write_line("PICTURE", name, &digests, say));
    u32::from(told.is_err())
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    #[cfg(feature = "prove")]
    {
        unsafe extern "C" {
            fn a_panic_can_be_reached() -> !;
        }
        // SAFETY: no such function exists, so this program exists only without the call.
        unsafe { a_panic_can_be_reached() }
    }
    #[cfg(not(feature = "prove"))]
    core::arch::wasm32::unreachable()
}

//! The digests on a machine without a standard library: a board without an operating system, or
//! Linux by the kernel's calls alone.
#![no_std]
#![no_main]
#![cfg_attr(
    any(
        target_arch = "mips",
        target_arch = "mips64",
        target_arch = "powerpc",
        target_arch = "powerpc64"
    ),
    feature(asm_experimental_arch)
)]

#[cfg_attr(target_os = "linux", path = "linux.rs")]
#[cfg_attr(all(target_os = "none", target_arch = "arm"), path = "cortex_m.rs")]
#[cfg_attr(all(target_os = "none", target_arch = "x86_64"), path = "x86_64.rs")]
#[cfg_attr(
    all(target_os = "none", any(target_arch = "riscv32", target_arch = "riscv64")),
    path = "riscv.rs"
)]
mod machine;
#[cfg(target_os = "none")]
mod memory;

use nostray_targets::{Extent, each_scalar, write_line};

/// Computes the pictures and says their digests; gives the status to exit with.
fn report() -> u32 {
    let result = each_scalar(Extent::BUILT, |name, digests| {
        write_line("PICTURE", name, &digests, machine::put);
    });
    #[cfg(feature = "reachable")]
    assert!(result.is_ok(), "a panic that cannot be ruled out");
    #[cfg(target_os = "none")]
    {
        machine::put(b"STACK ");
        nostray_targets::write_number(memory::stack_used(), machine::put);
        machine::put(b"\n");
    }
    u32::from(result.is_err())
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
    {
        machine::put(b"PANIC\n");
        machine::exit(101)
    }
}

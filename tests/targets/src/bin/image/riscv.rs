//! RISC-V: the emulator's `virt` board, whose serial port speaks and whose test device stops it.

use core::arch::global_asm;
use core::ptr;

use crate::memory;

global_asm!(
    ".section .start, \"ax\"",
    ".global _start",
    "_start:",
    "la sp, __stack_top",
    "la t0, trap",
    "csrw mtvec, t0",
    // The floating-point unit on, if there is one.
    "li t0, 0x2000",
    "csrs mstatus, t0",
    "tail start",
    ".balign 4",
    "trap:",
    "la sp, __stack_top",
    "tail fault",
);

#[unsafe(no_mangle)]
extern "C" fn start() -> ! {
    // SAFETY: nothing has run before.
    unsafe { memory::clear_variables() }
    memory::paint_stack();
    exit(crate::report())
}

#[unsafe(no_mangle)]
extern "C" fn fault() -> ! {
    put(b"FAULT\n");
    exit(3)
}

/// Says some text.
pub(crate) fn put(text: &[u8]) {
    for &byte in text {
        // SAFETY: the transmitter of the board's serial port.
        unsafe { ptr::write_volatile(0x1000_0000 as *mut u8, byte) }
    }
}

/// Ends the program.
pub(crate) fn exit(status: u32) -> ! {
    let code = if status == 0 { 0x5555 } else { status << 16 | 0x3333 };
    loop {
        // SAFETY: the board's test device.
        unsafe { ptr::write_volatile(0x10_0000 as *mut u32, code) }
    }
}

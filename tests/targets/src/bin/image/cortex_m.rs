//! Cortex-M: the vector table, the start, and semihosting to speak and to stop.

use core::arch::asm;
use core::ptr;

use crate::memory;

/// An entry of the vector table.
union Vector {
    handler: unsafe extern "C" fn() -> !,
    stack: *const u32,
}

// SAFETY: the table is never written.
unsafe impl Sync for Vector {}

unsafe extern "C" {
    static __stack_top: u32;
    static __data_load: u32;
    static mut __data_start: u32;
    static mut __data_end: u32;
}

#[unsafe(link_section = ".vectors")]
#[unsafe(no_mangle)]
static VECTORS: [Vector; 48] = {
    let mut table = [const { Vector { handler: fault } }; 48];
    table[0] = Vector { stack: &raw const __stack_top };
    table[1] = Vector { handler: reset };
    table
};

/// The processor starts here, with a stack.
#[unsafe(no_mangle)]
unsafe extern "C" fn reset() -> ! {
    // SAFETY: the sections are where the linker script says, and nothing has run before.
    unsafe {
        memory::clear_variables();
        let (mut to, mut from) = (&raw mut __data_start, &raw const __data_load);
        while to < &raw mut __data_end {
            ptr::write_volatile(to, ptr::read_volatile(from));
            (to, from) = (to.add(1), from.add(1));
        }
    }
    #[cfg(target_abi = "eabihf")]
    {
        // Coprocessors 10 and 11, the floating-point unit, before any function that saves its registers.
        let access = 0xe000_ed88 as *mut u32;
        // SAFETY: the Coprocessor Access Control Register of Armv7-M and Armv8-M.
        unsafe {
            ptr::write_volatile(access, ptr::read_volatile(access) | 0xf << 20);
            asm!("dsb", "isb");
        }
    }
    start()
}

#[unsafe(no_mangle)]
#[inline(never)]
extern "C" fn start() -> ! {
    memory::paint_stack();
    exit(crate::report())
}

unsafe extern "C" fn fault() -> ! {
    put(b"FAULT\n");
    exit(3)
}

/// A call to the debugger, or the emulator in its place.
fn semihosting(operation: u32, argument: *const u32) {
    // SAFETY: the operations used only read what they are given.
    unsafe {
        asm!("bkpt 0xab", inout("r0") operation => _, in("r1") argument, options(nostack));
    }
}

/// Says some text.
pub(crate) fn put(text: &[u8]) {
    const WRITE_CHARACTER: u32 = 0x03;
    for &byte in text {
        let character = u32::from(byte);
        semihosting(WRITE_CHARACTER, &raw const character);
    }
}

/// Ends the program.
pub(crate) fn exit(status: u32) -> ! {
    const EXIT_EXTENDED: u32 = 0x20;
    const APPLICATION_EXIT: u32 = 0x2_0026;
    let block = [APPLICATION_EXIT, status];
    loop {
        semihosting(EXIT_EXTENDED, block.as_ptr());
    }
}

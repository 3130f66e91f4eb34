//! Memory before the program: sections to be filled, and the stack painted to see later how
//! much of it was used.

use core::ptr;

unsafe extern "C" {
    static mut __bss_start: u32;
    static mut __bss_end: u32;
    static mut __stack_low: u32;
    static mut __stack_top: u32;
}

const PAINT: u32 = 0x5afe_c01a;

/// How far below its own frame [`paint_stack`] keeps away.
const MARGIN: usize = 512;

/// Sets the variables that start as zero.
///
/// # Safety
/// Only as the first thing that a program does.
#[inline(always)]
pub(crate) unsafe fn clear_variables() {
    let (mut at, end) = (&raw mut __bss_start, &raw mut __bss_end);
    while at < end {
        // SAFETY: the linker script says that this memory is the variables'.
        unsafe {
            ptr::write_volatile(at, 0);
            at = at.add(1);
        }
    }
}

/// Paints the stack below the caller.
#[inline(never)]
pub(crate) fn paint_stack() {
    let here = 0_u32;
    let limit = (&raw const here as usize).saturating_sub(MARGIN);
    let mut at = &raw mut __stack_low;
    while (at as usize) < limit {
        // SAFETY: below every frame, above every variable.
        unsafe {
            ptr::write_volatile(at, PAINT);
            at = at.add(1);
        }
    }
}

/// The bytes of the stack that have been used since it was painted.
pub(crate) fn stack_used() -> u32 {
    let (mut at, top) = (&raw const __stack_low, &raw const __stack_top);
    // SAFETY: reads what the linker script gives to the stack.
    while at < top && unsafe { ptr::read_volatile(at) } == PAINT {
        at = at.wrapping_add(1);
    }
    (top as usize - at as usize) as u32
}

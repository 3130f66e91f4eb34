//! x86-64 as a kernel is built: from a boot protocol of 32 bits to long mode, with every
//! floating-point instruction made to fault.

use core::arch::{asm, global_asm};

use crate::memory;

global_asm!(
    // The boot protocol of the emulator's small machine (PVH) finds its entry in a note.
    ".section .note.boot, \"a\", @note",
    ".balign 4",
    ".long 4",
    ".long 4",
    ".long 18",
    ".asciz \"Xen\"",
    ".long boot",
    ".section .start, \"ax\"",
    ".code32",
    "boot:",
    "cli",
    "cld",
    "movl $__stack_top, %esp",
    "movl $__bss_start, %edi",
    "movl $__bss_end, %ecx",
    "subl %edi, %ecx",
    "xorl %eax, %eax",
    "rep stosb",
    // The first gigabyte, one to one, in pages of two megabytes.
    "movl $tables + 0x1003, tables",
    "movl $tables + 0x2003, tables + 0x1000",
    "movl $tables + 0x2000, %edi",
    "movl $0x83, %eax",
    "0:",
    "movl %eax, (%edi)",
    "addl $8, %edi",
    "addl $0x200000, %eax",
    "cmpl $0x40000083, %eax",
    "jne 0b",
    "movl $tables, %eax",
    "movl %eax, %cr3",
    // Physical address extension; without OSFXSR every SSE instruction faults.
    "movl $0x20, %eax",
    "movl %eax, %cr4",
    "movl $0xc0000080, %ecx",
    "rdmsr",
    "btsl $8, %eax",
    "wrmsr",
    // Paging, protection, and emulation, with which every x87 instruction faults.
    "movl $0x80000005, %eax",
    "movl %eax, %cr0",
    "lgdt descriptors_here",
    "ljmp $8, $long",
    ".code64",
    "long:",
    "xorl %eax, %eax",
    "movl %eax, %ds",
    "movl %eax, %es",
    "movl %eax, %ss",
    "call start",
    ".section .rodata.descriptors, \"a\"",
    ".balign 8",
    "descriptors:",
    ".quad 0",
    ".quad 0x00209a0000000000",
    "descriptors_here:",
    ".word 15",
    ".long descriptors",
    ".section .bss.tables, \"aw\", @nobits",
    ".balign 4096",
    "tables:",
    ".skip 0x3000",
    options(att_syntax)
);

#[unsafe(no_mangle)]
extern "C" fn start() -> ! {
    memory::paint_stack();
    exit(crate::report())
}

fn out(port: u16, byte: u8) {
    // SAFETY: ports of the serial line and of the emulator's exit device.
    unsafe { asm!("out dx, al", in("dx") port, in("al") byte, options(nomem, nostack)) }
}

/// Says some text.
pub(crate) fn put(text: &[u8]) {
    for &byte in text {
        out(0x3f8, byte);
    }
}

/// Ends the program; the emulator's own status is then `2·(16 + status) + 1`.
pub(crate) fn exit(status: u32) -> ! {
    loop {
        out(0xf4, 16 + status as u8);
    }
}

//! Linux without a C library: an entry point, and two calls of the kernel.

use core::arch::{asm, global_asm};

#[cfg(target_arch = "x86_64")]
global_asm!(".globl _start", "_start:", "xor ebp, ebp", "and rsp, -16", "call start");
#[cfg(target_arch = "x86")]
global_asm!(".globl _start", "_start:", "xor ebp, ebp", "and esp, -16", "call start");
#[cfg(any(target_arch = "aarch64", target_arch = "arm", target_arch = "loongarch64"))]
global_asm!(".globl _start", "_start:", "bl start");
#[cfg(target_arch = "riscv64")]
global_asm!(".globl _start", "_start:", "call start");
// The called function saves registers in its caller's frame.
#[cfg(target_arch = "s390x")]
global_asm!(".globl _start", "_start:", "aghi %r15, -160", "brasl %r14, start");
#[cfg(target_arch = "powerpc")]
global_asm!(".globl _start", "_start:", "stwu 1, -32(1)", "bl start");
#[cfg(target_arch = "powerpc64")]
global_asm!(
    ".globl _start",
    ".type _start, @function",
    "_start:",
    // The table of contents, from the address of this function in register 12.
    "addis 2, 12, .TOC. - _start@ha",
    "addi 2, 2, .TOC. - _start@l",
    "stdu 1, -112(1)",
    "bl start",
    "nop",
);
#[cfg(target_arch = "mips64")]
global_asm!(
    ".globl _start",
    ".set noreorder",
    "_start:",
    "bal 1f",
    "nop",
    "1: .cpsetup $31, $25, 1b",
    "daddiu $29, $29, -32",
    "dla $25, start",
    "jalr $25",
    "nop",
    ".set reorder",
);
#[cfg(target_arch = "mips")]
global_asm!(
    ".globl _start",
    ".set noreorder",
    "_start:",
    "bal 1f",
    "nop",
    "1: .cpload $31",
    "addiu $29, $29, -32",
    "la $25, start",
    "jalr $25",
    "nop",
    ".set reorder",
);

#[unsafe(no_mangle)]
extern "C" fn start() -> ! {
    exit(crate::report())
}

/// The numbers of `write` and `exit_group`.
const CALLS: [usize; 2] = if cfg!(target_arch = "x86_64") {
    [1, 231]
} else if cfg!(target_arch = "x86") {
    [4, 252]
} else if cfg!(any(target_arch = "arm", target_arch = "s390x")) {
    [4, 248]
} else if cfg!(any(target_arch = "powerpc", target_arch = "powerpc64")) {
    [4, 234]
} else if cfg!(target_arch = "mips64") {
    [5001, 5205]
} else if cfg!(target_arch = "mips") {
    [4004, 4246]
} else {
    [64, 94]
};

/// A call of the kernel.
///
/// # Safety
/// The arguments are legal for that call.
#[rustfmt::skip]
unsafe fn call(number: usize, a: usize, b: usize, c: usize) {
    // SAFETY: as promised by the caller; each architecture's registers for calls.
    unsafe {
        #[cfg(target_arch = "x86_64")]
        asm!("syscall", inout("rax") number => _, in("rdi") a, in("rsi") b, in("rdx") c,
            out("rcx") _, out("r11") _);
        // The compiler keeps ebx to itself.
        #[cfg(target_arch = "x86")]
        asm!("xchg ebx, edi", "int 0x80", "xchg ebx, edi", inout("eax") number => _,
            inout("edi") a => _, in("ecx") b, in("edx") c);
        #[cfg(target_arch = "aarch64")]
        asm!("svc 0", in("x8") number, inout("x0") a => _, in("x1") b, in("x2") c);
        // And r7 here.
        #[cfg(target_arch = "arm")]
        asm!("mov {keep}, r7", "mov r7, {number}", "svc 0", "mov r7, {keep}", keep = out(reg) _,
            number = in(reg) number, inout("r0") a => _, in("r1") b, in("r2") c);
        #[cfg(target_arch = "riscv64")]
        asm!("ecall", in("a7") number, inout("a0") a => _, in("a1") b, in("a2") c);
        #[cfg(target_arch = "loongarch64")]
        asm!("syscall 0", in("$a7") number, inout("$a0") a => _, in("$a1") b, in("$a2") c,
            out("$t0") _, out("$t1") _, out("$t2") _, out("$t3") _, out("$t4") _,
            out("$t5") _, out("$t6") _, out("$t7") _, out("$t8") _);
        #[cfg(target_arch = "s390x")]
        asm!("svc 0", in("r1") number, inout("r2") a => _, in("r3") b, in("r4") c);
        #[cfg(any(target_arch = "powerpc", target_arch = "powerpc64"))]
        asm!("sc", inout("r0") number => _, inout("r3") a => _, inout("r4") b => _,
            inout("r5") c => _, out("r6") _, out("r7") _, out("r8") _, out("r9") _, out("r10") _,
            out("r11") _, out("r12") _, out("cr0") _, out("ctr") _);
        #[cfg(any(target_arch = "mips", target_arch = "mips64"))]
        asm!("syscall", inout("$2") number => _, in("$4") a, in("$5") b, in("$6") c,
            out("$3") _, out("$7") _, out("$8") _, out("$9") _, out("$10") _, out("$11") _,
            out("$12") _, out("$13") _, out("$14") _, out("$15") _, out("$24") _, out("$25") _);
    }
}

/// Says some text.
pub(crate) fn put(text: &[u8]) {
    // SAFETY: writes readable memory to the standard output.
    unsafe { call(CALLS[0], 1, text.as_ptr() as usize, text.len()) }
}

/// Ends the program.
pub(crate) fn exit(status: u32) -> ! {
    loop {
        // SAFETY: does not return.
        unsafe { call(CALLS[1], status as usize, 0, 0) }
    }
}

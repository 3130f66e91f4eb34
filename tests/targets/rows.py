"""The targets: how each is built, and what runs it."""

from dataclasses import dataclass

ALL = ("f32", "f64", "q16", "q32")


@dataclass(frozen=True)
class Row:
    """One target, with one machine that runs it."""

    name: str
    kind: str  # board, linux, wasm, host, refusal
    target: str
    machine: str  # for people
    emulator: tuple = ()
    flags: str = ""  # for the compiler
    link: tuple = ()  # for the linker
    profile: str = "release"
    formats: tuple = ALL
    debug: bool = True
    differs: tuple = ()  # formats that cannot have the same bits
    basics: bool = False  # only the first picture
    proof: bool = True  # optimised so far that no panic can be reached


def cortex(name, target, board, machine, ram="0x20000000", ram_size="256K", flash="0",
           flash_size="4M", **more):
    emulator = ("qemu-system-arm", "-M", board, "-nographic", "-monitor", "none",
                "-serial", "none", "-semihosting-config", "enable=on,target=native")
    link = ("-Tlink/cortex_m.x", f"--defsym=__flash={flash}", f"--defsym=__flash_size={flash_size}",
            f"--defsym=__ram={ram}", f"--defsym=__ram_size={ram_size}")
    return Row(name, "board", target, machine, emulator, link=link, **more)


def riscv(name, target, bits, machine):
    emulator = (f"qemu-system-riscv{bits}", "-M", "virt", "-m", "16M", "-nographic",
                "-monitor", "none", "-serial", "stdio", "-bios", "none")
    return Row(name, "board", target, machine, emulator, link=("-Tlink/riscv.x",))


def linux(name, target, emulator, machine, flags="", **more):
    return Row(name, "linux", target, machine, tuple(emulator.split()),
               flags="-Crelocation-model=static " + flags, link=("--entry=_start",), **more)


def host(name, machine, profile="release", flags=""):
    return Row(name, "host", "", machine, profile=profile, flags=flags, debug=False)


ROWS = [
    host("host", "the project's toolchain, opt-level 3; what all are compared with"),
    host("host-o0", "opt-level 0, overflow checked", profile="dev"),
    host("host-o1", "opt-level 1", profile="o1"),
    host("host-os", "opt-level s", profile="small"),
    host("host-native", "every instruction of this processor", flags="-Ctarget-cpu=native"),
    # In fixed point all solids together take more flash than this board has.
    cortex("microbit", "thumbv6m-none-eabi", "microbit", "Cortex-M0, 16 KB RAM, opt-level s",
           ram_size="16K", flash_size="256K", profile="small", formats=("f32",), debug=False,
           basics=True),
    cortex("m0", "thumbv6m-none-eabi", "mps2-an385", "code for Cortex-M0, on a Cortex-M3"),
    cortex("m3", "thumbv7m-none-eabi", "mps2-an385", "Cortex-M3"),
    cortex("m4f", "thumbv7em-none-eabihf", "mps2-an386", "Cortex-M4F, FPU of single precision"),
    cortex("m7", "thumbv7em-none-eabihf", "mps2-an500", "Cortex-M7, FPU of double precision",
           flags="-Ctarget-cpu=cortex-m7"),
    cortex("m33", "thumbv8m.main-none-eabihf", "mps2-an505", "Cortex-M33",
           flash="0x10000000", ram="0x38000000"),
    riscv("riscv32imac", "riscv32imac-unknown-none-elf", 32, "RV32IMAC"),
    riscv("riscv32imafc", "riscv32imafc-unknown-none-elf", 32, "RV32IMAFC, FPU of single precision"),
    riscv("riscv64gc", "riscv64gc-unknown-none-elf", 64, "RV64GC"),
    Row("x86_64-none", "board", "x86_64-unknown-none", "a kernel's x86-64: no SSE, no x87",
        ("qemu-system-x86_64", "-M", "microvm", "-m", "64M", "-nodefaults", "-no-user-config",
         "-nographic", "-no-reboot", "-serial", "stdio",
         "-device", "isa-debug-exit,iobase=0xf4,iosize=4"),
        flags="-Crelocation-model=static -Zplt=yes", link=("-Tlink/x86_64.x", "--build-id=none")),
    Row("wasm32", "wasm", "wasm32-unknown-unknown", "WebAssembly in node", ("node", "wasm.mjs")),
    Row("wasm32-simd", "wasm", "wasm32-unknown-unknown", "the same with SIMD allowed",
        ("node", "wasm.mjs"), flags="-Ctarget-feature=+simd128"),
    linux("aarch64", "aarch64-unknown-linux-gnu", "qemu-aarch64", "Armv8-A"),
    linux("armv7", "armv7-unknown-linux-gnueabihf", "qemu-arm", "Armv7-A, VFPv3"),
    linux("armv7-neon", "armv7-unknown-linux-gnueabihf", "qemu-arm -cpu max", "the same with NEON",
          "-Ctarget-feature=+neon,+vfp4"),
    linux("armel", "arm-unknown-linux-gnueabi", "qemu-arm", "Armv6, software floats"),
    linux("i686", "i686-unknown-linux-gnu", "qemu-i386", "32-bit x86 with SSE2"),
    linux("i586", "i586-unknown-linux-gnu", "qemu-i386", "32-bit x86 with x87 only",
          differs=("f32", "f64")),
    linux("s390x", "s390x-unknown-linux-gnu", "qemu-s390x", "big-endian",
          formats=("f64", "q16", "q32")),
    # QEMU 7.2 computes 3·3 ≠ 9 with MDEBR, which multiplies two floats to a double: it takes the first
    # for a double already. The compiler uses it where floats are extended right before a product, as in
    # the sine of `f32`; where nothing is inlined the two are in different functions.
    linux("s390x-f32", "s390x-unknown-linux-gnu", "qemu-s390x", "big-endian, nothing inlined",
          "-Cllvm-args=-inline-threshold=-9999 -Cllvm-args=-inlinehint-threshold=-9999",
          formats=("f32",), debug=False, proof=False),
    linux("ppc64le", "powerpc64le-unknown-linux-gnu", "qemu-ppc64le", "POWER8"),
    linux("ppc32", "powerpc-unknown-linux-gnu", "qemu-ppc", "big-endian"),
    linux("mips64el", "mips64el-unknown-linux-gnuabi64", "qemu-mips64el", "MIPS64r2"),
    linux("mips32", "mips-unknown-linux-gnu", "qemu-mips", "MIPS32r2, big-endian"),
    linux("riscv64", "riscv64gc-unknown-linux-gnu", "qemu-riscv64", "RV64GC under Linux"),
    linux("loongarch64", "loongarch64-unknown-linux-gnu", "qemu-loongarch64", "LoongArch",
          "-Ctarget-feature=-lsx"),
    cortex("refusal", "thumbv7em-none-eabihf", "mps2-an386",
           "a program in which a panic can be reached must not link", formats=("q16",)),
]

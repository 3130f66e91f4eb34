"""Builds the core library and the images."""

import os
import pathlib
import shutil
import threading

from tools import HERE, Failure, compiler, llvm, output_folder, run, text_of

CORE_MANIFEST = """\
[package]
name = "nothing"
version = "0.0.0"
edition = "2024"
[lib]
path = "nothing.rs"
[workspace]
[profile.release]
codegen-units = 1
panic = "abort"
"""

_locks = {}
_lock = threading.Lock()


def environment(flags, target_folder):
    """The variables for a build that depends on nothing around it."""
    rustc, _ = compiler()
    # The digests are computed without instructions that not every processor has, and in little code.
    flags += ' --cfg sha2_backend="soft" --cfg sha2_backend_soft="compact"'
    env = {name: value for name, value in os.environ.items()
           if name not in ("RUSTUP_TOOLCHAIN", "RUSTC_WRAPPER", "CARGO_ENCODED_RUSTFLAGS",
                           "CARGO_BUILD_TARGET", "RUSTDOC")}
    env.update(RUSTC=rustc, RUSTC_BOOTSTRAP="1", RUSTFLAGS=flags, CARGO_INCREMENTAL="0",
               CARGO_TERM_COLOR="never", CARGO_TARGET_DIR=str(target_folder))
    return env


def sysroot(target):
    """A folder with the core library for a target, built once; with bitcode, so that an image can
    be optimised as a whole, with the sizes of its stack frames, and with calls that need no table of
    addresses."""
    rustc, cargo = compiler()
    version = text_of(rustc, "-vV")
    folder = output_folder() / "core" / target
    stamp = folder / "version"
    with _lock:
        lock = _locks.setdefault(target, threading.Lock())
    with lock:
        if stamp.exists() and stamp.read_text() == version:
            return folder
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        (folder / "Cargo.toml").write_text(CORE_MANIFEST)
        (folder / "nothing.rs").write_text("#![no_std]\n")
        log = folder / "log"
        command = [cargo, "build", "--release", "--target", target,
                   "-Zbuild-std=core,compiler_builtins",
                   "-Zbuild-std-features=compiler-builtins-mem"]
        env = environment("-Cembed-bitcode=yes -Zemit-stack-sizes -Zplt=yes", folder / "build")
        if run("core library", command, log, cwd=folder, env=env) != 0:
            raise Failure("the core library does not build", log)
        library = folder / "lib" / "rustlib" / target / "lib"
        library.mkdir(parents=True)
        for name in ("core", "compiler_builtins"):
            built = list((folder / "build" / target / "release" / "deps").glob(f"lib{name}-*.rlib"))
            if len(built) != 1:
                raise Failure(f"the build of the core library left {len(built)} files of {name}", log)
            shutil.copy(built[0], library)
        shutil.rmtree(folder / "build")
        stamp.write_text(version)
    return folder


def seed(folder, profile):
    """Puts the one large thing that runs while others are compiled, a macro that is the same for all
    targets, into a folder, so that it is not compiled for each anew."""
    name = "debug" if profile == "dev" else profile
    if (folder / name).exists():
        return
    rustc, cargo = compiler()
    made = output_folder() / "build" / "seed"
    with _lock:
        lock = _locks.setdefault("seed", threading.Lock())
    with lock:
        if not (made / name).exists():
            made.mkdir(parents=True, exist_ok=True)
            triple = text_of(rustc, "--print", "host-tuple").strip()
            command = [cargo, "build", "--quiet", "--package", "zerocopy-derive", "--profile", profile,
                       "--target", triple]
            # Where it fails there is no such macro, or each row will say what is wrong.
            run("macros", command, made / f"{profile}.log", env=environment("", made))
            (made / name).mkdir(exist_ok=True)
    # Hard links: times are what decides whether anything is compiled again.
    shutil.copytree(made / name, folder / name, copy_function=os.link, symlinks=True)


def image(row, profile, formats, extra=()):
    """Builds the program of a row; gives the file."""
    folder = output_folder() / "build" / row.name
    folder.mkdir(parents=True, exist_ok=True)
    label = "-".join([profile, *formats, *extra])
    log = folder / f"{label}.log"
    features = ",".join([*formats, *extra])
    if row.kind == "host":
        return host_program(row, profile, features, folder, log)
    seed(folder, profile)
    flags = f"--sysroot {sysroot(row.target)} -Zemit-stack-sizes {row.flags}"
    _, cargo = compiler()
    command = [cargo, "rustc", "--quiet", "--profile", profile, "--target", row.target]
    if row.kind == "wasm":
        command += ["--lib", "--crate-type", "cdylib", "--features", features]
        env = environment(flags, folder)
        env["CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER"] = llvm("lld")
        built, suffix = "nostray_targets.wasm", ".wasm"
    else:
        linker = [f"-Clinker={llvm('ld.lld')}", "-Clinker-flavor=ld.lld"]
        linker += [f"-Clink-arg={argument}" for argument in row.link]
        command += ["--bin", "image", "--features", "image," + features, "--", *linker]
        env = environment(flags, folder)
        built, suffix = "image", ".elf"
    if run("images", command, log, cwd=HERE, env=env) != 0:
        raise Failure("does not build", log)
    built = folder / row.target / ("debug" if profile == "dev" else profile) / built
    kept = folder / (label + suffix)
    shutil.copy(built, kept)
    return kept


def host_program(row, profile, features, folder, log):
    """The program with the standard library, by the toolchain that builds everything else."""
    command = ["cargo", "build", "--quiet", "--profile", profile, "--bin", "host", "--features",
               "host," + features]
    env = {**os.environ, "CARGO_TARGET_DIR": str(folder), "RUSTFLAGS": row.flags}
    if run("host", command, log, cwd=HERE, env=env) != 0:
        raise Failure("does not build", log)
    return folder / ("debug" if profile == "dev" else profile) / "host"


def counter():
    """The plugin that counts instructions."""
    library = output_folder() / "count.so"
    source = pathlib.Path(HERE / "count.c")
    if not library.exists() or library.stat().st_mtime < source.stat().st_mtime:
        log = output_folder() / "count.log"
        command = ["cc", "-O2", "-shared", "-fPIC", "-o", str(library), str(source)]
        if run("host", command, log) != 0:
            raise Failure("the plugin that counts instructions does not build", log)
    return library

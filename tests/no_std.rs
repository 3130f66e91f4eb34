//! The core needs neither `std` nor `alloc`, and its firmware holds no panic.
//!
//! The crate in `tests/no_std` is built as a static library with its own panic handler and
//! no allocator, linked into a program in C, and run: it must give the same bits as the same
//! source inside this test, though the two are built with different settings.
#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test that cannot find its tools must fail, and say which"
)]

use std::env;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

#[path = "no_std/src/picture.rs"]
mod picture;

/// Runs a tool to its end; panics with what it said where it is missing or fails.
fn run(what: &str, command: &mut Command) -> Output {
    let output = match command.output() {
        Ok(output) => output,
        Err(error) => panic!("{what}: {:?} cannot be started: {error}", command.get_program()),
    };
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{what} failed with {}:\n{said}", output.status);
    output
}

/// Builds the static library, for the host, as a firmware would be built.
fn build(crate_folder: &Path, target_folder: &Path) -> PathBuf {
    let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo
        .args(["build", "--offline", "--release", "--quiet"])
        .arg("--manifest-path")
        .arg(crate_folder.join("Cargo.toml"))
        .arg("--target-dir")
        .arg(target_folder);
    // The settings of the build that runs this test are not those of a firmware.
    for name in ["RUSTFLAGS", "CARGO_ENCODED_RUSTFLAGS", "CARGO_BUILD_TARGET", "RUSTC_WRAPPER"] {
        cargo.env_remove(name);
    }
    run("the build without std and alloc", &mut cargo);
    target_folder.join("release/libnostray_bare.a")
}

/// Links the library into a program, leaving out what nothing refers to.
fn link(crate_folder: &Path, library: &Path) -> PathBuf {
    let program = library.with_file_name("nostray_bare");
    let sweep = if cfg!(target_vendor = "apple") { "-Wl,-dead_strip" } else { "-Wl,--gc-sections" };
    let mut cc = Command::new(env::var_os("CC").unwrap_or_else(|| "cc".into()));
    cc.arg(crate_folder.join("main.c")).arg(library).arg(sweep).arg("-o").arg(&program);
    run("the C compiler, which links the proof", &mut cc);
    program
}

#[test]
#[cfg(unix)]
fn the_core_runs_without_std_and_alloc_and_cannot_panic() {
    let crate_folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/no_std");
    let target_folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("no_std");
    let library = build(&crate_folder, &target_folder);
    let program = link(&crate_folder, &library);

    let output = run("the program without std and alloc", &mut Command::new(&program));
    let single = picture::digest::<f32>().expect("the scene is legal in f32");
    let double = picture::digest::<f64>().expect("the scene is legal in f64");
    assert_ne!(single, double, "two formats cannot give the same bits");
    let bare = String::from_utf8_lossy(&output.stdout);
    assert_eq!(bare.trim(), format!("{single:016x} {double:016x}"), "bare against hosted");

    let symbols = run("nm, which lists symbols", Command::new("nm").arg(&program));
    let symbols = String::from_utf8_lossy(&symbols.stdout);
    assert!(symbols.contains("nostray"), "the program has no symbols to judge by");
    let unwelcome = |name: &&str| {
        ["panicking", "_fail", "unwrap_failed", "rust_alloc", "rust_dealloc", "core3fmt"]
            .iter()
            .any(|part| name.contains(part))
    };
    let found: Vec<&str> = symbols.lines().filter(unwelcome).collect();
    assert!(found.is_empty(), "the program holds a panic or an allocation:\n{}", found.join("\n"));
}

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

use nostray::{Q16, Q32, Scalar};

#[path = "no_std/src/digest.rs"]
mod digest;
#[path = "no_std/src/everything.rs"]
mod everything;
#[path = "no_std/src/lean.rs"]
mod lean;
#[path = "no_std/src/pictures/mod.rs"]
mod pictures;

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

/// Builds the static library, for the host, as a firmware would be built, and links it into a
/// program, leaving out what nothing refers to.
fn program(feature: Option<&str>) -> PathBuf {
    let crate_folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/no_std");
    let name = format!("no_std_{}", feature.unwrap_or("fixed"));
    let target_folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo
        .args(["build", "--offline", "--release", "--quiet"])
        .args(feature.map(|feature| format!("--features={feature}")))
        .arg("--manifest-path")
        .arg(crate_folder.join("Cargo.toml"))
        .arg("--target-dir")
        .arg(&target_folder);
    // The settings of the build that runs this test are not those of a firmware.
    for name in ["RUSTFLAGS", "CARGO_ENCODED_RUSTFLAGS", "CARGO_BUILD_TARGET", "RUSTC_WRAPPER"] {
        cargo.env_remove(name);
    }
    run("the build without std and alloc", &mut cargo);
    let library = target_folder.join("release/libnostray_bare.a");
    let program = library.with_file_name("nostray_bare");
    let sweep = if cfg!(target_vendor = "apple") { "-Wl,-dead_strip" } else { "-Wl,--gc-sections" };
    let mut cc = Command::new(env::var_os("CC").unwrap_or_else(|| "cc".into()));
    cc.arg(crate_folder.join("main.c")).arg(&library).arg(sweep).arg("-o").arg(&program);
    cc.args(feature.map(|feature| format!("-D{}", feature.to_uppercase())));
    run("the C compiler, which links the proof", &mut cc);
    program
}

/// The digests that a program prints.
fn digests(program: &Path) -> Vec<String> {
    let output = run("the program without std and alloc", &mut Command::new(program));
    let printed = String::from_utf8_lossy(&output.stdout);
    printed.split_whitespace().map(str::to_owned).collect()
}

/// The digest that this test itself computes.
fn hosted<S: Scalar>() -> String {
    format!("{:016x}", everything::digest::<S>().expect("the scenes are legal"))
}

/// The symbols of a program.
fn symbols(program: &Path) -> String {
    let symbols = run("nm, which lists symbols", Command::new("nm").arg(program));
    let symbols = String::from_utf8_lossy(&symbols.stdout).into_owned();
    assert!(symbols.contains("nostray"), "the program has no symbols to judge by");
    symbols
}

/// The symbols of a program that stand for a panic, text formatting or an allocation.
fn unwelcome(program: &Path) -> Vec<String> {
    let symbols = symbols(program);
    let bad = ["panicking", "_fail", "unwrap_failed", "rust_alloc", "rust_dealloc", "core3fmt"];
    let found = symbols.lines().filter(|name| bad.iter().any(|part| name.contains(part)));
    found.map(str::to_owned).collect()
}

/// The instructions of a program that compute with floats, on x86-64 and AArch64. Moves of
/// whole registers are none: they copy what is no number.
fn float_instructions(program: &Path) -> Vec<String> {
    let mut objdump = Command::new("objdump");
    let listing = run("objdump", objdump.args(["-d", "--no-show-raw-insn"]).arg(program));
    let listing = String::from_utf8_lossy(&listing.stdout).into_owned();
    assert!(listing.lines().count() > 5000, "the program has no code to judge by");
    let computes = |mnemonic: &str| {
        let sse = mnemonic.trim_start_matches('v');
        let scalar = ["ss", "sd", "ps", "pd"].iter().any(|kind| sse.ends_with(kind));
        let verbs = ["add", "sub", "mul", "div", "sqrt", "min", "max", "comi", "ucomi", "cmp"];
        (scalar && verbs.iter().any(|verb| sse.starts_with(verb)))
            || (sse.starts_with("cvt") && sse != "cvt")
            || ["fadd", "fsub", "fmul", "fdiv", "fsqrt", "fcmp", "fcvt", "fld", "fst", "fild"]
                .iter()
                .any(|verb| mnemonic.starts_with(verb))
            || ["scvtf", "ucvtf", "fmadd", "fmsub"].contains(&mnemonic)
    };
    let lines = listing.lines().filter(|line| {
        let mnemonic = line.split('\t').nth(1).and_then(|code| code.split_whitespace().next());
        mnemonic.is_some_and(computes)
    });
    lines.map(str::to_owned).collect()
}

#[test]
#[cfg(unix)]
fn the_core_runs_without_std_and_alloc_and_cannot_panic() {
    let program = program(Some("float"));
    let all = [hosted::<Q16>(), hosted::<Q32>(), hosted::<f32>(), hosted::<f64>()];
    let different: std::collections::BTreeSet<&String> = all.iter().collect();
    assert_eq!(different.len(), 4, "no two formats give the same bits");
    assert_eq!(digests(&program), all, "bare against hosted");
    let found = unwelcome(&program);
    assert!(found.is_empty(), "the program holds a panic or an allocation:\n{}", found.join("\n"));
    assert!(float_instructions(&program).len() > 100, "the search finds float instructions");
    needs_nothing_else(&program);
}

/// A program whose scene is made for what it needs holds nothing of textures and of solids that it does not
/// have; a program with everything, `all`, does, so they would be found.
#[cfg(unix)]
fn needs_nothing_else(all: &Path) {
    let lean = program(Some("lean"));
    let hosted = lean::digest::<{ nostray::needs::ALL }>().expect("the scene is legal");
    assert_eq!(Ok(hosted), lean::digest::<{ lean::NEEDS }>(), "made for less against made for all");
    assert_eq!(digests(&lean), [format!("{hosted:016x}")], "bare against hosted");
    let (all, lean) = (symbols(all), symbols(&lean));
    let names = |symbols: &str, word: &str| {
        let ours = symbols.lines().filter(|line| line.contains("nostray"));
        ours.filter(|line| line.contains(word)).map(str::to_owned).collect::<Vec<_>>()
    };
    for word in ["texture", "torus", "lathe", "quadric", "implicit", "blob", "mesh", "patch"] {
        assert!(!names(&all, word).is_empty(), "the search finds {word}");
        let found = names(&lean, word);
        assert!(found.is_empty(), "the program needs no {word}:\n{}", found.join("\n"));
    }
}

#[test]
#[cfg(all(unix, any(target_arch = "x86_64", target_arch = "aarch64")))]
fn fixed_point_needs_no_floating_point_instruction() {
    let program = program(None);
    assert_eq!(digests(&program), [hosted::<Q16>(), hosted::<Q32>()], "bare against hosted");
    let found = unwelcome(&program);
    assert!(found.is_empty(), "the program holds a panic or an allocation:\n{}", found.join("\n"));
    let found = float_instructions(&program);
    assert!(found.is_empty(), "the program computes with floats:\n{}", found.join("\n"));
}

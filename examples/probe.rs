//! Answers questions about intersections: `cargo run --release --example probe -- --help`.

use std::io::{stderr, stdin, stdout};
use std::process::ExitCode;

use nostray_harness::probe_command;

fn main() -> ExitCode {
    let (mut input, mut out) = (stdin().lock(), stdout().lock());
    probe_command(std::env::args_os(), &mut input, &mut out, &mut stderr()).into()
}

//! Turns a scene into a picture: `cargo run --release --example render -- --help`.

use std::io::{stderr, stdout};
use std::process::ExitCode;

use nostray_harness::render_command;

fn main() -> ExitCode {
    render_command(std::env::args_os(), &mut stdout().lock(), &mut stderr()).into()
}

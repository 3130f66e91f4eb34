//! The digests on a host, with the standard library: what every other target is compared with.

use std::io::{self, Write};
use std::process::ExitCode;

fn main() -> ExitCode {
    let mut text = Vec::new();
    let result = nostray_targets::each_scalar(|name, digests| {
        nostray_targets::write_line(name, &digests, |bytes| text.extend_from_slice(bytes));
    });
    if let Err(error) = result {
        eprintln!("the scene is refused: {error}");
        return ExitCode::FAILURE;
    }
    match io::stdout().write_all(&text) {
        Ok(()) => ExitCode::SUCCESS,
        Err(_) => ExitCode::FAILURE,
    }
}

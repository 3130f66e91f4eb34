//! The digests on a host, with the standard library: what every other target is compared with.

use std::io::{self, Write};
use std::process::ExitCode;

use nostray_targets::{Extent, each_scalar, write_line};

fn main() -> ExitCode {
    let mut text = Vec::new();
    let extents =
        [("PICTURE", Extent::Whole), ("SKETCH", Extent::Sketch), ("BASICS", Extent::Basics)];
    for (word, extent) in extents {
        let result = each_scalar(extent, |name, digests| {
            write_line(word, name, &digests, |bytes| text.extend_from_slice(bytes));
        });
        if let Err(error) = result {
            eprintln!("a scene is refused: {error}");
            return ExitCode::FAILURE;
        }
    }
    match io::stdout().write_all(&text) {
        Ok(()) => ExitCode::SUCCESS,
        Err(_) => ExitCode::FAILURE,
    }
}

//! The same picture on the host: `host q16|q32 WIDTH HEIGHT [FILE]` writes it as PPM to a file, or
//! says the SHA-256 of what it would write.

use std::env;
use std::fs;
use std::process::ExitCode;

use nostray_kernel::Picture;
use sha2::{Digest, Sha256};

fn main() -> ExitCode {
    let words: Vec<String> = env::args().skip(1).collect();
    match picture(&words) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("host: {why}");
            ExitCode::FAILURE
        }
    }
}

fn picture(words: &[String]) -> Result<(), String> {
    let [format, width, height, file @ ..] = words else {
        return Err("usage: host q16|q32 WIDTH HEIGHT [FILE]".into());
    };
    let size = |word: &str| word.parse::<u32>().map_err(|error| format!("{word}: {error}"));
    let (width, height) = (size(width)?, size(height)?);
    let wide = match format.as_str() {
        "q16" => false,
        "q32" => true,
        _ => return Err(format!("{format} is no format: q16 or q32")),
    };
    let mut picture = Picture::new(wide, width, height).map_err(|error| error.to_string())?;
    let mut bytes = format!("P6\n{width} {height}\n255\n").into_bytes();
    let mut row = vec![0; 3 * width as usize];
    while picture.render(&mut row) > 0 {
        bytes.extend_from_slice(&row);
    }
    if let [file] = file {
        return fs::write(file, &bytes).map_err(|error| format!("{file}: {error}"));
    }
    let digest: String = Sha256::digest(&bytes).iter().map(|byte| format!("{byte:02x}")).collect();
    println!("{digest}");
    Ok(())
}

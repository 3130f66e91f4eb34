//! A picture as a file, and as a digest.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use nostray::{Scalar, Transfer};
use sha2::{Digest, Sha256};

use crate::raster::Raster;

/// A format of picture files, by the ending of their names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Portable Network Graphics, 8 bits a channel.
    Png,
    /// Portable pixmap (P6), 8 bits a channel.
    Ppm,
    /// Portable float map (PF), little-endian `f32`, raw linear light, the lowest row first.
    Pfm,
}

impl Format {
    /// The format that a file's name asks for.
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "png" => Some(Self::Png),
            "ppm" => Some(Self::Ppm),
            "pfm" => Some(Self::Pfm),
            _ => None,
        }
    }
}

/// Three bytes a pixel, row by row from the top.
pub fn rgb8<S: Scalar>(raster: &Raster<S>, transfer: Transfer) -> Vec<u8> {
    raster.pixels.iter().flat_map(|pixel| pixel.to_rgb8(transfer)).collect()
}

/// Two digests, in hexadecimal, with a space between: SHA-256 of the bytes of [`rgb8`], and of
/// the little-endian bits of the linear light of the same pixels.
pub fn digest<S: Scalar>(raster: &Raster<S>, transfer: Transfer) -> String {
    let mut light = Sha256::new();
    for part in raster.pixels.iter().flat_map(|pixel| pixel.to_array()) {
        light.update(part.to_le_bytes());
    }
    let hex = |bytes: &[u8]| bytes.iter().map(|byte| format!("{byte:02x}")).collect::<String>();
    let shown = Sha256::digest(rgb8(raster, transfer));
    format!("{} {}", hex(&shown), hex(&light.finalize()))
}

/// Writes a picture. It is written beside the file and then put in its place, so that no
/// partial picture is ever seen under its name.
///
/// # Errors
/// What the file system says.
pub fn write<S: Scalar>(
    raster: &Raster<S>,
    path: &Path,
    format: Format,
    transfer: Transfer,
) -> io::Result<()> {
    let beside = beside(path)?;
    let written = File::create(&beside).and_then(|file| {
        let mut sink = BufWriter::new(file);
        encode(raster, &mut sink, format, transfer)?;
        sink.into_inner().map_err(|error| error.into_error())?;
        std::fs::rename(&beside, path)
    });
    if written.is_err() {
        // The first error is the one to tell.
        let _ = std::fs::remove_file(&beside);
    }
    written
}

/// Writes the bytes of a picture file.
///
/// # Errors
/// What the sink says.
pub fn encode<S: Scalar>(
    raster: &Raster<S>,
    sink: &mut impl Write,
    format: Format,
    transfer: Transfer,
) -> io::Result<()> {
    let (width, height) = (raster.width, raster.height);
    match format {
        Format::Png => {
            use image::ImageEncoder;
            let encoder = image::codecs::png::PngEncoder::new(&mut *sink);
            let bytes = rgb8(raster, transfer);
            let encoded =
                encoder.write_image(&bytes, width, height, image::ExtendedColorType::Rgb8);
            encoded.map_err(io::Error::other)?;
        }
        Format::Ppm => {
            write!(sink, "P6\n{width} {height}\n255\n")?;
            sink.write_all(&rgb8(raster, transfer))?;
        }
        Format::Pfm => {
            write!(sink, "PF\n{width} {height}\n-1.0\n")?;
            for row in raster.pixels.chunks(width.max(1) as usize).rev() {
                for part in row.iter().flat_map(|pixel| pixel.to_array()) {
                    sink.write_all(&(part.to_f64() as f32).to_le_bytes())?;
                }
            }
        }
    }
    sink.flush()
}

/// A name for a file in the same folder that nobody else writes.
fn beside(path: &Path) -> io::Result<PathBuf> {
    let name = path.file_name().ok_or(io::ErrorKind::InvalidFilename)?;
    let mut hidden = std::ffi::OsString::from(".");
    hidden.push(name);
    hidden.push(format!(".{}.part", std::process::id()));
    Ok(path.with_file_name(hidden))
}

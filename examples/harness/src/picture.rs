//! The images of a scene file, in the bytes that the core reads.

use std::path::Path as FilePath;

use image::{DynamicImage, ImageReader};
use nostray::Image;
use nostray::texture;

use crate::document::{Drawn, Format, Made, Transfer};
use crate::flaw::{Flaw, Path};
use crate::globe::globe;

/// The most pixels of an image.
const PIXELS_MAX: u64 = 1 << 26;

/// What an image is, and its bytes.
///
/// # Errors
/// If there is no image, or one that cannot be had.
pub(crate) fn picture(
    drawn: &Drawn,
    folder: &FilePath,
    path: &Path<'_>,
) -> Result<(Image, Vec<u8>), Flaw> {
    let (rgb, width, height) = match (&drawn.file, drawn.made) {
        (Some(file), None) => read(&folder.join(file), file, &path.field("file"))?,
        (None, Some(Made::Globe { width })) => {
            if width % 2 == 1 || !(2..=4096).contains(&width) {
                let path = path.field("made");
                let path = path.field("Globe");
                return Err(Flaw::new(path.field("width"), "must be even, from 2 to 4096"));
            }
            (globe(width), width, width / 2)
        }
        (None, None) => return Err(Flaw::new(path, "needs a file")),
        (Some(_), Some(_)) => {
            return Err(Flaw::new(path.field("made"), "cannot stand beside a file"));
        }
    };
    let format = match drawn.format {
        Format::Rgb8 => texture::Format::Rgb8,
        Format::Grey8 => texture::Format::Grey8,
        Format::Rgb565 => texture::Format::Rgb565,
        Format::Mono1 => texture::Format::Mono1,
    };
    let transfer = match drawn.transfer {
        Transfer::Srgb => nostray::Transfer::Srgb,
        Transfer::Linear => nostray::Transfer::Linear,
    };
    let rows = rgb.chunks(usize::from(width) * 3);
    let bytes = rows.flat_map(|row| packed(row, drawn.format)).collect();
    Ok((Image { first: 0, width, height, format, transfer }, bytes))
}

/// The RGB bytes of a file, and its size.
fn read(file: &FilePath, name: &str, path: &Path<'_>) -> Result<(Vec<u8>, u16, u16), Flaw> {
    let flaw = |error: &dyn std::fmt::Display| Flaw::new(path, format!("{name:?}: {error}"));
    let reader = ImageReader::open(file).map_err(|error| flaw(&error))?;
    let reader = reader.with_guessed_format().map_err(|error| flaw(&error))?;
    let (width, height) = reader.into_dimensions().map_err(|error| flaw(&error))?;
    let size = (u16::try_from(width), u16::try_from(height));
    let ((Ok(wide), Ok(high)), true) = (size, u64::from(width) * u64::from(height) <= PIXELS_MAX)
    else {
        let most = "is too large: at most 65535 pixels across and 67 million in all";
        return Err(flaw(&format!("{width} by {height} pixels {most}")));
    };
    let reader = ImageReader::open(file).map_err(|error| flaw(&error))?;
    let reader = reader.with_guessed_format().map_err(|error| flaw(&error))?;
    let decoded: DynamicImage = reader.decode().map_err(|error| flaw(&error))?;
    Ok((decoded.into_rgb8().into_raw(), wide, high))
}

/// A row of RGB bytes as a format keeps it.
fn packed(row: &[u8], format: Format) -> Vec<u8> {
    let pixels = || {
        row.chunks(3).map(|pixel| match pixel {
            &[r, g, b] => [r, g, b],
            _ => [0; 3],
        })
    };
    let grey = |[r, g, b]: [u8; 3]| {
        ((u32::from(r) * 54 + u32::from(g) * 183 + u32::from(b) * 19 + 128) >> 8) as u8
    };
    match format {
        Format::Rgb8 => row.to_vec(),
        Format::Grey8 => pixels().map(grey).collect(),
        Format::Rgb565 => {
            let small = |v: u8, most: u32| (u32::from(v) * most + 127) / 255;
            let words = pixels()
                .map(|[r, g, b]| (small(r, 31) << 11 | small(g, 63) << 5 | small(b, 31)) as u16);
            words.flat_map(u16::to_be_bytes).collect()
        }
        Format::Mono1 => {
            let bits: Vec<bool> = pixels().map(|pixel| grey(pixel) >= 128).collect();
            let byte = |bits: &[bool]| {
                bits.iter().zip(0..).fold(0, |byte, (bit, n)| byte | u8::from(*bit) << (7 - n))
            };
            bits.chunks(8).map(byte).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_packed_as_the_core_reads_them() {
        let row = [255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255];
        assert_eq!(packed(&row, Format::Rgb8), row);
        assert_eq!(packed(&row, Format::Grey8), [54, 182, 19, 255]);
        assert_eq!(packed(&row, Format::Rgb565), [0xf8, 0, 0x07, 0xe0, 0, 0x1f, 0xff, 0xff]);
        assert_eq!(packed(&row, Format::Mono1), [0b0101_0000]);
        let wide = [255; 30];
        assert_eq!(packed(&wide, Format::Mono1), [0xff, 0b1100_0000]);
    }
}

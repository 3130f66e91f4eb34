//! Pictures in fixed point are those of double precision, within what the steps of the numbers allow.
//!
//! `cargo test --test pictures fixed_point -- --nocapture` prints how near they come.
#![allow(clippy::expect_used, clippy::panic, reason = "that is how a test fails")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

use nostray::{Depth, Q16, Q32, Scalar, Transfer};
use nostray_harness::gallery::{Entry, GALLERY};
use nostray_harness::raster::{Order, render};
use nostray_harness::source::Source;

/// The bytes of a picture.
fn bytes<S: Scalar>(entry: &'static Entry) -> Vec<u8> {
    let loaded = Source::Gallery(entry).load::<S>().expect("a scene of the gallery can be read");
    let scene = loaded.scene().expect("a scene of the gallery is legal");
    let depth = Depth::fixed(8);
    let order = Order { width: 160, height: 120, rows: 0..120, depth, threads: 2, counted: false };
    let raster = render(&scene, &order, &|| ()).expect("the picture has a legal size");
    raster.pixels.iter().flat_map(|color| color.to_rgb8(Transfer::Srgb)).collect()
}

/// The ratio of the greatest signal to the noise, in decibels.
fn psnr(picture: &[u8], reference: &[u8]) -> f64 {
    assert_eq!(picture.len(), reference.len());
    let squares = picture.iter().zip(reference).map(|(&a, &b)| {
        let gap = f64::from(a) - f64::from(b);
        gap * gap
    });
    let mean = squares.sum::<f64>() / reference.len() as f64;
    10.0 * f64::log10(255.0 * 255.0 / mean)
}

#[test]
fn the_gallery_is_that_of_double_precision() {
    for entry in GALLERY {
        let reference = bytes::<f64>(entry);
        let coarse = psnr(&bytes::<Q16>(entry), &reference);
        let fine = psnr(&bytes::<Q32>(entry), &reference);
        println!("{:12} q16 {coarse:5.1} dB, q32 {fine:5.1} dB", entry.name);
        assert!(coarse >= 40.0, "{} in q16: {coarse} dB", entry.name);
        assert!(fine >= 60.0, "{} in q32: {fine} dB", entry.name);
    }
}

//! The bits of the gallery: every scene in every number format gives the picture that is on
//! record, with any number of threads and in any split into rows.
//!
//! `tests/golden/digests.txt` is written anew by `NOSTRAY_BLESS=1 cargo test --test pictures golden`.
//! A change of it is a change of bits, and belongs in the change log.
#![allow(clippy::expect_used, clippy::panic, reason = "that is how a test fails")]

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::{env, fs};

use nostray::{Depth, Q16, Q32, Scalar, Transfer};
use nostray_harness::gallery::{Entry, GALLERY, find};
use nostray_harness::output::digest;
use nostray_harness::raster::{Order, Raster, render};
use nostray_harness::source::Source;

const WIDTH: u32 = 160;
const HEIGHT: u32 = 120;

const RECORD: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden/digests.txt");

/// Says how to read and how to renew the record.
const HEADING: &str = "\
# Scene, number format, SHA-256 of the RGB8 rows, SHA-256 of the linear light, at 160x120.
# Renewed by: NOSTRAY_BLESS=1 cargo test --test pictures golden
";

/// Rows of a scene of the gallery, with the default depth of the command `render`.
fn picture<S: Scalar>(
    entry: &'static Entry,
    rows: std::ops::Range<u32>,
    threads: usize,
) -> Raster<S> {
    let loaded = Source::Gallery(entry).load::<S>().expect("a scene of the gallery can be read");
    let scene = loaded.scene().expect("a scene of the gallery is legal");
    let depth = Depth::fixed(8);
    let order = Order { width: WIDTH, height: HEIGHT, rows, depth, threads, counted: false };
    render(&scene, &order, &|| ()).expect("the picture has a legal size")
}

/// The line of the record for a scene in a number format.
fn line<S: Scalar>(entry: &'static Entry) -> String {
    let raster = picture::<S>(entry, 0..HEIGHT, 2);
    let finite = raster.pixels.iter().all(|color| color.is_finite());
    assert!(finite, "{} in {}: a pixel is not finite", entry.name, S::NAME);
    format!("{} {} {}", entry.name, S::NAME, digest(&raster, Transfer::Srgb))
}

#[test]
fn every_scene_gives_the_bits_on_record() {
    let now: Vec<String> = GALLERY
        .iter()
        .flat_map(|e| [line::<f32>(e), line::<f64>(e), line::<Q16>(e), line::<Q32>(e)])
        .collect();
    if env::var_os("NOSTRAY_BLESS").is_some() {
        let text = format!("{HEADING}{}\n", now.join("\n"));
        fs::write(RECORD, text).expect("the record can be written");
        return;
    }
    let record = fs::read_to_string(RECORD).expect("the record can be read");
    let record: Vec<&str> = record.lines().filter(|line| !line.starts_with('#')).collect();
    let changed: Vec<&String> = now.iter().filter(|line| !record.contains(&&***line)).collect();
    assert!(changed.is_empty(), "not on record (if on purpose: {HEADING}):\n{changed:#?}");
    assert_eq!(record.len(), now.len(), "the record and the gallery have the same scenes");
}

/// The bits of the light of every pixel.
fn bits<S: Scalar>(raster: &Raster<S>) -> Vec<S::Bytes> {
    let parts = raster.pixels.iter().flat_map(|color| color.to_array());
    parts.map(Scalar::to_le_bytes).collect()
}

fn the_same_in_any_split<S: Scalar>(name: &str)
where
    S::Bytes: PartialEq + std::fmt::Debug,
{
    let entry = find(name).expect("a scene of the gallery");
    let whole = bits(&picture::<S>(entry, 0..HEIGHT, 1));
    assert_eq!(whole.len(), (WIDTH * HEIGHT * 3) as usize);
    for threads in [2, 3] {
        let other = bits(&picture::<S>(entry, 0..HEIGHT, threads));
        assert!(whole == other, "{name} in {}: {threads} threads differ from one", S::NAME);
    }
    for cuts in [vec![0, 1, HEIGHT], vec![0, 37, 38, 90, HEIGHT]] {
        let mut parts: Vec<_> = cuts.iter().zip(cuts.iter().skip(1)).collect();
        // The last part first: what was rendered before must not matter.
        parts.reverse();
        let mut rendered: Vec<Vec<S::Bytes>> =
            parts.iter().map(|(from, to)| bits(&picture::<S>(entry, **from..**to, 2))).collect();
        rendered.reverse();
        let joined: Vec<S::Bytes> = rendered.into_iter().flatten().collect();
        assert!(whole == joined, "{name} in {}: rows cut at {cuts:?} differ", S::NAME);
    }
}

#[test]
fn threads_and_rows_do_not_matter_in_single_precision() {
    the_same_in_any_split::<f32>("showcase");
    the_same_in_any_split::<f32>("mirrors");
}

#[test]
fn threads_and_rows_do_not_matter_in_double_precision() {
    the_same_in_any_split::<f64>("glass");
    the_same_in_any_split::<f64>("stress");
}

#[test]
fn threads_and_rows_do_not_matter_in_fixed_point() {
    the_same_in_any_split::<Q16>("glass");
    the_same_in_any_split::<Q32>("mirrors");
}

#[test]
fn every_scene_file_is_in_the_gallery() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/harness/gallery");
    let files: BTreeSet<String> = fs::read_dir(folder)
        .expect("the folder of the gallery")
        .map(|entry| entry.expect("an entry of the folder").path())
        .filter(|path| path.extension() == Some(OsStr::new("ron")))
        .filter_map(|path| path.file_stem().and_then(OsStr::to_str).map(str::to_owned))
        .collect();
    let listed = GALLERY.iter().filter(|entry| entry.text().is_some());
    let listed: BTreeSet<String> = listed.map(|entry| entry.name.to_owned()).collect();
    assert_eq!(files, listed);
}

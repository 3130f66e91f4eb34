//! The command that turns a scene into a picture.

use std::ffi::OsString;
use std::io::{self, IsTerminal, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use clap::Parser;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use nostray::{Depth, Event, Q16, Q32, Scalar, Transfer};

use crate::failure::{Failure, parse, report};
use crate::gallery::GALLERY;
use crate::output::{Format, digest, write};
use crate::raster::{DEPTH_MAX, Onlooker, Order, Raster, render_sampled};
use crate::sampling_options::SamplingOptions;
use crate::source::Source;

/// The greatest picture that is rendered in one go.
const PIXELS_MAX: u64 = 1 << 26;

/// Renders a scene.
#[derive(Clone, Debug, Parser)]
#[command(name = "render", disable_version_flag = true)]
struct Options {
    /// A scene of the gallery, or a .ron, .json or .nff file
    #[arg(value_name = "SCENE", default_value = "showcase")]
    scene: String,
    /// Shows the gallery, one name and a line of description each
    #[arg(long)]
    list: bool,
    /// The picture: .png (default SCENE.png), .ppm, or .pfm (raw linear light)
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// The size in pixels [default: what the scene says, else 640x480]
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<(u32, u32)>,
    /// The number format: f32, f64, or in fixed point q16 (Q16.16), q32 (Q32.32)
    #[arg(long, value_name = "S", default_value = "f32")]
    scalar: String,
    #[command(flatten)]
    sampling: SamplingOptions,
    /// How many times light may be mirrored or refracted, at most 64
    #[arg(long, value_name = "N", default_value_t = 8)]
    depth_max: u32,
    /// Cuts rays whose greatest share of the pixel is below W
    #[arg(long, value_name = "W", default_value_t = 0.0, allow_negative_numbers = true)]
    weight_min: f64,
    /// Cuts rays only while the pixel stays within E of the uncut one, in linear light
    #[arg(long, value_name = "E", default_value_t = 0.0, allow_negative_numbers = true)]
    error_max: f64,
    /// How many threads [default: all cores]
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// Only these rows, the first included, the last not; the picture has no others
    #[arg(long, value_name = "A..B", value_parser = rows)]
    rows: Option<Range<u32>>,
    /// The transfer curve of .png and .ppm: srgb or linear
    #[arg(long, value_name = "CURVE", default_value = "srgb", value_parser = transfer)]
    transfer: Transfer,
    /// Prints the SHA-256 of the RGB8 rows and of the light's little-endian bits, in one line
    #[arg(long)]
    digest: bool,
    /// Prints counters as one JSON object
    #[arg(long)]
    stats: bool,
}

/// Runs the command with its arguments, the first of them the program's name, and gives its
/// exit code: 0, 1 for a bad scene or file, 2 for bad usage. Whatever goes wrong is told in
/// one line on `err`; so is what a file holds but the scene does not.
pub fn render_command(
    args: impl IntoIterator<Item = OsString>,
    out: &mut dyn Write,
    err: &mut dyn Write,
) -> u8 {
    report(run(args.into_iter().collect(), out, err), err)
}

fn run(args: Vec<OsString>, out: &mut dyn Write, err: &mut dyn Write) -> Result<(), Failure> {
    let Some(options) = parse::<Options>(args, out)? else {
        return Ok(());
    };
    if options.list {
        let width = GALLERY.iter().map(|entry| entry.name.len()).max().unwrap_or(0);
        for entry in GALLERY {
            writeln!(out, "{:width$}  {}", entry.name, entry.description)?;
        }
        return Ok(());
    }
    options.check()?;
    match options.scalar.as_str() {
        "f32" => options.picture::<f32>(out, err),
        "f64" => options.picture::<f64>(out, err),
        "q16" => options.picture::<Q16>(out, err),
        "q32" => options.picture::<Q32>(out, err),
        other => Err(Failure::usage(format!("--scalar {other}: is not f32, f64, q16 or q32"))),
    }
}

impl Options {
    /// Refuses what cannot be done, before any work.
    fn check(&self) -> Result<(), Failure> {
        let usage = |message: String| Err(Failure::usage(message));
        self.sampling.check()?;
        if self.depth_max > u32::from(DEPTH_MAX) {
            return usage(format!("--depth-max {}: must be at most {DEPTH_MAX}", self.depth_max));
        }
        for (name, value) in [("--weight-min", self.weight_min), ("--error-max", self.error_max)] {
            if !(0.0..=1e6).contains(&value) {
                return usage(format!("{name} {value}: must be between 0 and 1000000"));
            }
        }
        if self.threads.is_some_and(|threads| !(1..=1024).contains(&threads)) {
            return usage("--threads: must be between 1 and 1024".to_owned());
        }
        Ok(())
    }

    fn picture<S: Scalar>(&self, out: &mut dyn Write, err: &mut dyn Write) -> Result<(), Failure> {
        let source = Source::find(&self.scene).map_err(Failure::usage)?;
        let target = self.target(&source)?;
        let mut loaded = source.load::<S>().map_err(Failure::scene)?;
        self.sampling.set_lens(&mut loaded)?;
        let order = self.order::<S>(loaded.size)?;
        let name = source.name();
        let scene = loaded.scene().map_err(Failure::scene)?;

        for note in &loaded.notes {
            writeln!(err, "note: {note}")?;
        }
        let bar = progress(order.rows.len());
        let begun = Instant::now();
        let onlooker = Onlooker { on_row: &|_, _| bar.inc(1), stop: &AtomicBool::new(false) };
        let rendered = render_sampled(&scene, &order, self.sampling.sampling(), &onlooker);
        let seconds = begun.elapsed().as_secs_f64();
        bar.finish_and_clear();
        let raster = rendered.map_err(|error| Failure::scene(format!("{name}: {error}")))?;
        let (path, format) = target;
        let written = write(&raster, &path, format, self.transfer);
        written.map_err(|e| Failure::scene(format!("{}: {e}", path.display())))?;
        if self.digest {
            writeln!(out, "{}", digest(&raster, self.transfer))?;
        }
        if self.stats {
            writeln!(out, "{}", stats(&name, &order, &raster, seconds))?;
        }
        out.flush()?;
        Ok(())
    }

    /// The file that the picture goes to.
    fn target(&self, source: &Source) -> Result<(PathBuf, Format), Failure> {
        let path = self.output.clone().unwrap_or_else(|| source.picture());
        let unknown =
            || Failure::usage(format!("{}: must end in .png, .ppm or .pfm", path.display()));
        let format = Format::of(&path).ok_or_else(unknown)?;
        // Better now than after an hour.
        let folder = path.parent().filter(|folder| *folder != Path::new(""));
        if folder.is_some_and(|folder| !folder.is_dir()) {
            return Err(Failure::scene(format!("{}: its folder does not exist", path.display())));
        }
        Ok((path, format))
    }

    fn order<S: Scalar>(&self, size: Option<(u32, u32)>) -> Result<Order<S>, Failure> {
        let (width, height) = self.size.or(size).unwrap_or((640, 480));
        let rows = self.rows.clone().unwrap_or(0..height);
        if rows.end > height {
            let Range { start, end } = rows;
            let message = format!("--rows {start}..{end}: the picture has {height} rows");
            return Err(Failure::usage(message));
        }
        if u64::from(width) * rows.len() as u64 > PIXELS_MAX {
            let message =
                format!("more than {PIXELS_MAX} pixels at a time; take some of them with --rows");
            return Err(Failure::usage(message));
        }
        let all = || std::thread::available_parallelism().map_or(1, usize::from);
        Ok(Order {
            width,
            height,
            rows,
            depth: Depth {
                depth_max: self.depth_max as u16,
                weight_min: S::from_f64(self.weight_min),
                error_max: S::from_f64(self.error_max),
            },
            threads: self.threads.unwrap_or_else(all),
            counted: self.stats,
        })
    }
}

/// A bar on a terminal, nothing elsewhere.
fn progress(rows: usize) -> ProgressBar {
    if !io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::with_draw_target(Some(rows as u64), ProgressDrawTarget::stderr());
    match ProgressStyle::with_template("{bar:40} {pos}/{len} rows, {eta} left") {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

fn stats<S: Scalar>(name: &str, order: &Order<S>, raster: &Raster<S>, seconds: f64) -> String {
    let mut object = serde_json::Map::new();
    object.insert("scene".to_owned(), name.into());
    object.insert("scalar".to_owned(), S::NAME.into());
    object.insert("width".to_owned(), order.width.into());
    object.insert("height".to_owned(), order.height.into());
    object.insert("pixels".to_owned(), raster.pixels.len().into());
    object.insert("threads".to_owned(), order.threads.into());
    object.insert("seconds".to_owned(), seconds.into());
    object.insert("spent_max".to_owned(), raster.spent.to_f64().into());
    for event in Event::ALL {
        object.insert(event.name().to_owned(), raster.stats.of(event).into());
    }
    serde_json::Value::Object(object).to_string()
}

fn size(text: &str) -> Result<(u32, u32), String> {
    let (width, height) = text.split_once('x').ok_or("not of the form WxH")?;
    let side = |text: &str| match text.parse::<u32>() {
        Ok(side) if (1..=1 << 24).contains(&side) => Ok(side),
        _ => Err("a side must be a whole number from 1 to 16777216"),
    };
    Ok((side(width)?, side(height)?))
}

fn rows(text: &str) -> Result<Range<u32>, String> {
    let (first, end) = text.split_once("..").ok_or("not of the form A..B")?;
    let row = |text: &str| text.parse::<u32>().map_err(|_| "not of the form A..B");
    let (first, end) = (row(first)?, row(end)?);
    if first < end { Ok(first..end) } else { Err("holds no row".to_owned()) }
}

fn transfer(text: &str) -> Result<Transfer, String> {
    match text {
        "srgb" => Ok(Transfer::Srgb),
        "linear" => Ok(Transfer::Linear),
        _ => Err("is not srgb or linear".to_owned()),
    }
}

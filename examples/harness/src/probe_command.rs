//! The command that answers questions about intersections, one JSON object a line.

use std::ffi::OsString;
use std::io::{BufRead, Write};

use clap::Parser;
use nostray::glam::DVec3;
use nostray::{
    Affine, Boundary, Material, Passage, Q16, Q32, Ray, Real, Rgb, Scalar, SceneBuilder, Spans,
    Vector,
};
use serde::Deserialize;

use crate::assemble::{Assembly, vector};
use crate::document::Solid;
use crate::failure::{Failure, parse, report};
use crate::flaw::Path;
use crate::read::one_line;
use crate::solids::Planter;
use crate::written::Triple;

/// Reads {"solid": …, "ray": {"origin": [x, y, z], "dir": [x, y, z]}} line by line, the solid
/// as in scene files, and answers each with {"spans": [[enter, exit], …]} along t > 0 or with
/// {"error": "…"}.
///
/// t is in units of dir, which may have any length but 0. enter is 0 where the origin is inside;
/// exit is null at infinity; an open surface gives enter = exit.
#[derive(Clone, Debug, Parser)]
#[command(name = "probe", disable_version_flag = true)]
struct Options {
    /// The number format: f32, f64, or in fixed point q16 (Q16.16), q32 (Q32.32)
    #[arg(long, value_name = "S", default_value = "f32")]
    scalar: String,
}

/// A line of input.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Question {
    solid: Solid,
    ray: Beam,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Beam {
    origin: Triple,
    dir: Triple,
}

/// Runs the command with its arguments, the first of them the program's name, until the input
/// ends, and gives its exit code: 0, 1 if the input or output fails, 2 for bad usage.
/// Questions that cannot be answered are told on `out`, other failures in one line on `err`.
pub fn probe_command(
    args: impl IntoIterator<Item = OsString>,
    input: &mut dyn BufRead,
    out: &mut dyn Write,
    err: &mut dyn Write,
) -> u8 {
    report(run(args.into_iter().collect(), input, out), err)
}

fn run(args: Vec<OsString>, input: &mut dyn BufRead, out: &mut dyn Write) -> Result<(), Failure> {
    let Some(options) = parse::<Options>(args, out)? else {
        return Ok(());
    };
    let answer = match options.scalar.as_str() {
        "f32" => answer::<f32>,
        "f64" => answer::<f64>,
        "q16" => answer::<Q16>,
        "q32" => answer::<Q32>,
        other => {
            return Err(Failure::usage(format!("--scalar {other}: is not f32, f64, q16 or q32")));
        }
    };
    let mut line = Vec::new();
    loop {
        line.clear();
        let read = input.read_until(b'\n', &mut line);
        if read.map_err(|error| Failure::scene(format!("cannot read the input: {error}")))? == 0 {
            return Ok(());
        }
        match answer(&line) {
            Ok(spans) => writeln!(out, "{{\"spans\": [{spans}]}}")?,
            Err(message) => writeln!(out, "{}", serde_json::json!({ "error": message }))?,
        }
        out.flush()?;
    }
}

/// The spans that answer a line, as JSON without the outer brackets, or why there are none.
fn answer<S: Scalar>(line: &[u8]) -> Result<String, String> {
    let question = question(line)?;
    let (ray, scale) = scaled_ray::<S>(&question.ray)?;
    let mut builder = SceneBuilder::new();
    builder.material(Material::matte(Rgb::WHITE)).map_err(|error| error.to_string())?;
    let mut planter = Planter::new(&mut builder, None);
    let path = Path::Root;
    planter
        .plant(&question.solid, &Affine::identity(), Some(0), &path.field("solid"))
        .map_err(|flaw| flaw.to_string())?;
    let assembly = Assembly::of_builder(builder);
    let scene = assembly.scene().map_err(|flaw| flaw.to_string())?;
    let vacant =
        Boundary { t: S::ZERO, node: 0, face: 0, passage: Passage::Touch, inverted: false };
    let room = scene.room(0).map_err(|error| error.to_string())?;
    let mut buffer = vec![vacant; room as usize];
    let spans = scene.spans(0, ray, &mut buffer).map_err(|error| error.to_string())?;
    listed(&spans, scale)
}

fn question(line: &[u8]) -> Result<Question, String> {
    let mut from = serde_json::Deserializer::from_slice(line.trim_ascii_end());
    let question: Question = serde_path_to_error::deserialize(&mut from)
        .map_err(|error| one_line(&error.to_string()))?;
    from.end().map_err(|error| one_line(&error.to_string()))?;
    Ok(question)
}

/// What brings t from a ray of moderate direction back to the one asked about: two powers of
/// two, and the length of which the ray is one.
#[derive(Clone, Copy)]
struct Scale {
    halves: [f64; 2],
    length: f64,
}

/// The ray with its direction brought to a magnitude near 1 by a power of two, which changes
/// no digit of it and keeps its square in range.
fn scaled_ray<S: Scalar>(beam: &Beam) -> Result<(Ray<S>, Scale), String> {
    let (origin, dir) = (vector::<S>(beam.origin), vector::<S>(beam.dir));
    if !origin.is_finite() || origin.max_abs() > S::COORD_MAX {
        return Err("ray.origin: is beyond the range of this number format".to_owned());
    }
    if !dir.is_finite() {
        return Err("ray.dir: is beyond the range of this number format".to_owned());
    }
    if dir == S::Vec3::ZERO {
        return Err("ray.dir: must not be zero".to_owned());
    }
    let wide = DVec3::from_array(dir.to_array().map(S::to_f64));
    // Two halves of one power: the whole may be beyond what f64 holds.
    let power = exponent(Vector::max_abs(wide));
    let halves = [power_of_two(-(power / 2)), power_of_two(-(power - power / 2))];
    let near = wide * halves[0] * halves[1];
    let near = S::WideVec::from_array(near.to_array().map(S::Wide::from_f64));
    let (dir, length) = S::steer(near);
    Ok((Ray { origin, dir }, Scale { halves, length: length.to_f64() }))
}

/// ⌊log₂ x⌋ of a positive number.
fn exponent(x: f64) -> i32 {
    let biased = (x.to_bits() >> 52) as i32;
    if biased > 0 { biased - 1023 } else { 63 - x.to_bits().leading_zeros() as i32 - 1074 }
}

/// 2ⁿ for −1022 ≤ n ≤ 1023.
fn power_of_two(n: i32) -> f64 {
    f64::from_bits(((n + 1023) as u64) << 52)
}

/// The spans as JSON, with the shortest numbers that read back as the same.
fn listed<S: Scalar>(spans: &Spans<'_, S>, scale: Scale) -> Result<String, String> {
    let number = |t: S| {
        let [a, b] = scale.halves;
        let t = S::from_f64(t.to_f64() / scale.length * a * b);
        if t.is_finite() {
            Ok(format!("{t:?}"))
        } else {
            Err("t is beyond the range of this number format")
        }
    };
    let mut list = Vec::new();
    let mut enter = spans.inside.then_some(S::ZERO);
    for boundary in spans.boundaries {
        match (boundary.passage, enter) {
            (Passage::Enter, _) => enter = Some(boundary.t),
            (Passage::Leave, Some(from)) => {
                list.push(format!("[{}, {}]", number(from)?, number(boundary.t)?));
                enter = None;
            }
            (Passage::Leave, None) => return Err("an exit without an entry".to_owned()),
            (Passage::Touch, _) => {
                let t = number(boundary.t)?;
                list.push(format!("[{t}, {t}]"));
            }
        }
    }
    if let Some(from) = enter {
        list.push(format!("[{}, null]", number(from)?));
    }
    Ok(list.join(", "))
}

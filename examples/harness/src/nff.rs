//! Scenes in Eric Haines' Neutral File Format, as the Standard Procedural Databases write them.
//!
//! | entity | meaning |
//! | --- | --- |
//! | `v` | the view: `from`, `at`, `up`, `angle`, `hither`, `resolution`, in any order |
//! | `b` R G B | the background |
//! | `l` X Y Z \[R G B\] | a point light that does not weaken with the distance |
//! | `f` R G B Kd Ks Shine T ior | the surface of all that follows |
//! | `s` X Y Z radius | a sphere |
//! | `c` X Y Z radius X Y Z radius | a cylinder, cone or frustum from base to apex |
//! | `p` n, then n × X Y Z | a polygon, convex or concave |
//! | `pp` n, then n × X Y Z NX NY NZ | a polygon with the normals that light sees |
//! | `#` | a comment, to the end of the line |
//!
//! Words may be spread over lines in any way, in lower or upper case.
//!
//! # What it means here
//! - `angle` is the full vertical angle, here from edge to edge of the picture (the format says
//!   from the middle of the first row to that of the last), and `resolution` only a proposal for
//!   the size. `hither` and `yon` cut nothing. Where `up` points along the line of sight, the z
//!   axis is up instead, or the y axis where the view is mostly along z.
//! - A light without a colour is white, of intensity 1/√n among n lights. No other light is there.
//! - Ks is the strength of the highlights and the weight of the mirrored ray, T that of the
//!   refracted one. The index of refraction says nothing where T is 0 and may be 0 there. A
//!   Shine beyond the number format is its greatest number.
//! - A cylinder or cone is a solid with caps, where the format has a surface open at both ends.
//! - A negative radius, which shows only the inside in the format, is its magnitude: every
//!   surface is seen from both sides.
//! - A polygon that is not flat enough for one plane, and every `pp`, becomes triangles, each an
//!   object of its own. A `pp` with a normal of no length is drawn flat.
//! - Polygons without an area, and cylinders and cones without a length, are left out and
//!   counted; so are those whose area or length the number format cannot tell from 0.

mod look;
mod shapes;
mod words;

#[cfg(test)]
mod tests;

use std::collections::HashMap;
use std::error::Error;
use std::fmt;

use nostray::{Attenuation, Background, Light, Rgb, Scalar, SceneBuilder, Vector};

use crate::Heap;
use words::Words;

/// A scene that was read, and what was not taken as it stood.
#[derive(Clone, Debug)]
pub struct NffScene<S: Scalar> {
    /// The scene, ready to be changed or checked.
    pub builder: SceneBuilder<S, Heap>,
    /// The width and height in pixels that the file asks for.
    pub size: Option<(u32, u32)>,
    /// Polygons without an area, cylinders and cones without a length: none of them can be
    /// seen, and none is in the scene.
    pub skipped: usize,
    /// Polygons with normals of which one has no length: they are in the scene, but look flat.
    pub flattened: usize,
}

/// What is wrong with a file, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NffError {
    /// The line, counted from 1.
    pub line: usize,
    /// What is wrong.
    pub message: String,
}

impl fmt::Display for NffError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.message)
    }
}

impl Error for NffError {}

impl NffError {
    fn new(line: usize, message: impl Into<String>) -> Self {
        Self { line, message: message.into() }
    }
}

/// The scene of a file's text.
///
/// # Errors
/// The first word that is not what must stand there, the first number that is not finite or
/// not in the range of its meaning or of the number format, an unknown entity, an entity that is
/// cut short, an object before the first `f`, a radius of 0, or a file without a view.
pub fn load<S: Scalar>(text: &str) -> Result<NffScene<S>, NffError> {
    let mut reader = Reader::<S>::new(text);
    while let Some(word) = reader.words.take() {
        reader.entity(word.text, word.line)?;
    }
    reader.finish()
}

/// A light whose intensity may depend on how many there are.
struct Lamp<S: Scalar> {
    at: S::Vec3,
    color: Option<Rgb<S>>,
}

struct Reader<'a, S: Scalar> {
    words: Words<'a>,
    scene: NffScene<S>,
    has_view: bool,
    lamps: Vec<Lamp<S>>,
    /// The last `f`.
    material: Option<u16>,
    /// The materials so far, by the bits of their eight numbers.
    known: HashMap<[u64; 8], u16>,
}

impl<'a, S: Scalar> Reader<'a, S> {
    fn new(text: &'a str) -> Self {
        let builder = SceneBuilder::new();
        Self {
            words: Words::new(text),
            scene: NffScene { builder, size: None, skipped: 0, flattened: 0 },
            has_view: false,
            lamps: Vec::new(),
            material: None,
            known: HashMap::new(),
        }
    }

    fn entity(&mut self, name: &str, line: usize) -> Result<(), NffError> {
        match name.to_ascii_lowercase().as_str() {
            "v" => self.view(line),
            "b" => {
                self.scene.builder.background = Background::Constant(self.color("b")?);
                Ok(())
            }
            "l" => self.light(),
            "f" => self.fill(line),
            "s" => self.sphere(line),
            "c" => self.cone(line),
            "p" => self.polygon(line),
            "pp" => self.patch(line),
            _ if words::is_number(name) => {
                Err(NffError::new(line, format!("expected an entity, found the number `{name}`")))
            }
            _ => Err(NffError::new(line, format!("unknown entity `{name}`"))),
        }
    }

    fn finish(mut self) -> Result<NffScene<S>, NffError> {
        let line = self.words.line();
        if !self.has_view {
            return Err(NffError::new(line, "the file ends without a view `v`"));
        }
        let refused = |_| NffError::new(line, "there are too many lights");
        let count = i32::try_from(self.lamps.len()).map_err(refused)?;
        let share = S::ONE / S::from_i32(count.max(1)).sqrt();
        for Lamp { at, color } in self.lamps {
            let color = color.unwrap_or(Rgb::WHITE * share);
            let light = Light::Point { at, color, attenuation: Attenuation::NONE };
            let added = self.scene.builder.light(light);
            added.map_err(|error| NffError::new(line, error.to_string()))?;
        }
        Ok(self.scene)
    }

    /// An error in the word that was read last.
    fn refuse(&self, message: impl Into<String>) -> NffError {
        NffError::new(self.words.line(), message)
    }

    /// A coordinate or length that the number format can hold.
    fn scalar(&mut self, of: &str) -> Result<S, NffError> {
        let number = self.words.number(of)?;
        if (-S::COORD_MAX.to_f64()..=S::COORD_MAX.to_f64()).contains(&number) {
            return Ok(S::from_f64(number));
        }
        Err(self.refuse(format!("{of}: {number} is beyond the range of {}", S::NAME)))
    }

    fn point(&mut self, of: &str) -> Result<S::Vec3, NffError> {
        Ok(S::Vec3::new(self.scalar(of)?, self.scalar(of)?, self.scalar(of)?))
    }

    /// A weight or a part of a colour.
    fn amount(&mut self, of: &str) -> Result<S, NffError> {
        let number = self.words.number(of)?;
        if (0.0..=10_000.0).contains(&number) {
            return Ok(S::from_f64(number));
        }
        Err(self.refuse(format!("{of}: {number} is not between 0 and 10000")))
    }

    fn color(&mut self, of: &str) -> Result<Rgb<S>, NffError> {
        Ok(Rgb::new(self.amount(of)?, self.amount(of)?, self.amount(of)?))
    }
}

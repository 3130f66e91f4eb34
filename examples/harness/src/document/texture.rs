//! The textures of a scene file.

use std::fmt;

use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{
    DeserializeSeed, Deserializer, EnumAccess, Error, MapAccess, SeqAccess, VariantAccess, Visitor,
};

use super::Move;
use crate::written::{Factor, Many, Paint, present};

/// The names of the patterns.
pub const PATTERNS: &[&str] = &[
    "Checker",
    "Stripes",
    "Brick",
    "Hexagons",
    "Gradient",
    "Radial",
    "Onion",
    "Wood",
    "Marble",
    "Granite",
    "Agate",
    "Leopard",
    "Spots",
    "Cells",
    "Crackle",
    "Noise",
    "Fbm",
    "Turbulence",
    "Waves",
    "Ripples",
    "Dents",
    "Wrinkles",
    "Image",
];

/// A pattern by its name, and how it is drawn: `Name(field: …)`.
#[derive(Clone, Debug)]
pub struct Texture {
    /// One of [`PATTERNS`].
    pub pattern: &'static str,
    /// How it is drawn.
    pub drawn: Drawn,
}

/// How a pattern is drawn. What is left out is as the pattern has it by default.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Drawn {
    /// Its paints, at equal distances.
    #[serde(deserialize_with = "present")]
    pub colors: Option<Many<Paint>>,
    /// Its paints and the levels where they stand, in ascending order, instead of `colors`.
    #[serde(deserialize_with = "present")]
    pub stops: Option<Many<Stop>>,
    /// What lies between two paints.
    pub blend: Blend,
    /// The edge of a cell, or its edges along x, y and z.
    #[serde(deserialize_with = "present")]
    pub size: Option<Factor>,
    /// How points become the coordinates that it is drawn in.
    pub mapping: Mapping,
    /// Whose points.
    pub space: Space,
    /// From the coordinates that the mapping begins with to the scene's, or to the shape's.
    pub place: Vec<Move>,
    /// From the coordinates of the pattern to those that the mapping ends with.
    pub frame: Vec<Move>,
    /// What becomes of the first two coordinates beyond 0 and 1.
    pub wrap: Wrap,
    /// What becomes of the second, if not the same.
    #[serde(deserialize_with = "present")]
    pub wrap_v: Option<Wrap>,
    /// How far noise moves points, in cells.
    pub warp: f64,
    /// How many octaves its noise has, or how many waves there are.
    #[serde(deserialize_with = "present")]
    pub octaves: Option<u8>,
    /// The strength of each octave over that of the one before; ½ if left out.
    #[serde(deserialize_with = "present")]
    pub gain: Option<f64>,
    /// Which of all noise it is.
    pub seed: u32,
    /// The width of the joints of bricks.
    #[serde(deserialize_with = "present")]
    pub mortar: Option<f64>,
    /// The width of the gaps between hexagons.
    #[serde(deserialize_with = "present")]
    pub gap: Option<f64>,
    /// How far noise moves the rings of wood.
    #[serde(deserialize_with = "present")]
    pub wobble: Option<f64>,
    /// How far turbulence moves the veins of marble and the bands of agate.
    #[serde(deserialize_with = "present")]
    pub strength: Option<f64>,
    /// The radius of spots.
    #[serde(deserialize_with = "present")]
    pub radius: Option<f64>,
    /// The file of an image, PNG or JPEG, from the folder of the scene file.
    #[serde(deserialize_with = "present")]
    pub file: Option<String>,
    /// An image that is made instead.
    #[serde(deserialize_with = "present")]
    pub made: Option<Made>,
    /// How the pixels of an image are kept.
    pub format: Format,
    /// What lies between the pixels of an image.
    pub filter: Filter,
    /// How the numbers of an image stand for light.
    pub transfer: Transfer,
}

impl Drawn {
    /// The fields that only some patterns have, and whether each is there.
    pub(crate) fn own_fields(&self) -> [(&'static str, bool); 11] {
        [
            ("mortar", self.mortar.is_some()),
            ("gap", self.gap.is_some()),
            ("wobble", self.wobble.is_some()),
            ("strength", self.strength.is_some()),
            ("radius", self.radius.is_some()),
            ("file", self.file.is_some()),
            ("made", self.made.is_some()),
            ("colors", self.colors.is_some()),
            ("stops", self.stops.is_some()),
            ("octaves", self.octaves.is_some()),
            ("gain", self.gain.is_some()),
        ]
    }

    /// The paints that it names.
    pub(crate) fn paints(&self) -> impl Iterator<Item = &Paint> {
        let stops = self.stops.iter().flat_map(|stops| &stops.0).map(|stop| &stop.1);
        self.colors.iter().flat_map(|colors| &colors.0).chain(stops)
    }
}

/// A paint of a ramp and where it stands: `(at, paint)`.
#[derive(Clone, Debug)]
pub struct Stop(
    /// The level, 0 to 1.
    pub f64,
    /// The paint.
    pub Paint,
);

impl<'de> Deserialize<'de> for Stop {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Reader;
        impl<'de> Visitor<'de> for Reader {
            type Value = Stop;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a level and a paint, as (0.5, (r, g, b))")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Stop, A::Error> {
                let missing = |index| A::Error::invalid_length(index, &"a level and a paint");
                let at = list.next_element()?.ok_or_else(|| missing(0))?;
                let paint = list.next_element()?.ok_or_else(|| missing(1))?;
                match list.next_element::<serde::de::IgnoredAny>()? {
                    None => Ok(Stop(at, paint)),
                    Some(_) => Err(A::Error::custom("more than a level and a paint")),
                }
            }
        }
        from.deserialize_any(Reader)
    }
}

/// What lies between two paints of a ramp.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
pub enum Blend {
    /// A mixture.
    #[default]
    Linear,
    /// A mixture without a bend at the stops.
    Smooth,
    /// The lower of the two.
    Step,
}

/// Which coordinates a pattern is drawn in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Mapping {
    /// The three of space.
    #[default]
    Solid,
    /// The surface's own two.
    Uv,
    /// x and y.
    Planar,
    /// Longitude and latitude.
    Spherical,
    /// The angle about the y axis, and y.
    Cylindrical,
    /// The faces of a box.
    Cubic,
    /// The two angles of a ring about the y axis.
    Toroidal {
        /// The radius of the circle that the tube is around.
        major: f64,
    },
}

/// Whose coordinates a mapping begins with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
pub enum Space {
    /// The scene's.
    #[default]
    Scene,
    /// The shape's own.
    Shape,
}

/// What becomes of coordinates beyond 0 and 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
pub enum Wrap {
    /// Nothing; an image repeats.
    #[default]
    Endless,
    /// They begin anew.
    Repeat,
    /// They go back and forth.
    Mirror,
    /// They stay at the ends.
    Clamp,
}

/// An image that is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Made {
    /// The map of a world that is not there: seas, land and ice, twice as wide as high.
    Globe {
        /// How many pixels wide; even, 2 to 4096.
        width: u16,
    },
}

/// How the pixels of an image are kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
pub enum Format {
    /// Three bytes each.
    #[default]
    Rgb8,
    /// One byte each.
    Grey8,
    /// Two bytes each.
    Rgb565,
    /// One bit each.
    Mono1,
}

/// What lies between the pixels of an image.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
pub enum Filter {
    /// The colour of the nearest.
    Nearest,
    /// A mixture of the four around.
    #[default]
    Bilinear,
}

/// How the numbers of an image stand for light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
pub enum Transfer {
    /// By the curve of sRGB.
    #[default]
    Srgb,
    /// In proportion.
    Linear,
}

impl<'de> Deserialize<'de> for Texture {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_enum("Texture", PATTERNS, Variant)
    }
}

/// A name with its fields.
struct Variant;

impl<'de> Visitor<'de> for Variant {
    type Value = Texture;
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a pattern, as Checker(…)")
    }
    fn visit_enum<A: EnumAccess<'de>>(self, from: A) -> Result<Texture, A::Error> {
        let (pattern, fields) = from.variant_seed(Name)?;
        let drawn = fields.struct_variant(&[], Fields)?;
        Ok(Texture { pattern, drawn })
    }
}

/// The name of a pattern.
struct Name;

impl<'de> DeserializeSeed<'de> for Name {
    type Value = &'static str;
    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<&'static str, D::Error> {
        from.deserialize_identifier(self)
    }
}

impl Visitor<'_> for Name {
    type Value = &'static str;
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the name of a pattern")
    }
    fn visit_str<E: Error>(self, name: &str) -> Result<&'static str, E> {
        let known = PATTERNS.iter().find(|pattern| **pattern == name);
        known.copied().ok_or_else(|| E::unknown_variant(name, PATTERNS))
    }
}

struct Fields;

impl<'de> Visitor<'de> for Fields {
    type Value = Drawn;
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the fields of a pattern")
    }
    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Drawn, A::Error> {
        Drawn::deserialize(MapAccessDeserializer::new(map))
    }
}

//! From the textures of a document to those of the core.

use nostray::texture::STOPS_MAX;
use nostray::texture::noise::OCTAVES_MAX;
use nostray::{Octaves, Pattern, Rgb, Scalar, texture};

use crate::document::{Blend, Drawn, Filter, Mapping, Space, Texture, Wrap};
use crate::flaw::{Flaw, Path};
use crate::written::Factor;

/// What a pattern is drawn with where a file says nothing.
pub(crate) struct Habit {
    /// The fields that only it and a few others have.
    pub(crate) fields: &'static [&'static str],
    /// The levels and colours of its ramp; none for grey.
    pub(crate) stops: &'static [(f64, [f64; 3])],
    size: [f64; 3],
    octaves: u8,
}

const GREY: &[(f64, [f64; 3])] = &[];
const TILES: &[(f64, [f64; 3])] = &[(0.0, [0.85, 0.83, 0.78]), (1.0, [0.12, 0.13, 0.15])];

impl Habit {
    const fn new(fields: &'static [&'static str], stops: &'static [(f64, [f64; 3])]) -> Self {
        Self { fields, stops, size: [1.0; 3], octaves: 1 }
    }

    const fn grained(
        fields: &'static [&'static str],
        stops: &'static [(f64, [f64; 3])],
        octaves: u8,
    ) -> Self {
        Self { fields, stops, size: [1.0; 3], octaves }
    }

    /// The habit of a pattern.
    pub(crate) fn of(pattern: &str) -> Self {
        match pattern {
            "Stripes" => Self::new(&[], &[(0.0, [0.8, 0.12, 0.08]), (1.0, [0.88, 0.86, 0.8])]),
            "Brick" => Self { size: [1.0, 0.36, 0.5], ..Self::new(&["mortar"], BRICKS) },
            "Hexagons" => Self::new(&["gap"], HEXAGONS),
            "Wood" => Self::grained(&["wobble"], WOOD, 3),
            "Marble" => Self::grained(&["strength"], MARBLE, 6),
            "Granite" => Self::grained(&[], GRANITE, 7),
            "Agate" => Self::grained(&["strength"], AGATE, 5),
            "Leopard" => Self::new(&[], LEOPARD),
            "Spots" => Self::new(&["radius"], SPOTS),
            "Cells" => Self::new(&[], CELLS),
            "Crackle" => Self::new(&[], CRACKLE),
            "Onion" => Self::new(&[], &[(0.0, [0.92, 0.87, 0.8]), (1.0, [0.45, 0.1, 0.25])]),
            "Fbm" | "Turbulence" => Self::grained(&[], GREY, 6),
            "Waves" => Self::grained(&[], GREY, 10),
            "Wrinkles" => Self::grained(&[], GREY, 4),
            "Image" => Self::new(&["file", "made"], GREY),
            "Gradient" | "Radial" | "Noise" | "Ripples" | "Dents" => Self::new(&[], GREY),
            _ => Self::new(&[], TILES),
        }
    }

    /// A field of this name may be written for the pattern.
    fn has(&self, pattern: &str, field: &str) -> bool {
        match field {
            "colors" | "stops" => pattern != "Image",
            "octaves" | "gain" => true,
            own => self.fields.contains(&own),
        }
    }
}

/// Three sorts of bricks and the mortar.
const BRICKS: &[(f64, [f64; 3])] = &[
    (0.0, [0.36, 0.11, 0.07]),
    (0.3, [0.45, 0.15, 0.09]),
    (0.6, [0.29, 0.085, 0.06]),
    (1.0, [0.52, 0.50, 0.46]),
];

/// Three sorts of hexagons and the gap.
const HEXAGONS: &[(f64, [f64; 3])] = &[
    (0.0, [0.78, 0.72, 0.60]),
    (0.3, [0.55, 0.24, 0.14]),
    (0.6, [0.12, 0.22, 0.30]),
    (1.0, [0.08, 0.08, 0.08]),
];

const WOOD: &[(f64, [f64; 3])] = &[
    (0.0, [0.53, 0.31, 0.14]),
    (0.55, [0.45, 0.24, 0.10]),
    (0.85, [0.27, 0.12, 0.045]),
    (1.0, [0.36, 0.18, 0.07]),
];

const MARBLE: &[(f64, [f64; 3])] = &[
    (0.0, [0.86, 0.85, 0.82]),
    (0.55, [0.80, 0.79, 0.77]),
    (0.85, [0.55, 0.55, 0.57]),
    (1.0, [0.16, 0.17, 0.20]),
];

const GRANITE: &[(f64, [f64; 3])] = &[
    (0.0, [0.04, 0.04, 0.045]),
    (0.25, [0.16, 0.15, 0.15]),
    (0.45, [0.50, 0.33, 0.28]),
    (0.65, [0.62, 0.50, 0.45]),
    (1.0, [0.85, 0.83, 0.80]),
];

const AGATE: &[(f64, [f64; 3])] = &[
    (0.0, [0.28, 0.07, 0.03]),
    (0.35, [0.62, 0.25, 0.08]),
    (0.6, [0.85, 0.62, 0.38]),
    (0.8, [0.92, 0.86, 0.75]),
    (1.0, [0.45, 0.16, 0.06]),
];

const LEOPARD: &[(f64, [f64; 3])] =
    &[(0.0, [0.72, 0.46, 0.16]), (0.25, [0.62, 0.36, 0.11]), (0.4, [0.07, 0.035, 0.015])];

const SPOTS: &[(f64, [f64; 3])] =
    &[(0.0, [0.1, 0.03, 0.02]), (0.75, [0.16, 0.05, 0.03]), (1.0, [0.85, 0.65, 0.35])];

const CELLS: &[(f64, [f64; 3])] = &[
    (0.0, [0.10, 0.30, 0.42]),
    (0.25, [0.70, 0.52, 0.16]),
    (0.5, [0.58, 0.15, 0.10]),
    (0.75, [0.82, 0.78, 0.68]),
    (1.0, [0.20, 0.36, 0.16]),
];

const CRACKLE: &[(f64, [f64; 3])] = &[
    (0.0, [0.03, 0.025, 0.02]),
    (0.06, [0.10, 0.08, 0.07]),
    (0.14, [0.46, 0.40, 0.33]),
    (1.0, [0.60, 0.54, 0.46]),
];

/// A number that a file may leave out.
fn number(written: Option<f64>, otherwise: f64) -> f64 {
    written.unwrap_or(otherwise)
}

/// The pattern of a texture; an image has its index already.
fn pattern<S: Scalar>(written: &Texture, image: Option<u16>) -> Pattern<S> {
    let drawn = &written.drawn;
    let s = |written, otherwise| S::from_f64(number(written, otherwise));
    match written.pattern {
        "Stripes" => Pattern::Stripes,
        "Brick" => Pattern::Brick { mortar: s(drawn.mortar, 0.1) },
        "Hexagons" => Pattern::Hexagons { gap: s(drawn.gap, 0.08) },
        "Gradient" => Pattern::Gradient,
        "Radial" => Pattern::Radial,
        "Onion" => Pattern::Onion,
        "Wood" => Pattern::Wood { wobble: s(drawn.wobble, 0.7) },
        "Marble" => Pattern::Marble { strength: s(drawn.strength, 3.0) },
        "Granite" => Pattern::Granite,
        "Agate" => Pattern::Agate { strength: s(drawn.strength, 8.0) },
        "Leopard" => Pattern::Leopard,
        "Spots" => Pattern::Spots { radius: s(drawn.radius, 0.4) },
        "Cells" => Pattern::Cells,
        "Crackle" => Pattern::Crackle,
        "Noise" | "Fbm" => Pattern::Noise,
        "Turbulence" => Pattern::Turbulence,
        "Waves" => Pattern::Waves,
        "Ripples" => Pattern::Ripples,
        "Dents" => Pattern::Dents,
        "Wrinkles" => Pattern::Wrinkles,
        "Image" => Pattern::Image {
            image: image.unwrap_or(0),
            filter: match drawn.filter {
                Filter::Nearest => texture::Filter::Nearest,
                Filter::Bilinear => texture::Filter::Bilinear,
            },
        },
        _ => Pattern::Checker,
    }
}

fn wrap(written: Wrap) -> texture::Wrap {
    match written {
        Wrap::Endless => texture::Wrap::Endless,
        Wrap::Repeat => texture::Wrap::Repeat,
        Wrap::Mirror => texture::Wrap::Mirror,
        Wrap::Clamp => texture::Wrap::Clamp,
    }
}

/// A texture without its ramp and its placements.
pub(crate) fn bare<S: Scalar>(written: &Texture, image: Option<u16>) -> texture::Texture<S> {
    let (drawn, habit) = (&written.drawn, Habit::of(written.pattern));
    let Factor(size) = drawn.size.unwrap_or(Factor(habit.size));
    texture::Texture {
        mapping: match drawn.mapping {
            Mapping::Solid => texture::Mapping::Solid,
            Mapping::Uv => texture::Mapping::Uv,
            Mapping::Planar => texture::Mapping::Planar,
            Mapping::Spherical => texture::Mapping::Spherical,
            Mapping::Cylindrical => texture::Mapping::Cylindrical,
            Mapping::Cubic => texture::Mapping::Cubic,
            Mapping::Toroidal { major } => texture::Mapping::Toroidal { major: S::from_f64(major) },
        },
        space: match drawn.space {
            Space::Scene => texture::Space::Scene,
            Space::Shape => texture::Space::Shape,
        },
        size: size.map(S::from_f64),
        wrap: [wrap(drawn.wrap), wrap(drawn.wrap_v.unwrap_or(drawn.wrap))],
        warp: S::from_f64(drawn.warp),
        octaves: Octaves {
            count: drawn.octaves.unwrap_or(habit.octaves),
            gain: S::from_f64(number(drawn.gain, 0.5)),
        },
        seed: drawn.seed,
        ..texture::Texture::new(pattern(written, image), texture::Ramp::GREY)
    }
}

pub(crate) fn blend(drawn: &Drawn) -> texture::Blend {
    match drawn.blend {
        Blend::Linear => texture::Blend::Linear,
        Blend::Smooth => texture::Blend::Smooth,
        Blend::Step => texture::Blend::Step,
    }
}

/// The colour of a default.
pub(crate) fn default_color<S: Scalar>(color: [f64; 3]) -> Rgb<S> {
    let [r, g, b] = color.map(S::from_f64);
    Rgb::new(r, g, b)
}

/// What can be told of a texture before its names are looked up.
pub(crate) fn check(written: &Texture, path: &Path<'_>) -> Result<(), Flaw> {
    let (drawn, habit) = (&written.drawn, Habit::of(written.pattern));
    for (field, there) in drawn.own_fields() {
        if there && !habit.has(written.pattern, field) {
            let message = format!("{} has no such field", written.pattern);
            return Err(Flaw::new(path.field(field), message));
        }
    }
    if drawn.octaves.is_some_and(|count| count == 0 || count > OCTAVES_MAX) {
        let message = format!("must be between 1 and {OCTAVES_MAX}");
        return Err(Flaw::new(path.field("octaves"), message));
    }
    check_ramp(written, path)
}

fn check_ramp(written: &Texture, path: &Path<'_>) -> Result<(), Flaw> {
    let drawn = &written.drawn;
    let (field, count) = match (&drawn.colors, &drawn.stops) {
        (Some(_), Some(_)) => {
            return Err(Flaw::new(path.field("stops"), "cannot stand beside colors"));
        }
        (Some(colors), None) => ("colors", colors.0.len()),
        (None, Some(stops)) => ("stops", stops.0.len()),
        (None, None) => return Ok(()),
    };
    let parts = pattern::<f64>(written, None);
    let least = 1 + usize::from(parts.has_parts()) + usize::from(parts.has_joints());
    let path = path.field(field);
    if count < least {
        return Err(Flaw::new(path, format!("needs at least {least} paints")));
    }
    if count > usize::from(STOPS_MAX) {
        return Err(Flaw::new(path, format!("has more than {STOPS_MAX} paints")));
    }
    let mut before = 0.0;
    for (index, stop) in drawn.stops.iter().flat_map(|stops| &stops.0).enumerate() {
        let path = path.entry(index);
        if !(0.0..=1.0).contains(&stop.0) {
            return Err(Flaw::new(path.entry(0), "must be between 0 and 1"));
        }
        if stop.0 < before {
            return Err(Flaw::new(path.entry(0), "must not be less than the stop before"));
        }
        before = stop.0;
    }
    Ok(())
}

//! The patterns, and what each is made of.

use super::cells::nearest;
use super::noise::{Octaves, Slope, fbm, fbm_slope, turbulence, turbulence_slope};
use super::{Filter, flat, grain};
use crate::color::Rgb;
use crate::scalar::{Scalar, Vector};

/// A pattern. Its cells and bands are 1 wide, unless the texture says another [size](super::Texture::size).
///
/// A pattern of **parts** takes the stops of the ramp in turn; one of **levels** goes from the first stop, at 0,
/// to the last, at 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pattern<S> {
    /// Parts: squares on a surface, cubes in space.
    Checker,
    /// Parts: bands across x.
    Stripes,
    /// Parts: bricks, in rows that are offset by half a brick, each of any stop but the last;
    /// the last is the mortar.
    Brick {
        /// The width of the joints, as a share of the height of a brick; 0 to 1.
        mortar: S,
    },
    /// Parts: hexagons across which it is 1, in three sorts; if there are gaps, the last stop fills them.
    Hexagons {
        /// The width of the gaps; 0 to 1.
        gap: S,
    },
    /// Levels along x.
    Gradient,
    /// Levels from the origin outward.
    Radial,
    /// Levels in shells around the origin, over and over.
    Onion,
    /// Levels in rings around the y axis, over and over.
    Wood {
        /// How far noise moves the rings.
        wobble: S,
    },
    /// Levels in veins across x.
    Marble {
        /// How far turbulence moves the veins.
        strength: S,
    },
    /// Levels in grains of all sizes.
    Granite,
    /// Levels in bands that turbulence bends.
    Agate {
        /// How many bands it makes.
        strength: S,
    },
    /// Levels in a regular grid of spots.
    Leopard,
    /// Levels around points that lie anywhere: 0 in the middle of a spot, 1 outside.
    Spots {
        /// The radius of a spot; greater than 0.
        radius: S,
    },
    /// Parts: what lies nearest to each of such points.
    Cells,
    /// Levels: 0 where two cells meet.
    Crackle,
    /// Levels of a sum of noise around ½.
    Noise,
    /// Levels of turbulence.
    Turbulence,
    /// Levels of plane waves across y, of many directions.
    Waves,
    /// Levels of rings of waves around points; the first is the origin.
    Ripples,
    /// Levels: 1, with dents down to 0.
    Dents,
    /// Levels: 1, with creases down to 0.
    Wrinkles,
    /// The colours of an image.
    Image {
        /// Its index.
        image: u16,
        /// What lies between its pixels.
        filter: Filter,
    },
}

/// What a pattern is at a place.
pub(super) enum Sample<S> {
    /// One of its parts. A number tells parts apart.
    Part(u32),
    /// What lies between the parts.
    Joint,
    /// A level in 0..=1, and a number that changes where levels jump.
    Level(S, u32),
    /// A colour, and a number that changes where colours jump.
    Color(Rgb<S>, u32),
}

/// What patterns are drawn with.
pub(super) struct Stroke<S> {
    /// The edges of a cell.
    pub(super) size: [S; 3],
    /// There are two coordinates.
    pub(super) is_flat: bool,
    pub(super) octaves: Octaves<S>,
    pub(super) seed: u32,
}

/// A number and its whole part.
pub(super) fn split<S: Scalar>(v: S) -> (u32, S) {
    let part = v - v.floor();
    (v.floor_i64() as u32, if part.is_finite() { part } else { S::ZERO })
}

/// The length of a vector, rounded once.
pub(super) fn length<S: Scalar>(v: S::Vec3) -> S {
    S::narrow(S::widen_vec(v).length())
}

/// `n · 2⁻¹⁴`, exactly, for −32768 ≤ n ≤ 32767.
pub(super) fn parts<S: Scalar>(n: i32) -> S {
    S::from_i32(n) * S::HALF.powi(14)
}

/// The sine of an angle in turns, to four digits: a polynomial of degree 7 on a quarter of a turn.
pub(super) fn sine<S: Scalar>(turns: S) -> S {
    let (_, part) = split(turns);
    // In −½..½, and then folded into −¼..=¼.
    let angle = if part < S::HALF { part } else { part - S::ONE };
    let quarter = S::HALF * S::HALF;
    let folded = if angle > quarter {
        S::HALF - angle
    } else if angle < -quarter {
        -S::HALF - angle
    } else {
        angle
    };
    let z = folded * S::from_i32(4);
    let zz = z * z;
    let inner = zz * (zz * (zz * parts(-80) + parts(1314)) - parts(10_585));
    z * (inner + parts(25_735))
}

impl<S: Scalar> Pattern<S> {
    /// It takes the stops of its ramp in turn.
    pub const fn has_parts(&self) -> bool {
        matches!(
            self,
            Self::Checker
                | Self::Stripes
                | Self::Brick { .. }
                | Self::Hexagons { .. }
                | Self::Cells
        )
    }

    /// Its last stop lies between the parts.
    pub fn has_joints(&self) -> bool {
        match self {
            Self::Brick { mortar: width } | Self::Hexagons { gap: width } => *width > S::ZERO,
            _ => false,
        }
    }

    /// What it is at a place of its own coordinates. Images are not drawn here.
    pub(super) fn sample(&self, p: [S; 3], stroke: &Stroke<S>) -> Sample<S> {
        let [x, y, z] = p;
        let point = S::Vec3::from_array(p);
        let level = |v: S| Sample::Level(v.clamp(S::ZERO, S::ONE), 0);
        let around = |v: S| level((v + S::ONE) * S::HALF);
        let over_and_over = |v: S| {
            let (part, level) = split(v);
            Sample::Level(level, part)
        };
        match *self {
            Self::Checker => flat::checker(p),
            Self::Stripes => Sample::Part(split(x).0),
            Self::Brick { mortar } => flat::brick(p, mortar, stroke),
            Self::Hexagons { gap } => flat::hexagons(x, y, gap),
            Self::Gradient => level(x),
            Self::Radial => level(length::<S>(point)),
            Self::Onion => over_and_over(length::<S>(point)),
            Self::Wood { wobble } => over_and_over(grain::wood(p, wobble, stroke)),
            Self::Marble { strength } => around(sine(x + grain::stir(point, strength, stroke))),
            Self::Granite => level(turbulence(point, stroke.seed, &stroke.octaves) * parts(30_000)),
            Self::Agate { strength } => {
                level(grain::agate(z + grain::stir(point, strength, stroke)))
            }
            Self::Leopard => level(grain::leopard(p)),
            Self::Spots { radius } => level(nearest::<S>(point, stroke.seed).first / radius),
            Self::Cells => Sample::Part(nearest::<S>(point, stroke.seed).cell),
            Self::Crackle => {
                let nearest = nearest::<S>(point, stroke.seed);
                level(nearest.second - nearest.first)
            }
            Self::Waves => around(grain::waves(x, z, stroke)),
            Self::Ripples => around(grain::ripples(point, stroke)),
            Self::Noise => around(fbm(point, stroke.seed, &stroke.octaves)),
            Self::Turbulence => level(turbulence(point, stroke.seed, &stroke.octaves)),
            Self::Dents => level(grain::dent(fbm(point, stroke.seed, &stroke.octaves)).0),
            Self::Wrinkles => {
                level(S::ONE - turbulence(point, stroke.seed, &stroke.octaves) * S::TWO)
            }
            Self::Image { .. } => Sample::Joint,
        }
    }

    /// Its level and how fast that changes, where there is a formula for it.
    pub(super) fn slope(&self, p: [S; 3], stroke: &Stroke<S>) -> Option<Slope<S>> {
        let (point, sum) = (S::Vec3::from_array(p), &stroke.octaves);
        let Slope { value, gradient } = match self {
            Self::Noise | Self::Dents => fbm_slope(point, stroke.seed, sum),
            Self::Turbulence | Self::Wrinkles => turbulence_slope(point, stroke.seed, sum),
            _ => return None,
        };
        let (value, factor) = match self {
            Self::Noise => ((value + S::ONE) * S::HALF, S::HALF),
            Self::Dents => grain::dent(value),
            Self::Wrinkles => (S::ONE - value * S::TWO, -S::TWO),
            _ => (value, S::ONE),
        };
        // Beyond the ends of the levels it is flat.
        let inside = value > S::ZERO && value < S::ONE;
        let factor = if inside { factor } else { S::ZERO };
        Some(Slope { value: value.clamp(S::ZERO, S::ONE), gradient: gradient * factor })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sine_is_one_to_four_digits() {
        for n in -4000..4000 {
            let turns = f64::from(n) / 1000.0;
            let exact = libm::sin(turns * core::f64::consts::TAU);
            let found = sine(turns);
            assert!(
                (found - exact).abs() <= 3e-5 && found.abs() <= 1.0,
                "{turns}: {found} {exact}"
            );
        }
        assert_eq!([0.0, 0.25, 0.5, 0.75].map(sine), [0.0, 1.0, 0.0, -1.0]);
        assert_eq!([1e300, f64::INFINITY, f64::NAN].map(sine), [0.0; 3]);
    }
}

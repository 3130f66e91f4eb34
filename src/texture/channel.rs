//! Textures that drive other numbers than colours.

use super::noise::Slope;
use super::{Mapping, Space, Spot, Texture, Textures, Wrap};
use crate::place::Placement;
use crate::scalar::{Real, Scalar, Vector};
use crate::stats::{Event, Tally};

/// A number of a [`Material`](crate::material::Material).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// `ambient`
    Ambient,
    /// `diffuse`
    Diffuse,
    /// `specular`
    Specular,
    /// `shininess`
    Shininess,
    /// `reflect`
    Reflect,
    /// `transmit`
    Transmit,
}

/// What the brightness of a texture does to a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Channel<S> {
    /// It is the share of a number of the material. Several channels of one number are multiplied.
    Share {
        /// Which number.
        of: Parameter,
        /// The texture.
        texture: u16,
        /// The share where it is black; 0 to 1.
        low: S,
        /// The share where it is white; 0 to 1.
        high: S,
    },
    /// It is a height over the surface, and light sees the slopes. Several reliefs add up.
    ///
    /// Source: J. F. Blinn, "Simulation of Wrinkled Surfaces" (1978), with the gradient in space of
    /// K. Perlin, "An Image Synthesizer" (1985).
    Relief {
        /// The texture.
        texture: u16,
        /// How much higher white is than black; negative for hollows.
        depth: S,
        /// Half the distance between the places whose heights are compared. A texture of noise alone, without stops,
        /// warp or mapping, has its slope from a formula instead.
        step: S,
    },
}

impl<S: Scalar> Channel<S> {
    /// The texture.
    pub const fn texture(&self) -> u16 {
        match self {
            Self::Share { texture, .. } | Self::Relief { texture, .. } => *texture,
        }
    }
}

/// A run of channels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Channels {
    /// The index of the first.
    pub first: u16,
    /// How many.
    pub count: u16,
}

impl Channels {
    /// A surface that is the same everywhere.
    pub const NONE: Self = Self { first: 0, count: 0 };

    /// The channels themselves.
    pub(crate) fn of<S: Scalar>(self, channels: &[Channel<S>]) -> &[Channel<S>] {
        let (first, count) = (usize::from(self.first), usize::from(self.count));
        channels.get(first..first + count).unwrap_or(&[])
    }
}

impl<S: Scalar> Texture<S> {
    /// Its height and slope in space, where there is a formula for it.
    fn slope<const NEEDS: u64>(
        &self,
        spot: &Spot<'_, S>,
        placements: &[Placement<S>],
    ) -> Option<S::WideVec> {
        let plain = self.ramp.count == 0
            && self.mapping == Mapping::Solid
            && self.wrap == [Wrap::Endless; 2]
            && self.warp == S::ZERO
            && self.frame.is_none()
            && self.space == Space::Scene;
        if !plain {
            return None;
        }
        let p = self.place::<NEEDS>(spot, placements);
        let Slope { gradient, .. } = self.pattern.slope(p, &self.stroke())?;
        let [wide, high, deep] = self.size.map(S::widen);
        let [x, y, z] = S::widen_vec(gradient).to_array();
        let slope = S::WideVec::new(x / wide, y / high, z / deep);
        let place = self.placement.and_then(|index| placements.get(usize::from(index)));
        Some(place.map_or(slope, |place| place.normal(slope)))
    }
}

/// A surface that is given a relief: a spot of it, and the way from the scene to the shape's own coordinates.
pub(crate) struct Ground<'a, S: Scalar> {
    pub(crate) spot: Spot<'a, S>,
    pub(crate) place: Option<&'a Placement<S>>,
}

impl<'a, S: Scalar> Ground<'a, S> {
    /// The spot moved by a way along the surface.
    fn moved(&self, by: S::WideVec) -> Spot<'a, S> {
        let local = match self.place {
            Some(place) => crate::place::apply::<S>(&place.to_local, by),
            None => by,
        };
        let moved = |p: S::Vec3, by: S::WideVec| S::narrow_vec(S::widen_vec(p) + by);
        Spot {
            position: moved(self.spot.position, by),
            local: moved(self.spot.local, local),
            on: self.spot.on,
        }
    }
}

impl<S: Scalar, const NEEDS: u64> Textures<'_, S, NEEDS> {
    /// The share of a number that channels leave.
    pub(crate) fn share(
        &self,
        channels: &[Channel<S>],
        parameter: Parameter,
        spot: &Spot<'_, S>,
        tally: &mut impl Tally,
    ) -> S {
        let mut share = S::ONE;
        for channel in channels {
            match *channel {
                Channel::Share { of, texture, low, high } if of == parameter => {
                    let level = self.level(texture, spot, tally);
                    share *= low + (high - low) * level;
                }
                _ => {}
            }
        }
        share
    }

    /// The unit normal that light sees where reliefs tilt another.
    #[inline(never)]
    pub(crate) fn tilted(
        &self,
        channels: &[Channel<S>],
        ground: &Ground<'_, S>,
        normal: S::Dir,
        tally: &mut impl Tally,
    ) -> S::Dir {
        let upright = S::widen_dir(normal);
        let mut tilted = upright;
        for channel in channels {
            let Channel::Relief { texture, depth, step } = *channel else {
                continue;
            };
            let formula = self.textures.get(usize::from(texture));
            let formula = formula.and_then(|t| t.slope::<NEEDS>(&ground.spot, self.placements));
            let slope = match formula {
                Some(slope) => {
                    tally.count(Event::Texture);
                    slope - upright * slope.dot(upright)
                }
                None => self.compared(texture, ground, upright, step, tally),
            };
            tilted = tilted - slope * depth.widen();
        }
        S::unit(tilted)
    }

    /// The slope along a surface, by the heights on four sides.
    fn compared(
        &self,
        texture: u16,
        ground: &Ground<'_, S>,
        upright: S::WideVec,
        step: S,
        tally: &mut impl Tally,
    ) -> S::WideVec {
        let (u, v) = upright.basis();
        let mut slope = S::WideVec::ZERO;
        for along in [u, v] {
            let by = along * step.widen();
            let mut level = |by: S::WideVec| self.level(texture, &ground.moved(by), tally);
            let rise = level(by) - level(-by);
            slope += along * (rise.widen() / (step.widen() * S::Wide::TWO));
        }
        slope
    }
}

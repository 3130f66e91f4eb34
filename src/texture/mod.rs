//! Patterns that change a surface from place to place.
//!
//! A parameter that is a colour is a [`Paint`]: one colour, or a texture by index. A [`Texture`] is drawn in
//! coordinates of its own, to which a [`Mapping`] leads; there its [`Pattern`] says which stops of its [`Ramp`]
//! show, each of them a paint and so perhaps a texture again. It may only name textures before itself, and
//! only so deeply, so there are no cycles and the work is bounded.
//!
//! A [`Channel`] leads the brightness of a texture to another number of a material, or to its normals.

mod channel;
mod flat;
mod grain;
mod image;
mod mapping;
mod pattern;
mod ramp;

pub mod cells;
pub mod noise;

pub(crate) use channel::Ground;
pub use channel::{Channel, Channels, Parameter};
pub use image::{Filter, Format, Image};
pub use mapping::{Mapping, Space, Wrap};
pub use pattern::Pattern;
pub use ramp::{Blend, Ramp, STOPS_MAX, Stop};

use crate::color::Rgb;
use crate::needs::{self, has};
use crate::place::Placement;
use crate::scalar::{Scalar, Vector};
use crate::shape::{Shape, Tables};
use crate::stats::{Event, Tally};
use noise::{Octaves, mix};
use pattern::{Sample, Stroke};
use ramp::{Mixture, mixture};

/// How deeply textures may be nested.
pub const NESTING_MAX: usize = 8;

/// A colour, or where to find it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Paint<S: Scalar> {
    /// The same everywhere.
    Solid(Rgb<S>),
    /// The texture with this index.
    Texture(u16),
}

/// Where a texture is evaluated.
#[derive(Clone, Copy, Debug)]
pub struct Spot<'a, S: Scalar> {
    /// The point of the scene.
    pub position: S::Vec3,
    /// The point in the coordinates of the shape that it is a part of.
    pub local: S::Vec3,
    /// The face that it lies on, if it lies on one.
    pub on: Option<Face<'a, S>>,
}

/// A face of a shape.
#[derive(Clone, Copy, Debug)]
pub struct Face<'a, S: Scalar> {
    /// The shape.
    pub shape: &'a Shape<S>,
    /// Which of its faces.
    pub face: u32,
    /// What shapes refer to.
    pub tables: &'a Tables<'a, S>,
}

impl<S: Scalar> Spot<'_, S> {
    /// A point that lies on no shape.
    pub const fn free(position: S::Vec3) -> Self {
        Self { position, local: position, on: None }
    }

    /// The surface's own coordinates; (0, 0) without a surface.
    pub fn uv(&self) -> [S; 2] {
        self.uv_for::<{ needs::ALL }>()
    }

    /// The same on one of the solids that are needed.
    fn uv_for<const NEEDS: u64>(&self) -> [S; 2] {
        if !has(NEEDS, needs::COORDINATES) {
            return [S::ZERO; 2];
        }
        let uv = |on: Face<'_, S>| on.shape.uv_for::<NEEDS>(self.local, on.face, on.tables);
        self.on.map_or([S::ZERO; 2], uv)
    }
}

/// A pattern, and how it is drawn.
///
/// A point goes through the map of the placement, the mapping and the map of the frame; then it is
/// measured in sizes, wrapped, and moved by the warp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Texture<S: Scalar> {
    /// The pattern.
    pub pattern: Pattern<S>,
    /// Its paints.
    pub ramp: Ramp,
    /// How points become coordinates.
    pub mapping: Mapping<S>,
    /// Whose points.
    pub space: Space,
    /// The placement whose local coordinates the mapping begins with.
    pub placement: Option<u16>,
    /// The placement whose local coordinates the mapping ends with: it moves, turns and scales a pattern on its
    /// surface.
    pub frame: Option<u16>,
    /// The edges of a cell of the pattern; greater than 0.
    pub size: [S; 3],
    /// What becomes of the first two coordinates beyond 0 and 1.
    pub wrap: [Wrap; 2],
    /// How far noise moves a point before the pattern is drawn, in cells.
    pub warp: S,
    /// The noise of the pattern and of the warp.
    pub octaves: Octaves<S>,
    /// Which of all noise it is.
    pub seed: u32,
}

impl<S: Scalar> Texture<S> {
    /// A pattern through space, of size 1, with one octave where it has noise.
    pub const fn new(pattern: Pattern<S>, ramp: Ramp) -> Self {
        Self {
            pattern,
            ramp,
            mapping: Mapping::Solid,
            space: Space::Scene,
            placement: None,
            frame: None,
            size: [S::ONE; 3],
            wrap: [Wrap::Endless; 2],
            warp: S::ZERO,
            octaves: Octaves::ONE,
            seed: 0,
        }
    }

    fn stroke(&self) -> Stroke<S> {
        let is_flat = self.mapping.is_flat();
        Stroke { size: self.size, is_flat, octaves: self.octaves, seed: self.seed }
    }

    /// The coordinates of a spot that the pattern is drawn in. Whatever the spot, they are finite and not so
    /// large that their squares are not.
    fn place<const NEEDS: u64>(&self, spot: &Spot<'_, S>, placements: &[Placement<S>]) -> [S; 3] {
        let local = |p: S::Vec3, index: Option<u16>| match index {
            Some(index) => match placements.get(usize::from(index)) {
                Some(placement) => S::narrow_vec(placement.local(p)),
                None => p,
            },
            None => p,
        };
        let from = match self.space {
            Space::Scene => spot.position,
            Space::Shape => spot.local,
        };
        let drawn = self.mapping.coordinates_for::<NEEDS>(local(from, self.placement), spot);
        let [x, y, z] = local(drawn, self.frame).to_array();
        let [wide, high, deep] = self.size;
        let far = S::from_i32(1 << 30) * S::from_i32(1 << 20);
        let [x, y, z] = [(x, wide), (y, high), (z, deep)].map(|(v, size)| {
            let v = v / size;
            if v.is_finite() { v.clamp(-far, far) } else { S::ZERO }
        });
        let [across, up] = self.wrap;
        let p = [across.fold(x), up.fold(y), z];
        if self.warp == S::ZERO { p } else { self.warped(p) }
    }

    /// A place moved by noise.
    #[inline(never)]
    fn warped(&self, p: [S; 3]) -> [S; 3] {
        let point = S::Vec3::from_array(p);
        let mut moved = p;
        for (part, axis) in moved.iter_mut().zip(1..) {
            *part += noise::fbm(point, mix(self.seed ^ axis), &self.octaves) * self.warp;
        }
        moved
    }
}

/// What a paint is at a spot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen<S> {
    /// The colour.
    pub color: Rgb<S>,
    /// A hash of the cells, bands and pixels that the spot lies in. Between two spots of one
    /// paint with the same hash there is no edge of a pattern; what fades changes nothing.
    pub signature: u32,
}

/// The textures of a scene.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Textures<'a, S: Scalar, const NEEDS: u64> {
    pub(crate) textures: &'a [Texture<S>],
    pub(crate) stops: &'a [Stop<S>],
    pub(crate) images: &'a [Image],
    pub(crate) pixels: &'a [u8],
    pub(crate) placements: &'a [Placement<S>],
}

impl<S: Scalar, const NEEDS: u64> Textures<'_, S, NEEDS> {
    /// What a paint is at a spot.
    #[inline]
    pub(crate) fn see(
        &self,
        paint: Paint<S>,
        spot: &Spot<'_, S>,
        tally: &mut impl Tally,
    ) -> Seen<S> {
        match paint {
            Paint::Solid(color) => Seen { color, signature: 0 },
            Paint::Texture(index) if has(NEEDS, needs::TEXTURES) => self.mixed(index, spot, tally),
            Paint::Texture(_) => Seen { color: Rgb::BLACK, signature: 0 },
        }
    }

    /// A texture with all that it is mixed of.
    ///
    /// Each step goes to at most two earlier textures, and textures are nested no deeper than [`NESTING_MAX`],
    /// so there is room for what waits.
    #[inline(never)]
    fn mixed(&self, index: u16, spot: &Spot<'_, S>, tally: &mut impl Tally) -> Seen<S> {
        let mut waiting: heapless::Vec<(u16, S), { NESTING_MAX + 1 }> = heapless::Vec::new();
        let _ = waiting.push((index, S::ONE));
        let mut seen = Seen { color: Rgb::BLACK, signature: 0 };
        while let Some((index, weight)) = waiting.pop() {
            let Some(texture) = self.textures.get(usize::from(index)) else {
                continue;
            };
            tally.count(Event::Texture);
            let Mixture { paints, side } = self.sample(texture, spot);
            seen.signature = mix(seen.signature.wrapping_add(u32::from(index)) ^ mix(side));
            for (paint, share) in paints {
                let weight = weight * share;
                if !(weight > S::ZERO) {
                    continue;
                }
                match paint {
                    Paint::Solid(color) => seen.color += color * weight,
                    Paint::Texture(index) => {
                        let pushed = waiting.push((index, weight));
                        debug_assert!(pushed.is_ok(), "textures are nested too deeply");
                    }
                }
            }
        }
        seen
    }

    /// What one texture is made of at a spot.
    fn sample(&self, texture: &Texture<S>, spot: &Spot<'_, S>) -> Mixture<S> {
        let p = texture.place::<NEEDS>(spot, self.placements);
        let stops = texture.ramp.stops(self.stops);
        let sample = match texture.pattern {
            Pattern::Image { image, filter } => {
                let [u, v, _] = p;
                let image = self.images.get(usize::from(image));
                let found = image.map(|image| image.at(self.pixels, [u, v], filter, texture.wrap));
                let (color, pixel) = found.unwrap_or((Rgb::BLACK, 0));
                Sample::Color(color, pixel)
            }
            pattern => pattern.sample(p, &texture.stroke()),
        };
        let grey = |level: S| Paint::Solid(Rgb::new(level, level, level));
        let of = |index: u32, count: u32| match stops.get(index as usize) {
            Some(stop) => Mixture::only(stop.paint, index),
            None => Mixture::only(grey(S::ZERO), count),
        };
        let count = stops.len() as u32;
        let joints = u32::from(texture.pattern.has_joints());
        match sample {
            Sample::Part(part) => {
                let sorts = count.saturating_sub(joints);
                of(part.checked_rem(sorts).unwrap_or(0), count)
            }
            Sample::Joint => of(count.saturating_sub(1), count),
            Sample::Level(level, part) => {
                let found = mixture(stops, texture.ramp.blend, level);
                let found = found.unwrap_or(Mixture::only(grey(level), 0));
                Mixture { side: mix(part) ^ found.side, ..found }
            }
            Sample::Color(color, pixel) => Mixture::only(Paint::Solid(color), pixel),
        }
    }

    /// The brightness of a texture, in 0..=1.
    pub(crate) fn level(&self, texture: u16, spot: &Spot<'_, S>, tally: &mut impl Tally) -> S {
        let Rgb { r, g, b } = self.mixed(texture, spot, tally).color;
        let level = if r == g && g == b {
            r
        } else {
            // The luminance of the colours of IEC 61966-2-1, in 256ths.
            let part = |n: i32| S::from_i32(n) * S::HALF.powi(8);
            r * part(54) + g * part(183) + b * part(19)
        };
        level.clamp(S::ZERO, S::ONE)
    }
}

//! Whether textures, their ramps, images and channels are legal.

use super::{check_amount, check_light_amount};
use crate::error::{Item, SceneError};
use crate::material::Material;
use crate::scalar::Scalar;
use crate::scene::Parts;
use crate::texture::noise::OCTAVES_MAX;
use crate::texture::{
    Channel, Mapping, NESTING_MAX, Paint, Pattern, Ramp, STOPS_MAX, Space, Stop, Texture,
};

/// The most steps from a texture to those that it is made of, all ways counted.
const STEPS_MAX: u32 = 4096;

/// An index into a table.
fn check_index(at: Item, table: &'static str, index: u32, len: usize) -> Result<(), SceneError> {
    let len = len as u32;
    if index < len { Ok(()) } else { Err(SceneError::IndexOutOfRange { at, table, index, len }) }
}

/// A colour, or a texture of the table; a texture may only name those before it.
pub(super) fn check_paint<S: Scalar>(
    at: Item,
    paint: Paint<S>,
    textures: usize,
    own: Option<u32>,
) -> Result<(), SceneError> {
    match paint {
        Paint::Solid(color) => check_light_amount(at, "color", color),
        Paint::Texture(index) => {
            let index = u32::from(index);
            check_index(at, "textures", index, textures)?;
            if own.is_some_and(|own| index >= own) {
                Err(SceneError::TextureOrder { at, names: index })
            } else {
                Ok(())
            }
        }
    }
}

/// A number of a texture, between two others.
fn check_range<S: Scalar>(
    at: Item,
    field: &'static str,
    value: S,
    [low, high]: [S; 2],
    allowed: &'static str,
) -> Result<(), SceneError> {
    if !value.is_finite() {
        Err(SceneError::NotFinite { at, field })
    } else if value < low || value > high {
        Err(SceneError::OutOfRange { at, field, allowed })
    } else {
        Ok(())
    }
}

/// A length of a texture.
fn check_length<S: Scalar>(at: Item, field: &'static str, value: S) -> Result<(), SceneError> {
    if !value.is_finite() {
        Err(SceneError::NotFinite { at, field })
    } else if !(value >= S::LENGTH_MIN) {
        Err(SceneError::NotPositive { at, field })
    } else if value > S::COORD_MAX {
        Err(SceneError::TooLarge { at, field })
    } else {
        Ok(())
    }
}

pub(super) fn check_texture<S: Scalar>(
    parts: &Parts<'_, S>,
    index: u32,
    texture: &Texture<S>,
) -> Result<(), SceneError> {
    let at = Item::Texture(index);
    check_ramp(parts, index, texture)?;
    for placement in [texture.placement, texture.frame].into_iter().flatten() {
        check_index(at, "placements", placement.into(), parts.placements.len())?;
    }
    if texture.mapping == Mapping::Uv
        && (texture.placement.is_some() || texture.space == Space::Shape)
    {
        let allowed = "none where a surface has coordinates of its own";
        return Err(SceneError::OutOfRange { at, field: "place", allowed });
    }
    if let Mapping::Toroidal { major } = texture.mapping {
        check_length(at, "major", major)?;
    }
    for edge in texture.size {
        check_length(at, "size", edge)?;
    }
    let hundred = S::from_i32(100);
    let allowed = "between -100 and 100";
    check_range(at, "warp", texture.warp, [-hundred, hundred], allowed)?;
    let octaves = texture.octaves;
    if octaves.count == 0 || octaves.count > OCTAVES_MAX {
        return Err(SceneError::OutOfRange { at, field: "octaves", allowed: "between 1 and 10" });
    }
    check_range(at, "gain", octaves.gain, [S::ZERO, S::ONE], "between 0 and 1")?;
    check_pattern(parts, at, &texture.pattern)
}

fn check_pattern<S: Scalar>(
    parts: &Parts<'_, S>,
    at: Item,
    pattern: &Pattern<S>,
) -> Result<(), SceneError> {
    let share = [S::ZERO, S::ONE];
    let hundred = [-S::from_i32(100), S::from_i32(100)];
    let allowed = "between -100 and 100";
    match *pattern {
        Pattern::Brick { mortar } => check_range(at, "mortar", mortar, share, "between 0 and 1"),
        Pattern::Hexagons { gap } => check_range(at, "gap", gap, share, "between 0 and 1"),
        Pattern::Wood { wobble } => check_range(at, "wobble", wobble, hundred, allowed),
        Pattern::Marble { strength } | Pattern::Agate { strength } => {
            check_range(at, "strength", strength, hundred, allowed)
        }
        Pattern::Spots { radius } => {
            let range = [S::from_ratio(1, 1000), S::from_i32(100)];
            check_range(at, "radius", radius, range, "between 0.001 and 100")
        }
        Pattern::Image { image, .. } => {
            check_index(at, "images", image.into(), parts.images.len())?;
            let Some(image) = parts.images.get(usize::from(image)) else {
                return Ok(());
            };
            if image.width == 0 || image.height == 0 {
                let allowed = "of at least 1 by 1 pixel";
                return Err(SceneError::OutOfRange { at, field: "image", allowed });
            }
            let end = image.bytes().and_then(|bytes| bytes.checked_add(image.first));
            let last = end.map_or(u32::MAX, |end| end - 1);
            check_index(at, "pixels", last, parts.pixels.len())
        }
        _ => Ok(()),
    }
}

/// The stops of a texture, in order, each of a legal paint.
fn check_ramp<S: Scalar>(
    parts: &Parts<'_, S>,
    index: u32,
    texture: &Texture<S>,
) -> Result<(), SceneError> {
    let at = Item::Texture(index);
    let Ramp { first, count, .. } = texture.ramp;
    let range = |allowed| Err(SceneError::OutOfRange { at, field: "ramp", allowed });
    let least = if texture.pattern.has_joints() { 2 } else { 1 };
    if count > STOPS_MAX {
        return range("of at most 256 stops");
    }
    match texture.pattern {
        Pattern::Image { .. } if count > 0 => {
            return range("without stops: an image has colours of its own");
        }
        _ if texture.pattern.has_parts() && count < least => {
            return range("of a stop for each sort of part, and one for the joints");
        }
        _ if count == 0 => return Ok(()),
        _ => {}
    }
    let last = u32::from(first) + u32::from(count) - 1;
    check_index(at, "stops", last, parts.stops.len())?;
    let mut before = S::ZERO;
    for stop in texture.ramp.stops(parts.stops) {
        check_range(at, "ramp", stop.at, [S::ZERO, S::ONE], "of stops between 0 and 1")?;
        if stop.at < before {
            return range("of stops in ascending order");
        }
        before = stop.at;
        check_paint(at, stop.paint, parts.textures.len(), Some(index))?;
    }
    check_nesting(parts, index, texture)
}

/// Follows every way from a texture to those that it is made of; each goes to earlier textures.
fn check_nesting<S: Scalar>(
    parts: &Parts<'_, S>,
    index: u32,
    texture: &Texture<S>,
) -> Result<(), SceneError> {
    let deep = SceneError::TooDeep { at: Item::Texture(index), limit: NESTING_MAX as u32 };
    // The stops that are left to follow, of a texture and of those inside it.
    let mut open: heapless::Vec<&[Stop<S>], NESTING_MAX> = heapless::Vec::new();
    let _ = open.push(texture.ramp.stops(parts.stops));
    let mut steps = 0;
    while let Some(stops) = open.last_mut() {
        let Some((stop, rest)) = stops.split_first() else {
            open.pop();
            continue;
        };
        *stops = rest;
        steps += 1;
        if let Paint::Texture(inner) = stop.paint {
            let inner = parts.textures.get(usize::from(inner));
            let stops = inner.map_or(&[][..], |inner| inner.ramp.stops(parts.stops));
            if open.push(stops).is_err() || steps > STEPS_MAX {
                return Err(deep);
            }
        }
    }
    Ok(())
}

/// The channels of a material.
pub(super) fn check_channels<S: Scalar>(
    parts: &Parts<'_, S>,
    at: Item,
    material: &Material<S>,
) -> Result<(), SceneError> {
    let run = material.channels;
    if run.count > 0 {
        let last = u32::from(run.first) + u32::from(run.count) - 1;
        check_index(at, "channels", last, parts.channels.len())?;
    }
    for channel in run.of(parts.channels) {
        check_index(at, "textures", channel.texture().into(), parts.textures.len())?;
        match *channel {
            Channel::Share { low, high, .. } => {
                for share in [low, high] {
                    check_amount(at, "share", share)?;
                    if share > S::ONE {
                        let allowed = "at most 1";
                        return Err(SceneError::OutOfRange { at, field: "share", allowed });
                    }
                }
            }
            Channel::Relief { depth, step, .. } => {
                let most = S::from_i32(1000);
                check_range(at, "depth", depth, [-most, most], "between -1000 and 1000")?;
                check_length(at, "step", step)?;
                if step < S::EPSILON_ROOT {
                    let allowed = "at least the square root of the rounding of 1";
                    return Err(SceneError::OutOfRange { at, field: "step", allowed });
                }
            }
        }
    }
    Ok(())
}

/// The greatest part of a colour that a paint may have.
pub(super) fn brightest<S: Scalar>(parts: &Parts<'_, S>, paint: Paint<S>) -> S {
    let last = match paint {
        Paint::Solid(color) => return color.max_part(),
        Paint::Texture(last) => last,
    };
    // A texture reaches no texture after itself. One without stops is white at most.
    let reached = parts.textures.iter().take(usize::from(last) + 1);
    reached.fold(S::ZERO, |most, texture| {
        let stops = texture.ramp.stops(parts.stops);
        let own = if stops.is_empty() { S::ONE } else { S::ZERO };
        stops.iter().fold(most.max(own), |most, stop| match stop.paint {
            Paint::Solid(color) => most.max(color.max_part()),
            Paint::Texture(_) => most,
        })
    })
}

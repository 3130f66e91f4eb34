//! The looks of a document: its textures, and the materials that they are on.

use std::collections::HashMap;
use std::path::Path as FilePath;

use nostray::{
    Affine, Channel, Channels, Fresnel, Highlight, Material, Paint, Parameter, Scalar, Stop,
};

use crate::assemble::{Assembly, rgb};
use crate::document::{self, Move, Texture};
use crate::flaw::{Flaw, Path};
use crate::moves::{compose, converted};
use crate::origin::Origins;
use crate::patterns::{Habit, bare, blend, check, default_color};
use crate::picture::picture;
use crate::written::{self, Amount, Relief, Table, Varying};

/// The textures of a document by their names.
type Names<'d> = HashMap<&'d str, u16>;

impl<S: Scalar> Assembly<S> {
    /// Adds the textures, each after those that it names.
    pub(crate) fn textures<'d>(
        &mut self,
        table: &'d Table<Texture>,
        folder: &FilePath,
    ) -> Result<Names<'d>, Flaw> {
        let root = Path::Root.field("textures");
        let mut indices = HashMap::new();
        for at in in_order(table)? {
            let Some((name, written)) = table.0.get(at) else {
                continue;
            };
            let path = root.field(name);
            let path = path.field(written.pattern);
            check(written, &path)?;
            let image = match written.pattern {
                "Image" => Some(self.image(written, folder, &path)?),
                _ => None,
            };
            let mut texture = bare::<S>(written, image);
            texture.ramp = self.ramp(written, &indices, &path)?;
            let drawn = &written.drawn;
            if drawn.mapping == document::Mapping::Uv {
                let of_its_own = "a surface's own coordinates have no place: use frame";
                if !drawn.place.is_empty() || drawn.space != document::Space::Scene {
                    return Err(Flaw::new(path.field("place"), of_its_own));
                }
            }
            texture.placement = self.texture_placement(&drawn.place, &path.field("place"))?;
            texture.frame = self.texture_placement(&drawn.frame, &path.field("frame"))?;
            let added = self.builder.texture(texture);
            let index = added.map_err(|error| Origins::at(&error, path))?;
            indices.insert(name.as_str(), index);
            self.origins.textures.push(path.to_string());
        }
        Ok(indices)
    }

    fn image(
        &mut self,
        written: &Texture,
        folder: &FilePath,
        path: &Path<'_>,
    ) -> Result<u16, Flaw> {
        let (image, bytes) = picture(&written.drawn, folder, path)?;
        self.builder.image(image, &bytes).map_err(|error| Origins::at(&error, path))
    }

    /// Adds the stops of a texture.
    fn ramp(
        &mut self,
        written: &Texture,
        names: &Names<'_>,
        path: &Path<'_>,
    ) -> Result<nostray::Ramp, Flaw> {
        let drawn = &written.drawn;
        let mut stops = Vec::new();
        if let Some(colors) = &drawn.colors {
            let last = colors.0.len().saturating_sub(1).max(1) as i32;
            for (index, color) in colors.0.iter().enumerate() {
                let paint = paint(color, names, &path.field("colors").entry(index))?;
                stops.push(Stop { at: S::from_ratio(index as i32, last), paint });
            }
        } else if let Some(written) = &drawn.stops {
            for (index, stop) in written.0.iter().enumerate() {
                let paint = paint(&stop.1, names, &path.field("stops").entry(index).entry(1))?;
                stops.push(Stop { at: S::from_f64(stop.0), paint });
            }
        }
        if stops.is_empty() {
            let habit = Habit::of(written.pattern).stops;
            stops.extend(habit.iter().map(|(at, color)| Stop {
                at: S::from_f64(*at),
                paint: Paint::Solid(default_color(*color)),
            }));
        }
        self.builder.ramp(&stops, blend(drawn)).map_err(|error| Origins::at(&error, path))
    }

    fn texture_placement(&mut self, place: &[Move], path: &Path<'_>) -> Result<Option<u16>, Flaw> {
        if place.is_empty() {
            return Ok(None);
        }
        let to_world: Affine<S> = converted(&compose(place, path)?);
        let added = self.builder.placement(&to_world);
        added.map(Some).map_err(|error| Origins::at(&error, path))
    }

    /// Adds the materials.
    pub(crate) fn materials<'d>(
        &mut self,
        table: &'d Table<document::Material>,
        textures: &Names<'_>,
    ) -> Result<Names<'d>, Flaw> {
        let root = Path::Root.field("materials");
        let mut indices = HashMap::new();
        for (name, written) in &table.0 {
            let path = root.field(name);
            let mut material = Material {
                color: paint(&written.color, textures, &path.field("color"))?,
                highlight: match written.highlight {
                    document::Highlight::Phong => Highlight::Phong,
                    document::Highlight::Blinn => Highlight::Blinn,
                },
                metallic: written.metallic,
                roughness: S::from_f64(written.roughness),
                ior: S::from_f64(written.ior),
                fresnel: match written.fresnel {
                    document::Fresnel::Off => Fresnel::Off,
                    document::Fresnel::Schlick => Fresnel::Schlick,
                    document::Fresnel::Exact => Fresnel::Exact,
                },
                absorb: rgb(written.absorb),
                ..Material::PLAIN
            };
            self.amounts(written, &mut material, textures, &path)?;
            let added = self.builder.material(material);
            let index = added.map_err(|error| Origins::at(&error, path))?;
            indices.insert(name.as_str(), index);
            self.origins.materials.push(path.to_string());
        }
        Ok(indices)
    }

    /// The numbers of a material, and the textures that drive them and its normals.
    fn amounts(
        &mut self,
        written: &document::Material,
        material: &mut Material<S>,
        textures: &Names<'_>,
        path: &Path<'_>,
    ) -> Result<(), Flaw> {
        let mut channels = Vec::new();
        for (of, name, amount, number) in [
            (Parameter::Ambient, "ambient", &written.ambient, &mut material.ambient),
            (Parameter::Diffuse, "diffuse", &written.diffuse, &mut material.diffuse),
            (Parameter::Specular, "specular", &written.specular, &mut material.specular),
            (Parameter::Shininess, "shininess", &written.shininess, &mut material.shininess),
            (Parameter::Reflect, "reflect", &written.reflect, &mut material.reflect),
            (Parameter::Transmit, "transmit", &written.transmit, &mut material.transmit),
        ] {
            let path = path.field(name);
            match amount {
                Amount::Number(amount) => *number = S::from_f64(*amount),
                Amount::Texture(varying) => {
                    let texture = named(&varying.texture, textures, &path.field("texture"))?;
                    let (most, low, high) = shares::<S>(varying, &path)?;
                    *number = most;
                    channels.push(Channel::Share { of, texture, low, high });
                }
            }
        }
        let path = path.field("relief");
        for (index, relief) in written.relief.all.iter().enumerate() {
            let entry = path.entry(index);
            let path = if written.relief.listed { &entry } else { &path };
            channels.push(height(relief, textures, path)?);
        }
        material.channels = if channels.is_empty() {
            Channels::NONE
        } else {
            self.builder.channels(&channels).map_err(|error| Origins::at(&error, path))?
        };
        Ok(())
    }
}

/// The greatest number of a texture's two, and the shares of it.
fn shares<S: Scalar>(varying: &Varying, path: &Path<'_>) -> Result<(S, S, S), Flaw> {
    let Varying { from, to, .. } = *varying;
    for (name, number) in [("from", from), ("to", to)] {
        if !number.is_finite() {
            return Err(Flaw::new(path.field(name), "is not a finite number"));
        }
        if number < 0.0 {
            return Err(Flaw::new(path.field(name), "must be at least 0"));
        }
    }
    let most = if from < to { to } else { from };
    if most == 0.0 {
        return Ok((S::ZERO, S::ZERO, S::ZERO));
    }
    Ok((S::from_f64(most), S::from_f64(from / most), S::from_f64(to / most)))
}

fn height<S: Scalar>(
    relief: &Relief,
    textures: &Names<'_>,
    path: &Path<'_>,
) -> Result<Channel<S>, Flaw> {
    let texture = named(&relief.texture, textures, &path.field("texture"))?;
    if !(-1000.0..=1000.0).contains(&relief.depth) {
        return Err(Flaw::new(path.field("depth"), "must be between -1000 and 1000"));
    }
    let step = S::from_f64(relief.step);
    if !(step >= S::EPSILON_ROOT && step <= S::COORD_MAX) {
        let least = S::EPSILON_ROOT;
        let message = format!("must be finite and at least {least} in this number format");
        return Err(Flaw::new(path.field("step"), message));
    }
    Ok(Channel::Relief { texture, depth: S::from_f64(relief.depth), step })
}

/// The index of a texture.
fn named(name: &str, textures: &Names<'_>, path: &Path<'_>) -> Result<u16, Flaw> {
    let unknown = || Flaw::new(path, format!("there is no texture {name:?}"));
    textures.get(name).copied().ok_or_else(unknown)
}

fn paint<S: Scalar>(
    written: &written::Paint,
    textures: &Names<'_>,
    path: &Path<'_>,
) -> Result<Paint<S>, Flaw> {
    match written {
        written::Paint::Color(color) => Ok(Paint::Solid(rgb(*color))),
        written::Paint::Texture(name) => named(name, textures, path).map(Paint::Texture),
    }
}

/// The entries of a table of textures in an order in which each comes after those it names.
fn in_order(table: &Table<Texture>) -> Result<Vec<usize>, Flaw> {
    let by_name: HashMap<&str, usize> =
        table.0.iter().enumerate().map(|(index, (name, _))| (name.as_str(), index)).collect();
    let named = |index: usize| {
        let paints = table.0.get(index).map(|(_, texture)| texture.drawn.paints());
        paints.into_iter().flatten().filter_map(|paint| match paint {
            written::Paint::Color(_) => None,
            written::Paint::Texture(name) => by_name.get(name.as_str()).copied(),
        })
    };
    // Depth first, on a stack of its own: an entry is placed when all that it names are.
    let mut state = vec![Visit::New; table.0.len()];
    let mut order = Vec::with_capacity(table.0.len());
    for first in 0..table.0.len() {
        let mut waiting = vec![first];
        while let Some(&index) = waiting.last() {
            let Some(visit) = state.get_mut(index).filter(|visit| **visit != Visit::Placed) else {
                waiting.pop();
                continue;
            };
            *visit = Visit::Open;
            let next = named(index).find(|&next| state.get(next) != Some(&Visit::Placed));
            match next {
                None => {
                    waiting.pop();
                    order.push(index);
                    if let Some(visit) = state.get_mut(index) {
                        *visit = Visit::Placed;
                    }
                }
                Some(next) if state.get(next) == Some(&Visit::Open) => {
                    let name = table.0.get(next).map_or("", |(name, _)| name.as_str());
                    let path = Path::Root.field("textures");
                    return Err(Flaw::new(path.field(name), "is made of itself"));
                }
                Some(next) => waiting.push(next),
            }
        }
    }
    Ok(order)
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Visit {
    New,
    Open,
    Placed,
}

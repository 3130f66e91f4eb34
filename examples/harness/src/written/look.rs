//! Values of materials and textures that may be written in more than one way.

use std::fmt;
use std::marker::PhantomData;

use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserialize, Deserializer, Error, MapAccess, SeqAccess, Visitor};

/// Any number of values: `(a, b, …)` or `[a, b, …]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Many<T>(pub Vec<T>);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Many<T> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Reader<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for Reader<T> {
            type Value = Many<T>;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a list")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Many<T>, A::Error> {
                let mut values = Vec::new();
                while let Some(value) = list.next_element()? {
                    values.push(value);
                }
                Ok(Many(values))
            }
        }
        from.deserialize_any(Reader(PhantomData))
    }
}

/// A number of a material, or the texture whose brightness leads from one number to another.
#[derive(Clone, Debug, PartialEq)]
pub enum Amount {
    /// The same everywhere.
    Number(f64),
    /// From place to place.
    Texture(Varying),
}

/// Two numbers, and the texture that leads from one to the other; in a file also its name alone, for
/// 0 and 1.
#[derive(Clone, Debug, PartialEq, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Varying {
    /// The name of the texture.
    pub texture: String,
    /// The number where the texture is black; 0 if left out.
    #[serde(default)]
    pub from: f64,
    /// The number where the texture is white; 1 if left out.
    #[serde(default = "one")]
    pub to: f64,
}

fn one() -> f64 {
    1.0
}

impl From<f64> for Amount {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl<'de> Deserialize<'de> for Amount {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Reader;
        impl<'de> Visitor<'de> for Reader {
            type Value = Amount;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number, or (texture: …, from: …, to: …)")
            }
            fn visit_f64<E: Error>(self, number: f64) -> Result<Amount, E> {
                Ok(Amount::Number(number))
            }
            fn visit_i64<E: Error>(self, number: i64) -> Result<Amount, E> {
                Ok(Amount::Number(number as f64))
            }
            fn visit_u64<E: Error>(self, number: u64) -> Result<Amount, E> {
                Ok(Amount::Number(number as f64))
            }
            fn visit_str<E: Error>(self, name: &str) -> Result<Amount, E> {
                Ok(Amount::Texture(Varying { texture: name.to_owned(), from: 0.0, to: 1.0 }))
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Amount, A::Error> {
                Varying::deserialize(MapAccessDeserializer::new(map)).map(Amount::Texture)
            }
        }
        from.deserialize_any(Reader)
    }
}

/// A texture that is a height over a surface.
#[derive(Clone, Debug, PartialEq, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Relief {
    /// The name of the texture.
    pub texture: String,
    /// How much higher white is than black; negative for hollows.
    pub depth: f64,
    /// Half the distance between the places whose heights are compared; 0.01 if left out.
    #[serde(default = "hundredth")]
    pub step: f64,
}

fn hundredth() -> f64 {
    0.01
}

/// One relief, or a list of some that add up; none by default.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reliefs {
    /// The reliefs.
    pub all: Vec<Relief>,
    /// They are written as a list.
    pub listed: bool,
}

impl<'de> Deserialize<'de> for Reliefs {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Reader;
        impl<'de> Visitor<'de> for Reader {
            type Value = Reliefs;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("(texture: …, depth: …), or a list of such")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Reliefs, A::Error> {
                let mut all = Vec::new();
                while let Some(relief) = list.next_element()? {
                    all.push(relief);
                }
                Ok(Reliefs { all, listed: true })
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Reliefs, A::Error> {
                let relief = Relief::deserialize(MapAccessDeserializer::new(map))?;
                Ok(Reliefs { all: vec![relief], listed: false })
            }
        }
        from.deserialize_any(Reader)
    }
}

//! Values that a scene file may write in more than one way.

mod look;

pub use look::{Amount, Many, Relief, Reliefs, Varying};

use std::fmt;
use std::marker::PhantomData;

use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserialize, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};

/// A point, a direction or a linear colour: `(x, y, z)` or `[x, y, z]`; zero by default.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Triple(pub [f64; 3]);

impl Triple {
    fn from_seq<'de, A: SeqAccess<'de>>(mut list: A) -> Result<Self, A::Error> {
        let mut triple = [0.0; 3];
        for (index, part) in triple.iter_mut().enumerate() {
            *part = list
                .next_element()?
                .ok_or_else(|| A::Error::invalid_length(index, &"three numbers"))?;
        }
        match list.next_element::<IgnoredAny>()? {
            None => Ok(Self(triple)),
            Some(_) => Err(A::Error::custom("more than three numbers")),
        }
    }
}

impl<'de> Deserialize<'de> for Triple {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Reader;
        impl<'de> Visitor<'de> for Reader {
            type Value = Triple;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("three numbers, as (x, y, z)")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Triple, A::Error> {
                Triple::from_seq(list)
            }
        }
        from.deserialize_any(Reader)
    }
}

/// So many values of one kind: `(a, b)` or `[a, b]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Several<T, const N: usize>(pub [T; N]);

impl<'de, T: Deserialize<'de>, const N: usize> Deserialize<'de> for Several<T, N> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Reader<T, const N: usize>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>, const N: usize> Visitor<'de> for Reader<T, N> {
            type Value = Several<T, N>;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "a list of {N}")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Self::Value, A::Error> {
                let mut values = Vec::with_capacity(N);
                while let Some(value) = list.next_element()? {
                    values.push(value);
                    if values.len() > N {
                        break;
                    }
                }
                let len = values.len();
                let values = values.try_into().map_err(|_| A::Error::invalid_length(len, &self))?;
                Ok(Several(values))
            }
        }
        from.deserialize_any(Reader(PhantomData))
    }
}

/// A number for each axis: `(x, y, z)`, or one number for all three; 1 by default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factor(pub [f64; 3]);

impl Default for Factor {
    fn default() -> Self {
        Self([1.0; 3])
    }
}

impl<'de> Deserialize<'de> for Factor {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Reader;
        impl<'de> Visitor<'de> for Reader {
            type Value = Factor;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number, or three as (x, y, z)")
            }
            fn visit_f64<E: Error>(self, number: f64) -> Result<Factor, E> {
                Ok(Factor([number; 3]))
            }
            fn visit_i64<E: Error>(self, number: i64) -> Result<Factor, E> {
                Ok(Factor([number as f64; 3]))
            }
            fn visit_u64<E: Error>(self, number: u64) -> Result<Factor, E> {
                Ok(Factor([number as f64; 3]))
            }
            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Factor, A::Error> {
                Triple::from_seq(list).map(|triple| Factor(triple.0))
            }
        }
        from.deserialize_any(Reader)
    }
}

/// A linear colour, or the name of a texture in quotes; white by default.
#[derive(Clone, Debug, PartialEq)]
pub enum Paint {
    /// The same everywhere.
    Color(Triple),
    /// The name of a texture.
    Texture(String),
}

impl Default for Paint {
    fn default() -> Self {
        Self::Color(Triple([1.0; 3]))
    }
}

impl<'de> Deserialize<'de> for Paint {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Reader;
        impl<'de> Visitor<'de> for Reader {
            type Value = Paint;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a colour as (r, g, b), or the name of a texture in quotes")
            }
            fn visit_str<E: Error>(self, name: &str) -> Result<Paint, E> {
                Ok(Paint::Texture(name.to_owned()))
            }
            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Paint, A::Error> {
                Triple::from_seq(list).map(Paint::Color)
            }
        }
        from.deserialize_any(Reader)
    }
}

/// One colour, or a vertical gradient as `(bottom: …, top: …)`; black by default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Background {
    /// The same in every direction.
    Constant(Triple),
    /// From straight down to straight up.
    Gradient(Gradient),
}

/// The colours of a vertical gradient.
#[derive(Clone, Copy, Debug, PartialEq, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Gradient {
    /// The colour at −y.
    pub bottom: Triple,
    /// The colour at +y.
    pub top: Triple,
}

impl Default for Background {
    fn default() -> Self {
        Self::Constant(Triple::default())
    }
}

impl<'de> Deserialize<'de> for Background {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Reader;
        impl<'de> Visitor<'de> for Reader {
            type Value = Background;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a colour as (r, g, b), or (bottom: …, top: …)")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Background, A::Error> {
                Triple::from_seq(list).map(Background::Constant)
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Background, A::Error> {
                Gradient::deserialize(MapAccessDeserializer::new(map)).map(Background::Gradient)
            }
        }
        from.deserialize_any(Reader)
    }
}

/// Entries by name, in the order of the file. No name may stand twice.
#[derive(Clone, Debug)]
pub struct Table<T>(pub Vec<(String, T)>);

impl<T> Default for Table<T> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Table<T> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Reader<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for Reader<T> {
            type Value = Table<T>;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a table, as {\"name\": …}")
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Table<T>, A::Error> {
                let (mut entries, mut seen) = (Vec::new(), std::collections::BTreeSet::new());
                while let Some(name) = map.next_key::<String>()? {
                    if !seen.insert(name.clone()) {
                        return Err(A::Error::custom(format_args!(
                            "the name \"{name}\" stands twice"
                        )));
                    }
                    entries.push((name, map.next_value()?));
                }
                Ok(Table(entries))
            }
        }
        from.deserialize_map(Reader(PhantomData))
    }
}

/// Reads a field that may be left out, but not be empty where it stands.
pub(crate) fn present<'de, D, T>(from: D) -> Result<Option<T>, D::Error>
where
    D: Deserializer<'de>,
    T: Deserialize<'de>,
{
    T::deserialize(from).map(Some)
}

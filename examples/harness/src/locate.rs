//! Finds the line of a field by its path, for messages about scenes that were read without
//! fault but make no sense.

use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};

use crate::read::Syntax;

/// The line and column, from 1, of the value at a path such as
/// `objects[3].solid.Difference[1].Sphere.radius`; `None` where there is none.
pub(crate) fn locate(text: &str, syntax: Syntax, path: &str) -> Option<(usize, usize)> {
    // Reading stops at the value with an error of our own, whose place the reader knows.
    match syntax {
        Syntax::Ron => {
            let mut from = ron::Deserializer::from_str(text).ok()?;
            let error = Seek(path).deserialize(&mut from).err()?;
            let error = from.span_error(error);
            let found = error.code.to_string() == FOUND;
            found.then_some((error.span.end.line, error.span.end.col))
        }
        Syntax::Json => {
            let error =
                Seek(path).deserialize(&mut serde_json::Deserializer::from_str(text)).err()?;
            error.to_string().starts_with(FOUND).then_some((error.line(), error.column()))
        }
    }
}

const FOUND: &str = "here it is";

/// What is left of a path, from some value on.
#[derive(Clone, Copy)]
struct Seek<'a>(&'a str);

impl<'a> Seek<'a> {
    /// What follows a field of this name, if the path goes there.
    fn after(self, name: &str) -> Option<Self> {
        let rest = self.0.strip_prefix(name)?;
        match rest.as_bytes().first() {
            None | Some(b'[') => Some(Self(rest)),
            Some(b'.') => rest.get(1..).map(Self),
            Some(_) => None,
        }
    }

    /// What follows the name of a variant, which RON does not give back.
    fn after_variant(self) -> Option<Self> {
        let end = self.0.find(['.', '[']).unwrap_or(self.0.len());
        let name = self.0.get(..end)?;
        if name.starts_with(char::is_uppercase) { self.after(name) } else { None }
    }

    /// The entry of a list that the path goes to, and what follows.
    fn entry(self) -> Option<(usize, Self)> {
        let (index, rest) = self.0.strip_prefix('[')?.split_once(']')?;
        Some((index.parse().ok()?, Self(rest.strip_prefix('.').unwrap_or(rest))))
    }
}

impl<'de> DeserializeSeed<'de> for Seek<'_> {
    type Value = ();
    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<(), D::Error> {
        if self.0.is_empty() { Err(D::Error::custom(FOUND)) } else { from.deserialize_any(self) }
    }
}

impl<'de> Visitor<'de> for Seek<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list or a table")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        let (index, rest) = match self.entry() {
            Some(entry) => entry,
            None => {
                let inside = self.after_variant();
                (0, inside.ok_or_else(|| A::Error::custom("no such entry"))?)
            }
        };
        for _ in 0..index {
            list.next_element::<IgnoredAny>()?;
        }
        list.next_element_seed(rest)?;
        Err(A::Error::custom("no such entry"))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        let inside = self.after_variant();
        while let Some(key) = map.next_key_seed(Key)? {
            let within = |seek: Self| seek.after(&key);
            match within(self).or_else(|| inside.and_then(within)) {
                Some(rest) => map.next_value_seed(rest)?,
                None => {
                    map.next_value::<IgnoredAny>()?;
                }
            }
        }
        // The fields of a variant that is itself what is sought: its name is not given back.
        let itself = inside.is_some_and(|rest| rest.0.is_empty());
        Err(A::Error::custom(if itself { FOUND } else { "no such field" }))
    }
}

/// A key, whether it is written as a name or as a string.
struct Key;

impl<'de> DeserializeSeed<'de> for Key {
    type Value = String;
    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<String, D::Error> {
        from.deserialize_any(self)
    }
}

impl Visitor<'_> for Key {
    type Value = String;
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a name")
    }
    fn visit_str<E: Error>(self, name: &str) -> Result<String, E> {
        Ok(name.to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RON: &str =
        "(\n list: [\n  (a: 1),\n  Ball(a: Deep([\n   2,\n   (b:\n 3)])),\n ],\n {NAME})";

    fn in_ron(path: &str) -> Option<usize> {
        locate(&RON.replace("{NAME}", "names: {\"x.y\":\n (c: 0)}"), Syntax::Ron, path)
            .map(|(line, _)| line)
    }

    #[test]
    fn paths_lead_to_lines() {
        assert_eq!(in_ron("list"), Some(2));
        assert_eq!(in_ron("list[0].a"), Some(3));
        assert_eq!(in_ron("list[1]"), Some(4));
        assert_eq!(in_ron("list[1].Ball"), Some(7), "where its fields end");
        assert_eq!(in_ron("list[1].Ball.a"), Some(4));
        assert_eq!(in_ron("list[1].Ball.a.Deep[0]"), Some(5));
        assert_eq!(in_ron("list[1].Ball.a.Deep[1].b"), Some(7));
        assert_eq!(in_ron("names.x.y.c"), Some(10));
    }

    #[test]
    fn other_paths_lead_nowhere() {
        for path in ["lis", "list[2]", "list[0].b", "list[x]", "names.x", "list[1].Ball.a.Deep[7]"]
        {
            assert_eq!(in_ron(path), None, "{path}");
        }
        assert_eq!(locate("(", Syntax::Ron, "a"), None);
        assert_eq!(locate("", Syntax::Json, "a"), None);
    }

    #[test]
    fn json_is_searched_the_same_way() {
        let text = "{\"list\": [0,\n {\"Ball\": {\"a\":\n [1,\n 2]}}]}";
        let line = |path| locate(text, Syntax::Json, path).map(|(line, _)| line);
        assert_eq!(line("list[1].Ball.a[1]"), Some(4));
        assert_eq!(line("list[1].Ball.b"), None);
    }
}

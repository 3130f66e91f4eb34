//! The way back: from an entry of a scene's tables to the path in the document it came from.

use nostray::{Item, SceneError};

use crate::flaw::Flaw;

/// Where the entries of a scene's tables came from.
#[derive(Clone, Debug, Default)]
pub(crate) struct Origins {
    pub(crate) textures: Vec<String>,
    pub(crate) materials: Vec<String>,
    pub(crate) lights: Vec<String>,
    /// The background has two colours.
    pub(crate) gradient: bool,
}

impl Origins {
    /// An error of the finished scene, told by the path in the document.
    pub(crate) fn flaw(&self, error: SceneError) -> Flaw {
        let of = |table: &[String], index: u32| table.get(index as usize).cloned();
        let path = match item(&error) {
            Some(Item::Texture(index)) => of(&self.textures, index),
            Some(Item::Material(index)) => of(&self.materials, index),
            Some(Item::Light(index)) => of(&self.lights, index),
            Some(Item::Object(index)) => Some(format!("objects[{index}]")),
            Some(Item::Camera) => Some("camera".to_owned()),
            Some(Item::Background) if !self.gradient => {
                return Flaw::new("background", told(&error).1);
            }
            Some(Item::Background) => Some("background".to_owned()),
            Some(Item::Ambient) => return Flaw::new("ambient", told(&error).1),
            _ => None,
        };
        match path {
            Some(path) => Self::at(&error, path),
            None => Flaw { path: String::new(), message: error.to_string() },
        }
    }

    /// An error whose item has the given path in the document.
    pub(crate) fn at(error: &SceneError, path: impl std::fmt::Display) -> Flaw {
        let (field, message) = told(error);
        match field {
            None => Flaw::new(path, message),
            // The parameter is the whole value, or several fields of it.
            Some("corners") => Flaw::new(path, format!("the corners {message}")),
            Some("vertices") => Flaw::new(path, format!("the vertices {message}")),
            Some("placement") => Flaw::new(path, format!("the placement {message}")),
            Some(field) => {
                let field = written_as(error, field);
                Flaw::new(format_args!("{path}.{field}"), message)
            }
        }
    }

    /// The node that an error names.
    pub(crate) fn node_of(error: &SceneError) -> Option<u32> {
        match item(error) {
            Some(Item::Node(node)) => Some(node),
            _ => None,
        }
    }
}

/// The name that a document has for a parameter of the core.
fn written_as(error: &SceneError, field: &'static str) -> &'static str {
    match (item(error), field) {
        (Some(Item::Light(_)), "cone") => "outer",
        (Some(Item::Texture(_)), "color") => "colors",
        (Some(Item::Node(_)), "half_height") => "top",
        _ => field,
    }
}

/// The parameter that an error is about, and what is wrong without the names of either.
fn told(error: &SceneError) -> (Option<&'static str>, String) {
    let field = match *error {
        SceneError::NotFinite { field, .. }
        | SceneError::NotPositive { field, .. }
        | SceneError::TooLarge { field, .. }
        | SceneError::OutOfRange { field, .. }
        | SceneError::Empty { field, .. }
        | SceneError::Inverted { field, .. }
        | SceneError::NotPlanar { field, .. }
        | SceneError::OffCentre { field, .. } => Some(field),
        _ => None,
    };
    let message = match (error, field) {
        (SceneError::Empty { at: Item::Camera, .. }, Some("look_at")) => {
            return (field, "must not be where the eye is".to_owned());
        }
        (SceneError::Empty { at: Item::Camera, .. }, Some("up")) => {
            return (field, "must not be along the line of sight".to_owned());
        }
        (SceneError::NotFinite { .. }, Some("placement")) => {
            return (field, "is beyond the range of this number format".to_owned());
        }
        (SceneError::Empty { .. }, Some("corners")) => {
            return (field, "lie on one line".to_owned());
        }
        (SceneError::Empty { .. }, Some("vertices")) => {
            return (field, "span no area".to_owned());
        }
        _ => error.to_string(),
    };
    let prefix = item(error).map(|at| format!("{at}: ")).unwrap_or_default();
    let message = message.strip_prefix(&prefix).unwrap_or(&message);
    let bare = field.and_then(|field| message.strip_prefix(field));
    (field, bare.unwrap_or(message).trim_start().to_owned())
}

fn item(error: &SceneError) -> Option<Item> {
    match *error {
        SceneError::NotFinite { at, .. }
        | SceneError::NotPositive { at, .. }
        | SceneError::TooLarge { at, .. }
        | SceneError::OutOfRange { at, .. }
        | SceneError::Empty { at, .. }
        | SceneError::Inverted { at, .. }
        | SceneError::NotPlanar { at, .. }
        | SceneError::Triangle { at, .. }
        | SceneError::Hierarchy { at, .. }
        | SceneError::SingularPlacement { at }
        | SceneError::Placed { at }
        | SceneError::OffCentre { at, .. }
        | SceneError::IndexOutOfRange { at, .. }
        | SceneError::TextureOrder { at, .. }
        | SceneError::OperandUnderflow { at, .. }
        | SceneError::OperandOverflow { at, .. }
        | SceneError::OperatorSize { at, .. }
        | SceneError::StrayNodes { at, .. }
        | SceneError::TooDeep { at, .. }
        | SceneError::SpanOverflow { at, .. }
        | SceneError::OpenSurface { at, .. }
        | SceneError::Program { at, .. }
        | SceneError::BoundsTooSmall { at }
        | SceneError::Unbalanced { at } => Some(at),
        _ => None,
    }
}

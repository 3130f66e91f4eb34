//! Where a scene comes from: the gallery, or a file.

use std::path::{Path, PathBuf};

use nostray::Scalar;

use crate::assemble::Assembly;
use crate::gallery::{self, Entry};
use crate::read::{Syntax, read};

/// A scene that was asked for by name.
#[derive(Clone, Debug)]
pub enum Source {
    /// An entry of the gallery.
    Gallery(&'static Entry),
    /// A file, and how it is written.
    File(PathBuf, Kind),
}

/// How a scene file is written, by the ending of its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// This project's own structure.
    Document(Syntax),
}

/// A scene, ready to be checked and rendered.
#[derive(Clone, Debug)]
pub struct Loaded<S: Scalar> {
    /// Its tables.
    pub assembly: Assembly<S>,
    /// The size of the picture, where the scene tells.
    pub size: Option<(u32, u32)>,
}

impl Source {
    /// What a name stands for: a file if it ends like one, else an entry of the gallery.
    ///
    /// # Errors
    /// A message, if it is neither.
    pub fn find(name: &str) -> Result<Self, String> {
        let path = Path::new(name);
        let kind = match path.extension().and_then(|ending| ending.to_str()) {
            Some("ron") => Kind::Document(Syntax::Ron),
            Some("json") => Kind::Document(Syntax::Json),
            _ => {
                let unknown = || {
                    format!(
                        "{name}: is neither in the gallery (see --list) nor a .ron or .json file"
                    )
                };
                return gallery::find(name).map(Self::Gallery).ok_or_else(unknown);
            }
        };
        Ok(Self::File(path.to_owned(), kind))
    }

    /// The name as messages begin with it.
    pub fn name(&self) -> String {
        match self {
            Self::Gallery(entry) => entry.name.to_owned(),
            Self::File(path, _) => path.display().to_string(),
        }
    }

    /// The file that a picture of it is written to by default.
    pub fn picture(&self) -> PathBuf {
        let stem = match self {
            Self::Gallery(entry) => Path::new(entry.name).as_os_str(),
            Self::File(path, _) => path.file_stem().unwrap_or(path.as_os_str()),
        };
        let mut name = stem.to_owned();
        name.push(".png");
        PathBuf::from(name)
    }

    /// Reads it into the tables of a scene.
    ///
    /// # Errors
    /// One line that names the file, and the line or the field that is wrong.
    pub fn load<S: Scalar>(&self) -> Result<Loaded<S>, String> {
        let name = self.name();
        let document = match self {
            Self::Gallery(entry) => entry.document().map_err(|error| format!("{name}:{error}"))?,
            Self::File(path, Kind::Document(syntax)) => {
                read(&text_of(path)?, *syntax).map_err(|error| format!("{name}:{error}"))?
            }
        };
        let assembly =
            Assembly::of_document(&document).map_err(|flaw| format!("{name}: {flaw}"))?;
        Ok(Loaded { assembly, size: None })
    }
}

fn text_of(path: &Path) -> Result<String, String> {
    let bytes = std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    String::from_utf8(bytes).map_err(|_| format!("{}: is not UTF-8 text", path.display()))
}

//! Where a scene comes from: the gallery, or a file.

use std::path::{Path, PathBuf};

use nostray::{Scalar, Scene};

use crate::assemble::Assembly;
use crate::flaw::Flaw;
use crate::gallery::{self, Entry};
use crate::locate::locate;
use crate::nff::{self, NffError, NffScene};
use crate::read::{Syntax, Unreadable, read};

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
    /// The Neutral File Format.
    Nff,
}

/// A scene, ready to be checked and rendered.
#[derive(Clone, Debug)]
pub struct Loaded<S: Scalar> {
    /// The size of the picture, where the scene tells.
    pub size: Option<(u32, u32)>,
    /// What was not taken as it stood, in one line each.
    pub notes: Vec<String>,
    assembly: Assembly<S>,
    told: Told,
}

impl<S: Scalar> Loaded<S> {
    /// The checked scene.
    ///
    /// # Errors
    /// One line that names the file, and the line and the field that is wrong.
    pub fn scene(&self) -> Result<Scene<'_, S>, String> {
        self.assembly.scene().map_err(|flaw| self.told.flaw(&flaw))
    }
}

/// What messages about a scene are made of.
#[derive(Clone, Debug)]
struct Told {
    name: String,
    text: Option<(String, Syntax)>,
}

impl Told {
    fn flaw(&self, flaw: &Flaw) -> String {
        let place = self.text.as_ref();
        let place = place.and_then(|(text, syntax)| locate(text, *syntax, &flaw.path));
        match place {
            Some((line, column)) => format!("{}:{line}:{column}: {flaw}", self.name),
            None => format!("{}: {flaw}", self.name),
        }
    }
}

impl Source {
    /// What a name stands for: a file if it ends like one, else an entry of the gallery.
    ///
    /// # Errors
    /// A message, if it is neither.
    pub fn find(name: &str) -> Result<Self, String> {
        let path = Path::new(name);
        let ending = path.extension().and_then(|ending| ending.to_str());
        let kind = match ending.map(str::to_ascii_lowercase).as_deref() {
            Some("ron") => Kind::Document(Syntax::Ron),
            Some("json") => Kind::Document(Syntax::Json),
            Some("nff") => Kind::Nff,
            _ => {
                let unknown = || {
                    format!(
                        "{name}: is neither in the gallery (see --list) nor a .ron, .json or .nff file"
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
    /// One line that names the file, and the line and the field that is wrong.
    pub fn load<S: Scalar>(&self) -> Result<Loaded<S>, String> {
        let name = self.name();
        let unread = |error: Unreadable| format!("{name}:{error}");
        let (document, text) = match self {
            Self::Gallery(entry) => {
                let text = entry.text().map(|text| (text.to_owned(), Syntax::Ron));
                (entry.document().map_err(unread)?, text)
            }
            Self::File(path, Kind::Nff) => return load_nff(name, &text_of(path)?),
            Self::File(path, Kind::Document(syntax)) => {
                let text = text_of(path)?;
                let mut document = read(&text, *syntax).map_err(unread)?;
                let folder = path.parent().unwrap_or(Path::new(""));
                document.objects.iter_mut().for_each(|object| object.solid.in_folder(folder));
                (document, Some((text, *syntax)))
            }
        };
        let told = Told { name, text };
        let folder = match self {
            Self::Gallery(_) => None,
            Self::File(path, _) => path.parent(),
        };
        let folder = folder.unwrap_or(Path::new(""));
        let assembly = Assembly::of_document_in(&document, folder);
        let assembly = assembly.map_err(|flaw| told.flaw(&flaw))?;
        Ok(Loaded { size: None, notes: Vec::new(), assembly, told })
    }
}

fn load_nff<S: Scalar>(name: String, text: &str) -> Result<Loaded<S>, String> {
    let NffScene { builder, size, skipped, flattened } = nff::load(text)
        .map_err(|NffError { line, message }| format!("{name}:{line}: {message}"))?;
    let note = |count: usize, what: &str| (count > 0).then(|| format!("{name}: {count} {what}"));
    let notes = [
        note(skipped, "objects without any extent are left out"),
        note(flattened, "polygons have a normal without direction and look flat"),
    ];
    let notes = notes.into_iter().flatten().collect();
    let assembly = Assembly::of_builder(builder);
    Ok(Loaded { size, notes, assembly, told: Told { name, text: None } })
}

fn text_of(path: &Path) -> Result<String, String> {
    let bytes = std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    String::from_utf8(bytes).map_err(|error| {
        let good = error.as_bytes().iter().take(error.utf8_error().valid_up_to());
        let line = 1 + good.filter(|&&byte| byte == b'\n').count();
        format!("{}:{line}: is not UTF-8 text", path.display())
    })
}

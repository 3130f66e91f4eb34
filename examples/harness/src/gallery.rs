//! Scenes that come with the project.

use crate::document::Document;
use crate::read::{Syntax, Unreadable, read};
use crate::sphereflake::sphereflake;

/// A scene of the gallery.
#[derive(Debug)]
pub struct Entry {
    /// What it is called.
    pub name: &'static str,
    /// What it shows, in one line.
    pub description: &'static str,
    origin: Origin,
}

#[derive(Debug)]
enum Origin {
    /// A scene file.
    Ron(&'static str),
    /// Made at run time.
    Made(fn() -> Document),
}

/// The entry of a scene file in the gallery's folder.
macro_rules! file {
    ($name:literal, $description:literal) => {
        Entry {
            name: $name,
            description: $description,
            origin: Origin::Ron(include_str!(concat!("../gallery/", $name, ".ron"))),
        }
    };
}

/// All scenes, the default one first.
pub static GALLERY: &[Entry] = &[
    file!(
        "showcase",
        "a still life: mirror, glass, wine, cut solids and checkers under a spot light"
    ),
    file!("checker", "checkers over surfaces and through solids, nested"),
    file!("dice", "three dice, each a rounded cube less 21 balls"),
    file!("glass", "a ball, a hollow ball, a block and a bowl of clear and coloured glass"),
    file!("lens", "a reading glass over a printed page"),
    file!("lights", "a spot, a lamp and the moon; coloured glass stains the light"),
    file!("links", "three links that only hold together as three"),
    file!("mirrors", "two mirrors that face each other"),
    file!("rings", "rings, a bitten doughnut, apples, a bowl and a vase: tori and quadrics"),
    file!("solids", "one of each solid"),
    Entry {
        name: "sphereflake",
        description: "91 mirroring spheres, made at run time",
        origin: Origin::Made(|| sphereflake(2)),
    },
    file!("stress", "thin wires before a far planet, through a telescope of one degree"),
];

/// The entry of a name.
pub fn find(name: &str) -> Option<&'static Entry> {
    GALLERY.iter().find(|entry| entry.name == name)
}

impl Entry {
    /// The text of its scene file, if it has one.
    pub fn text(&self) -> Option<&'static str> {
        match self.origin {
            Origin::Ron(text) => Some(text),
            Origin::Made(_) => None,
        }
    }

    /// The scene as a document.
    ///
    /// # Errors
    /// If its file is not one.
    pub fn document(&self) -> Result<Document, Unreadable> {
        match self.origin {
            Origin::Ron(text) => read(text, Syntax::Ron),
            Origin::Made(make) => Ok(make()),
        }
    }
}

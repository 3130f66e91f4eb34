//! Scenes that come with the project.

use crate::document::Document;
use crate::knot::knot;
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
    file!("blob", "bears of jelly: balls and rounded cylinders that run into one another"),
    file!("checker", "checkers over surfaces and through solids, nested"),
    file!("dice", "three dice, each a rounded cube less 21 balls"),
    file!("glass", "a ball, a hollow ball, a block and a bowl of clear and coloured glass"),
    file!("globe", "a world from a small image under clouds of noise, its moon, and stars"),
    file!("gyroid", "a ball cut from a shell that parts space into two equal mazes"),
    Entry {
        name: "knot",
        description: "a trefoil knot cut open over dunes, and a cut gem: meshes made at run time",
        origin: Origin::Made(knot),
    },
    file!("lens", "a reading glass over a printed page"),
    file!("lights", "a spot, a lamp and the moon; coloured glass stains the light"),
    file!("links", "three links that only hold together as three"),
    file!("mirrors", "two mirrors that face each other"),
    file!(
        "orange",
        "oranges on oak planks: dents for a skin, wood in bricks, a gradient for the flesh"
    ),
    file!("solids", "one of each solid"),
    Entry {
        name: "sphereflake",
        description: "91 mirroring spheres, made at run time",
        origin: Origin::Made(|| sphereflake(2)),
    },
    file!("steel", "steel brushed along a plate, turned on a knob, blued on a bolt"),
    file!("stone", "a hall of three marbles, with a granite plinth and a ball of agate"),
    file!("stress", "thin wires before a far planet, through a telescope of one degree"),
    file!(
        "teapot",
        "Newell's teapot in celadon, of 32 Bézier patches, and a bowl that is a B-spline"
    ),
    file!("water", "a lake that mirrors a sky of noise, with waves and the rings around a post"),
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

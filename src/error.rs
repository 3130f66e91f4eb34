//! What can be wrong with a scene; found when it is built, never while it renders.

use core::fmt;

use crate::camera::CameraFlaw;
use crate::shape::{Flaw, ProgramFlaw};
use crate::span::Operator;

/// A part of a scene, by its place in its table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Item {
    /// A leaf or an operator.
    Node(u32),
    /// An object.
    Object(u32),
    /// A material.
    Material(u32),
    /// A texture.
    Texture(u32),
    /// A light.
    Light(u32),
    /// A placement.
    Placement(u32),
    /// The camera.
    Camera,
    /// The background.
    Background,
    /// The ambient light.
    Ambient,
    /// The depth control of a picture.
    Depth,
}

impl fmt::Display for Item {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Node(i) => write!(f, "node {i}"),
            Self::Object(i) => write!(f, "object {i}"),
            Self::Material(i) => write!(f, "material {i}"),
            Self::Texture(i) => write!(f, "texture {i}"),
            Self::Light(i) => write!(f, "light {i}"),
            Self::Placement(i) => write!(f, "placement {i}"),
            Self::Camera => f.write_str("camera"),
            Self::Background => f.write_str("background"),
            Self::Ambient => f.write_str("ambient"),
            Self::Depth => f.write_str("depth"),
        }
    }
}

/// Why a scene is refused, with the item and the field or limit concerned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SceneError {
    /// A number is infinite or not a number.
    NotFinite {
        /// Where.
        at: Item,
        /// Which parameter.
        field: &'static str,
    },
    /// A length is zero, negative, or too small to be squared.
    NotPositive {
        /// Where.
        at: Item,
        /// Which parameter.
        field: &'static str,
    },
    /// A coordinate or length is beyond the scalar's legal range.
    TooLarge {
        /// Where.
        at: Item,
        /// Which parameter.
        field: &'static str,
    },
    /// A parameter is outside the range that its meaning allows.
    OutOfRange {
        /// Where.
        at: Item,
        /// Which parameter.
        field: &'static str,
        /// What is allowed.
        allowed: &'static str,
    },
    /// A direction, an axis or an area has no extent.
    Empty {
        /// Where.
        at: Item,
        /// Which parameter.
        field: &'static str,
    },
    /// The greater corner of a box lies below the lesser one.
    Inverted {
        /// Where.
        at: Item,
        /// Which parameter.
        field: &'static str,
    },
    /// The vertices of a polygon do not lie in one plane, or its normal is not theirs.
    NotPlanar {
        /// Where.
        at: Item,
        /// Which parameter.
        field: &'static str,
    },
    /// A triangle of a mesh cannot be one of it.
    Triangle {
        /// Where.
        at: Item,
        /// Which triangle.
        triangle: u32,
        /// What is wrong with it.
        flaw: &'static str,
    },
    /// The hierarchy of a mesh is not one over its triangles.
    Hierarchy {
        /// Where.
        at: Item,
        /// The first node, counted from the root, whose box does not hold what is below it, or that hangs
        /// elsewhere than it says; the number of nodes if they hold too few triangles.
        branch: u32,
    },
    /// A placement flattens space, or its two matrices are not inverse to each other.
    SingularPlacement {
        /// Where.
        at: Item,
    },
    /// A shape that takes no placement has one.
    Placed {
        /// Where.
        at: Item,
    },
    /// A placed shape is not centred on its local origin.
    OffCentre {
        /// Where.
        at: Item,
        /// Which parameter.
        field: &'static str,
    },
    /// An index lies beyond the end of its table.
    IndexOutOfRange {
        /// Where.
        at: Item,
        /// Which table.
        table: &'static str,
        /// The index.
        index: u32,
        /// The entries of the table.
        len: u32,
    },
    /// A texture names itself or a later one.
    TextureOrder {
        /// The texture.
        at: Item,
        /// What it names.
        names: u32,
    },
    /// An operator has fewer operands than it needs.
    OperandUnderflow {
        /// The operator.
        at: Item,
        /// How many it has.
        operands: u32,
        /// How many it needs at least.
        least: u32,
    },
    /// An operator has more operands than it takes.
    OperandOverflow {
        /// The operator.
        at: Item,
        /// How many it takes.
        most: u32,
    },
    /// The size of an operator does not end with one of its operands.
    OperatorSize {
        /// The operator.
        at: Item,
        /// The size it states.
        size: u32,
    },
    /// The nodes of an object are not exactly one solid.
    StrayNodes {
        /// The object.
        at: Item,
        /// The first node too many or missing.
        node: u32,
    },
    /// Operators are nested deeper than the limit.
    TooDeep {
        /// The operator.
        at: Item,
        /// The greatest depth.
        limit: u32,
    },
    /// A solid may have more boundaries on a ray than there is room for.
    SpanOverflow {
        /// The object.
        at: Item,
        /// How many boundaries it may need.
        needed: u32,
        /// How many there is room for.
        limit: u32,
    },
    /// An open surface stands under an operator that needs an inside.
    OpenSurface {
        /// The leaf.
        at: Item,
        /// The operator.
        operator: Operator,
    },
    /// The program of an implicit solid is not one formula.
    Program {
        /// The leaf.
        at: Item,
        /// The operation, by its place among the bytes of the program.
        byte: u32,
        /// What is wrong there.
        what: &'static str,
    },
    /// The scene is made for certain needs, and this is not among them.
    NotNeeded {
        /// Where.
        at: Item,
        /// What.
        what: &'static str,
    },
    /// Stated bounds do not hold their object.
    BoundsTooSmall {
        /// The object.
        at: Item,
    },
    /// The ray stack is too small for the depth that is asked for.
    StackTooSmall {
        /// The depth.
        depth_max: u32,
        /// The entries of the stack; it needs `depth_max + 1`.
        limit: u32,
    },
    /// The picture has no pixels, or too many.
    PictureSize {
        /// The width in pixels.
        width: u32,
        /// The height in pixels.
        height: u32,
    },
    /// A table of the builder is full.
    Full {
        /// Which table.
        table: &'static str,
        /// Its capacity.
        capacity: u32,
    },
    /// `close` without an open operator, or a scene with one that was never closed.
    Unbalanced {
        /// The next node.
        at: Item,
    },
}

impl SceneError {
    /// What is wrong with a leaf; `index` is the last point it names, `len` how many there are.
    pub(crate) fn of_flaw(at: Item, flaw: Flaw, index: u32, len: u32) -> Self {
        match flaw {
            Flaw::NotFinite(field) => Self::NotFinite { at, field },
            Flaw::NotPositive(field) => Self::NotPositive { at, field },
            Flaw::TooLarge(field) => Self::TooLarge { at, field },
            Flaw::OutOfRange(field, allowed) => Self::OutOfRange { at, field, allowed },
            Flaw::Empty(field) => Self::Empty { at, field },
            Flaw::Inverted(field) => Self::Inverted { at, field },
            Flaw::NotPlanar(field) => Self::NotPlanar { at, field },
            Flaw::Triangle(triangle, flaw) => Self::Triangle { at, triangle, flaw },
            Flaw::Hierarchy(branch) => Self::Hierarchy { at, branch },
            Flaw::OffCentre(field) => Self::OffCentre { at, field },
            Flaw::Placed(_) => Self::Placed { at },
            Flaw::Index(_) => Self::IndexOutOfRange { at, table: "points", index, len },
            Flaw::Beyond { table, index, len } => Self::IndexOutOfRange { at, table, index, len },
            Flaw::Program(ProgramFlaw { byte, what }) => Self::Program { at, byte, what },
            Flaw::NotNeeded => Self::NotNeeded { at, what: "this solid" },
        }
    }

    pub(crate) fn of_camera(flaw: CameraFlaw) -> Self {
        let at = Item::Camera;
        match flaw {
            CameraFlaw::NotFinite(field) => Self::NotFinite { at, field },
            CameraFlaw::Empty(field) => Self::Empty { at, field },
            CameraFlaw::Range("fov") => {
                Self::OutOfRange { at, field: "fov", allowed: "between 0 and 180 degrees" }
            }
            CameraFlaw::Range(field) => Self::TooLarge { at, field },
        }
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { at, field } => write!(f, "{at}: {field} is not a finite number"),
            Self::NotPositive { at, field } => {
                write!(f, "{at}: {field} must be greater than 0, and large enough to square")
            }
            Self::TooLarge { at, field } => {
                write!(f, "{at}: {field} is beyond the range of this number format")
            }
            Self::OutOfRange { at, field, allowed } => write!(f, "{at}: {field} must be {allowed}"),
            Self::Empty { at, field } => write!(f, "{at}: {field} has no extent"),
            Self::Inverted { at, field } => write!(f, "{at}: {field} lies below its counterpart"),
            Self::NotPlanar { at, field } => write!(f, "{at}: {field} do not lie in one plane"),
            Self::Triangle { at, triangle, flaw } => write!(f, "{at}: triangle {triangle} {flaw}"),
            Self::Hierarchy { at, branch } => {
                write!(f, "{at}: the hierarchy does not fit the triangles (see its node {branch})")
            }
            Self::SingularPlacement { at } => write!(f, "{at}: the placement has no inverse"),
            Self::Placed { at } => write!(f, "{at}: this shape takes no placement"),
            Self::OffCentre { at, field } => {
                write!(f, "{at}: {field} of a placed shape must be the local origin")
            }
            Self::IndexOutOfRange { at, table, index, len } => {
                write!(f, "{at}: index {index} is beyond the {len} entries of {table}")
            }
            Self::TextureOrder { at, names } => {
                write!(f, "{at}: names texture {names}, but may only name earlier ones")
            }
            Self::OperandUnderflow { at, operands, least } => {
                write!(f, "{at}: has {operands} operands and needs at least {least}")
            }
            Self::OperandOverflow { at, most } => {
                write!(f, "{at}: takes at most {most} operands")
            }
            Self::OperatorSize { at, size } => {
                write!(f, "{at}: its size {size} does not end with one of its operands")
            }
            Self::StrayNodes { at, node } => {
                write!(f, "{at}: its nodes are not exactly one solid (see node {node})")
            }
            Self::TooDeep { at, limit } => {
                write!(f, "{at}: operators are nested deeper than {limit}")
            }
            Self::SpanOverflow { at, needed, limit } => {
                write!(f, "{at}: may need {needed} boundaries on a ray; there is room for {limit}")
            }
            Self::OpenSurface { at, operator } => {
                write!(f, "{at}: an open surface has no inside, as {operator:?} would need")
            }
            Self::Program { at, byte, what } => {
                write!(f, "{at}: byte {byte} of the program {what}")
            }
            Self::NotNeeded { at, what } => {
                write!(f, "{at}: the scene is made for certain needs, and {what} is not among them")
            }
            Self::BoundsTooSmall { at } => write!(f, "{at}: the stated bounds do not hold it"),
            Self::StackTooSmall { depth_max, limit } => {
                write!(f, "depth {depth_max} needs a larger ray stack than {limit} entries")
            }
            Self::PictureSize { width, height } => {
                write!(f, "a picture cannot be {width} by {height} pixels")
            }
            Self::Full { table, capacity } => {
                write!(f, "there are more {table} than the {capacity} there is room for")
            }
            Self::Unbalanced { at } => {
                write!(f, "{at}: operators are not opened and closed in pairs")
            }
        }
    }
}

impl core::error::Error for SceneError {}

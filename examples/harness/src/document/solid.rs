//! The solids of a scene file.

use std::path::Path;

use serde::Deserialize;

use super::upward;
use crate::written::{Factor, Several, Triple, present};

/// A solid with its material and its place.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Object {
    /// What it is.
    pub solid: Solid,
    /// The name of the material that fills it and covers what has none of its own; that of the
    /// first part of the solid if left out.
    #[serde(default, deserialize_with = "present")]
    pub material: Option<String>,
    /// Where it stands: moves, applied in order.
    #[serde(default)]
    pub place: Vec<Move>,
}

/// A solid.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Solid {
    /// A ball.
    Sphere {
        /// The middle.
        center: Triple,
        /// The radius.
        radius: f64,
    },
    /// The half-space `normal · p ≤ offset`.
    Plane {
        /// The outward normal, of any length but 0.
        normal: Triple,
        /// `normal · p` for a point of the plane.
        offset: f64,
    },
    /// A box along the axes.
    Box {
        /// The least coordinates.
        min: Triple,
        /// The greatest coordinates.
        max: Triple,
    },
    /// A cylinder between the middles of its caps.
    Cylinder {
        /// The middle of the lower cap.
        base: Triple,
        /// The middle of the upper cap.
        top: Triple,
        /// The radius.
        radius: f64,
    },
    /// A cone or frustum between the middles of its caps.
    Cone {
        /// The middle of the lower cap.
        base: Triple,
        /// The radius of the lower cap.
        base_radius: f64,
        /// The middle of the upper cap.
        top: Triple,
        /// The radius of the upper cap.
        top_radius: f64,
    },
    /// A torus; where `minor` is greater than `major`, a filled spindle.
    Torus {
        /// The middle.
        center: Triple,
        /// The axis that it lies around, of any length but 0; +y if left out.
        #[serde(default = "upward")]
        axis: Triple,
        /// The distance of the middle of the tube from the axis.
        major: f64,
        /// The radius of the tube.
        minor: f64,
    },
    /// A surface of revolution about the y axis.
    Lathe {
        /// The origin of the profile's plane; that of the scene if left out.
        #[serde(default)]
        center: Triple,
        /// What is turned about the axis.
        profile: Profile,
    },
    /// A polygon in the plane of x and z, drawn out upward from there.
    Prism {
        /// The vertices, each an x and a z.
        vertices: Vec<Several<f64, 2>>,
        /// The height.
        height: f64,
    },
    /// Where a polynomial of the second degree is not positive; what is left out of it is 0.
    Quadric {
        /// The origin of its coordinates; that of the scene if left out.
        #[serde(default)]
        center: Triple,
        /// The coefficients of x², y² and z².
        #[serde(default)]
        squares: Triple,
        /// The coefficients of xy, yz and zx.
        #[serde(default)]
        products: Triple,
        /// The coefficients of x, y and z.
        #[serde(default)]
        linear: Triple,
        /// What is left where all three are 0.
        #[serde(default)]
        constant: f64,
    },
    /// A triangle, an open surface.
    Triangle {
        /// The first corner; the three are counterclockwise from outside.
        a: Triple,
        /// The second corner.
        b: Triple,
        /// The third corner.
        c: Triple,
        /// The normals that light sees at the corners, if it is to look curved.
        #[serde(default, deserialize_with = "present")]
        normals: Option<Several<Triple, 3>>,
    },
    /// A plane polygon, an open surface: vertices counterclockwise from outside.
    Polygon(Vec<Triple>),
    /// Where a formula of x, y and z is less than 0, within a box.
    Implicit {
        /// The least coordinates of the box.
        min: Triple,
        /// The greatest coordinates of the box.
        max: Triple,
        /// The formula: `x`, `y`, `z`, `pi` and numbers; `+ − * /`, `^` with a whole exponent,
        /// brackets; `sqrt`, `abs`, `sin`, `cos`, `length`, `min`, `max`, `pow(a, e)` for the magnitude of a to the
        /// power e; `smin(a, b, k)` and `smax(a, b, k)`, rounded off where a and b differ by less than k.
        expr: String,
        /// The most spans along a ray: where there would be more, the last one goes on to the last exit.
        /// What follows from the degrees of the polynomials in the formula if left out; with
        /// roots, sines, real powers and divisors that are no numbers it must be given.
        #[serde(default, deserialize_with = "present")]
        spans: Option<u16>,
    },
    /// Where the fields of some components add up to more than a threshold.
    Blob {
        /// The threshold, greater than 0.
        threshold: f64,
        /// The components.
        components: Vec<Component>,
    },
    /// Triangles that share points, from a file or as they are written here; an open surface or a solid.
    Mesh {
        /// A file in OBJ format, beside the scene file.
        #[serde(default, deserialize_with = "present")]
        file: Option<String>,
        /// The points.
        #[serde(default)]
        points: Vec<Triple>,
        /// Three points for each triangle, from 0 on, counterclockwise from outside.
        #[serde(default)]
        triangles: Vec<Several<u32, 3>>,
        /// The normals that light sees, one for each point.
        #[serde(default)]
        normals: Vec<Triple>,
        /// The texture coordinates, one pair for each point.
        #[serde(default)]
        uvs: Vec<Several<f64, 2>>,
        /// It is a solid; not if left out.
        #[serde(default)]
        closed: bool,
        /// It is to look curved where it has no normals; not if left out.
        #[serde(default)]
        smooth: bool,
    },
    /// Heights over a rectangle; an open surface, or a solid if it has a base.
    HeightField {
        /// The least x and z.
        min: Several<f64, 2>,
        /// The greatest x and z.
        max: Several<f64, 2>,
        /// How many heights there are along x.
        columns: u32,
        /// The heights, row by row of growing z.
        heights: Vec<f64>,
        /// How far down it goes.
        #[serde(default, deserialize_with = "present")]
        base: Option<f64>,
        /// It is to look curved; not if left out.
        #[serde(default)]
        smooth: bool,
    },
    /// A bicubic Bézier patch, an open surface: four rows of four control points.
    Patch(Box<Several<Several<Triple, 4>, 4>>),
    /// Bicubic Bézier patches that share control points, an open surface.
    Patches {
        /// The control points.
        points: Vec<Triple>,
        /// The sixteen control points of each patch, row by row, counted from 0.
        patches: Vec<Several<u32, 16>>,
    },
    /// A uniform bicubic B-spline, an open surface.
    Spline {
        /// The control points, row by row: at least 4 rows of at least 4, or 3 in a direction that is closed.
        points: Vec<Vec<Triple>>,
        /// Rows are closed curves; columns are. Neither if left out.
        #[serde(default = "open")]
        closed: Several<bool, 2>,
    },
    /// In any of them.
    Union(Vec<Self>),
    /// In all of them.
    Intersection(Vec<Self>),
    /// In the first and in none of the others.
    Difference(Vec<Self>),
    /// In an odd number of them.
    Xor(Vec<Self>),
    /// Not in it.
    Complement(Box<Self>),
    /// A solid with its own material or place.
    With {
        /// The solid.
        solid: Box<Self>,
        /// The name of its material; the one around it if left out.
        #[serde(default, deserialize_with = "present")]
        material: Option<String>,
        /// Where it stands: moves, applied in order and before those around it.
        #[serde(default)]
        place: Vec<Move>,
    },
}

/// A component of a blob: its field is its strength in the middle and 0 from its radius on.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Component {
    /// About a point.
    Sphere {
        /// The middle.
        center: Triple,
        /// The radius.
        radius: f64,
        /// The strength, which may be negative; 1 if left out.
        #[serde(default = "one")]
        strength: f64,
    },
    /// About a line from end to end, and round beyond.
    Cylinder {
        /// One end.
        base: Triple,
        /// The other.
        top: Triple,
        /// The radius.
        radius: f64,
        /// The strength, which may be negative; 1 if left out.
        #[serde(default = "one")]
        strength: f64,
    },
}

fn one() -> f64 {
    1.0
}

/// The profile of a surface of revolution: points with their distance from the axis and their height.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Profile {
    /// Points joined by lines.
    Linear(Vec<Several<f64, 2>>),
    /// The control points of cubic curves.
    Bezier(Vec<Several<f64, 2>>),
    /// Points joined by a smooth curve.
    CatmullRom(Vec<Several<f64, 2>>),
}

fn open() -> Several<bool, 2> {
    Several([false; 2])
}

/// One step of a placement.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Move {
    /// By a vector.
    Translate(Triple),
    /// By a factor, or by one along each axis.
    Scale(Factor),
    /// Right-handed about the x axis, in degrees.
    RotateX(f64),
    /// Right-handed about the y axis, in degrees.
    RotateY(f64),
    /// Right-handed about the z axis, in degrees.
    RotateZ(f64),
    /// Right-handed about any axis through the origin.
    Rotate {
        /// The axis, of any length but 0.
        axis: Triple,
        /// The angle in degrees.
        degrees: f64,
    },
}

impl Solid {
    /// Takes the names of files to be those of files in a folder.
    pub(crate) fn in_folder(&mut self, folder: &Path) {
        let mut waiting = vec![self];
        while let Some(solid) = waiting.pop() {
            match solid {
                Self::Mesh { file: Some(file), .. } => {
                    *file = folder.join(&*file).display().to_string();
                }
                Self::Union(operands)
                | Self::Intersection(operands)
                | Self::Difference(operands)
                | Self::Xor(operands) => waiting.extend(operands),
                Self::Complement(operand) => waiting.push(operand),
                Self::With { solid, .. } => waiting.push(solid),
                _ => {}
            }
        }
    }
}

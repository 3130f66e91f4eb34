//! The solids: one file per family, each with all that it knows.
//!
//! | shape | method |
//! | --- | --- |
//! | [`Sphere`], ellipsoid | recentred without cancellation, then solved in place |
//! | [`Plane`] | one division, refined where the normal is oblique |
//! | [`Cuboid`] | slabs with the reciprocals of the ray, parallel rays apart, ties decided exactly |
//! | [`Cylinder`] | recentred, a disc in the plane across the axis, clipped by its caps |
//! | [`Cone`] | recentred, the discriminant as a sum of squares; one nappe, clipped by its caps |
//! | [`Torus`] | recentred, cut into monotone pieces by the derivative of its quartic, refined on its distance |
//! | [`Lathe`] | pieces counted by the signs at their ends; frusta as cones, cubics by a polynomial of degree 6 |
//! | [`Prism`] | edges counted by the sides of the ray on which their ends lie; clipped by its caps |
//! | [`Quadric`] | recentred, the two roots of its polynomial along the ray without cancellation |
//! | [`Triangle`] | watertight edge functions in the space of the ray |
//! | [`Polygon`] | the same edge functions, counted along a half-line; concave allowed |
//! | [`Implicit`] | intervals of the formula and of its slope, halved until each proves its roots |
//! | [`Blob`] | quartics between the breakpoints of its components, all their roots isolated |
//! | [`Mesh`] | the same again, under a hierarchy of boxes; open or closed |
//! | [`Patches`] | subdivided across the ray until at most one root is left, then Newton |

mod any;
mod blob;
mod cone;
mod crossings;
mod cuboid;
mod cylinder;
mod implicit;
mod lathe;
mod mesh;
mod outline;
mod patch;
mod plane;
mod polygon;
mod prism;
mod quadric;
mod sphere;
mod torus;
mod triangle;

pub use any::Shape;
pub use blob::Blob;
pub use cone::Cone;
pub use cuboid::Cuboid;
pub use cylinder::Cylinder;
pub use implicit::{Implicit, ProgramFlaw, program};
pub use lathe::{Curve, Filled, Lathe};
pub use mesh::Mesh;
pub use patch::Patches;
pub use plane::Plane;
pub use polygon::Polygon;
pub use prism::{Prism, Winding};
pub use quadric::Quadric;
pub use sphere::Sphere;
pub use torus::Torus;
pub use triangle::Triangle;

use crate::bounds::Bounds;
use crate::hierarchy::Branch;
use crate::place::Placement;
use crate::ray::{Line, Start};
use crate::scalar::{Number, Real, Scalar, Vector};
use crate::span::{End, Passage, Span};

/// A ray as one leaf sees it.
#[derive(Clone, Copy, Debug)]
pub struct Sight<'a, S: Scalar> {
    /// The ray.
    pub line: &'a Line<S>,
    /// The leaf's own coordinates, if they are not the scene's.
    pub place: Option<&'a Placement<S>>,
    /// The ray starts on this leaf.
    pub start: Option<&'a Start<S>>,
    /// What the shapes of the scene refer to.
    pub tables: &'a Tables<'a, S>,
}

/// What shapes refer to by index, because it has no fixed size.
#[derive(Clone, Copy, Debug)]
pub struct Tables<'a, S: Scalar> {
    /// Vertices, normals and control points.
    pub points: &'a [S::Vec3],
    /// Strengths, coefficients and other numbers.
    pub numbers: &'a [S],
    /// Indices of points, and of other indices.
    pub indices: &'a [u32],
    /// Programs.
    pub code: &'a [u8],
    /// Hierarchies over what shapes are made of.
    pub branches: &'a [Branch<S>],
}

impl<S: Scalar> Tables<'_, S> {
    /// Nothing.
    pub const EMPTY: Self =
        Self { points: &[], numbers: &[], indices: &[], code: &[], branches: &[] };
}

/// What is wrong with a shape's parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flaw {
    /// A parameter is infinite or not a number.
    NotFinite(&'static str),
    /// A parameter must be greater than 0, and large enough to square.
    NotPositive(&'static str),
    /// A parameter is beyond the legal range.
    TooLarge(&'static str),
    /// A parameter is not what its meaning allows: which, and what is allowed.
    OutOfRange(&'static str, &'static str),
    /// A direction or an extent has no length.
    Empty(&'static str),
    /// The upper bound lies below the lower one.
    Inverted(&'static str),
    /// An index lies beyond the end of a table.
    Index(&'static str),
    /// An index lies beyond the end of a table, which is named, with its length.
    Beyond {
        /// The name of the table.
        table: &'static str,
        /// The index.
        index: u32,
        /// How many entries the table has.
        len: u32,
    },
    /// The vertices do not lie in one plane.
    NotPlanar(&'static str),
    /// A triangle of a mesh cannot be one of it; what it does is told.
    Triangle(u32, &'static str),
    /// A node of a hierarchy does not hold what is below it, or does not hang where it says.
    Hierarchy(u32),
    /// A placed shape must have its centre at the local origin.
    OffCentre(&'static str),
    /// The shape is given in the scene's coordinates and takes no placement.
    Placed(&'static str),
    /// A program is not a formula.
    Program(ProgramFlaw),
    /// The scene is made for other solids only.
    NotNeeded,
}

/// What every solid can tell. Local coordinates are the scene's, moved to [`centre`](Self::centre),
/// or those of the leaf's placement.
pub trait Primitive<S: Scalar> {
    /// Where the local coordinates of an unplaced shape have their origin.
    fn centre(&self) -> S::Vec3;
    /// Whether every parameter is legal.
    ///
    /// # Errors
    /// The first parameter that is not.
    fn check(&self, placed: bool, tables: &Tables<'_, S>) -> Result<(), Flaw>;
    /// A box around the shape.
    fn bounds(&self, place: Option<&Placement<S>>, tables: &Tables<'_, S>) -> Bounds<S>;
    /// Gives each span of the ray inside the shape, in ascending order, behind the origin too.
    /// Of a ray that starts on the shape's own surface only what lies ahead is given.
    ///
    /// A ray in a flat face is inside; one that only touches a curved side or an edge is not.
    /// A component of the direction whose reciprocal is infinite counts as 0.
    fn spans(&self, sight: &Sight<'_, S>, emit: impl FnMut(Span<S>));
    /// The same, but only the boundaries up to `until` are asked for: of what lies beyond it is
    /// enough that it lies beyond. Where boundaries are dear, what is left out is work.
    #[inline]
    fn spans_until(&self, sight: &Sight<'_, S>, _: S, emit: impl FnMut(Span<S>)) {
        self.spans(sight, emit);
    }
    /// The same of a part of the ray: only the boundaries after its start and up to its end are asked for, and
    /// whether its start is inside.
    #[inline]
    fn spans_within(&self, sight: &Sight<'_, S>, window: [S; 2], emit: impl FnMut(Span<S>)) {
        let [_, until] = window;
        self.spans_until(sight, until, emit);
    }
    /// Whether a place of the ray is inside, and the first boundary after it and before another.
    #[inline]
    fn first(
        &self,
        sight: &Sight<'_, S>,
        [after, before]: [S; 2],
        open: bool,
    ) -> (bool, Option<(End<S>, Passage)>) {
        let (mut inside, mut first) = (false, None);
        self.spans_until(sight, before, |span| {
            let mut offer = |end: End<S>, passage: Passage| {
                if end.t > after && end.t < before && first.is_none() {
                    first = Some((end, passage));
                }
            };
            if open {
                offer(span.enter, Passage::Touch);
            } else {
                let span = span.solid();
                inside |= span.enter.t <= after && after < span.exit.t;
                offer(span.enter, Passage::Enter);
                offer(span.exit, Passage::Leave);
            }
        });
        (inside, first)
    }
    /// The point of a face nearest to a local point close to it.
    fn snap(&self, local: S::WideVec, face: u32, tables: &Tables<'_, S>) -> S::Vec3;
    /// The outward normal at a local point of a face, not of unit length; never zero.
    fn normal(&self, local: S::Vec3, face: u32, tables: &Tables<'_, S>) -> S::WideVec;
    /// The outward normal that light sees at a local point of a face, where it is not the true one;
    /// not of unit length.
    fn shading_normal(&self, _: S::Vec3, _: u32, _: &Tables<'_, S>) -> Option<S::WideVec> {
        None
    }
    /// The texture coordinates of a local point of a face.
    fn uv(&self, local: S::Vec3, face: u32, tables: &Tables<'_, S>) -> [S; 2];
}

fn check_point<S: Scalar>(p: S::Vec3, field: &'static str) -> Result<(), Flaw> {
    if !p.is_finite() {
        Err(Flaw::NotFinite(field))
    } else if p.max_abs() > S::COORD_MAX {
        Err(Flaw::TooLarge(field))
    } else {
        Ok(())
    }
}

fn check_direction<S: Scalar>(dir: S::Dir, field: &'static str) -> Result<(), Flaw> {
    let size = S::widen_dir(dir).max_abs();
    if !dir.is_finite() {
        Err(Flaw::NotFinite(field))
    } else if size > S::COORD_MAX.widen() {
        Err(Flaw::TooLarge(field))
    } else if size < S::LENGTH_MIN.widen() {
        Err(Flaw::Empty(field))
    } else {
        Ok(())
    }
}

fn check_length<S: Scalar>(length: S, field: &'static str) -> Result<(), Flaw> {
    if !length.is_finite() {
        Err(Flaw::NotFinite(field))
    } else if length < S::LENGTH_MIN {
        Err(Flaw::NotPositive(field))
    } else if length > S::COORD_MAX {
        Err(Flaw::TooLarge(field))
    } else {
        Ok(())
    }
}

fn check_centre<S: Scalar>(centre: S::Vec3, placed: bool) -> Result<(), Flaw> {
    check_point::<S>(centre, "center")?;
    if placed && centre != S::Vec3::ZERO { Err(Flaw::OffCentre("center")) } else { Ok(()) }
}

fn unplaced(placed: bool, field: &'static str) -> Result<(), Flaw> {
    if placed { Err(Flaw::Placed(field)) } else { Ok(()) }
}

/// The angle of (x, z) around the y axis as a fraction of a turn, in 0..=1.
fn turn<S: Scalar>(x: S, z: S) -> S {
    let angle = z.widen().atan2(x.widen());
    S::narrow(angle / (S::Wide::PI * S::Wide::TWO) + S::Wide::HALF)
}

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

/// Any of the solids.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape<S: Scalar> {
    /// A ball; an ellipsoid when placed with unequal scales.
    Sphere(Sphere<S>),
    /// A half-space.
    Plane(Plane<S>),
    /// A box.
    Box(Cuboid<S>),
    /// A cylinder with its caps.
    Cylinder(Cylinder<S>),
    /// A cone or frustum with its caps.
    Cone(Cone<S>),
    /// A torus.
    Torus(Torus<S>),
    /// A surface of revolution, closed or open.
    Lathe(Lathe<S>),
    /// An extruded polygon.
    Prism(Prism<S>),
    /// The inside of a quadric.
    Quadric(Quadric<S>),
    /// A triangle, an open surface.
    Triangle(Triangle),
    /// A plane polygon, an open surface.
    Polygon(Polygon<S>),
    /// Where a formula is less than 0, within a box.
    Implicit(Implicit<S>),
    /// Metaballs whose fields add up.
    Blob(Blob<S>),
    /// Many triangles, open or closed.
    Mesh(Mesh),
    /// Bicubic Bézier patches, an open surface.
    Patches(Patches<S>),
}

macro_rules! each {
    ($shape:expr, $inner:ident => $body:expr) => {
        match $shape {
            Shape::Sphere($inner) => $body,
            Shape::Plane($inner) => $body,
            Shape::Box($inner) => $body,
            Shape::Cylinder($inner) => $body,
            Shape::Cone($inner) => $body,
            Shape::Torus($inner) => $body,
            Shape::Lathe($inner) => $body,
            Shape::Prism($inner) => $body,
            Shape::Quadric($inner) => $body,
            Shape::Triangle($inner) => $body,
            Shape::Polygon($inner) => $body,
            Shape::Implicit($inner) => $body,
            Shape::Blob($inner) => $body,
            Shape::Mesh($inner) => $body,
            Shape::Patches($inner) => $body,
        }
    };
}

impl<S: Scalar> Shape<S> {
    /// A surface without an inside.
    pub const fn is_open(&self) -> bool {
        match self {
            Self::Triangle(_) | Self::Polygon(_) | Self::Patches(_) => true,
            Self::Lathe(lathe) => lathe.is_open(),
            Self::Mesh(mesh) => !mesh.closed,
            _ => false,
        }
    }

    /// The greatest number of spans along any ray.
    ///
    /// Nothing less is certain of a mesh than that a ray meets each triangle once.
    pub const fn spans_max(&self) -> u32 {
        match self {
            Self::Sphere(_) | Self::Plane(_) | Self::Box(_) | Self::Cylinder(_) | Self::Cone(_) => {
                1
            }
            Self::Torus(_) | Self::Quadric(_) => 2,
            Self::Lathe(lathe) => lathe.spans_max() as u32,
            Self::Prism(prism) => prism.spans_max() as u32,
            Self::Triangle(_) | Self::Polygon(_) => 1,
            Self::Implicit(implicit) => implicit.spans as u32,
            Self::Blob(blob) => blob.spans_max(),
            Self::Mesh(mesh) if mesh.closed => mesh.triangles / 2,
            Self::Mesh(mesh) => mesh.triangles,
            Self::Patches(patches) => patches.hits_max() as u32,
        }
    }

    /// The greatest number of boundaries along any ray.
    pub const fn boundaries_max(&self) -> u32 {
        match self {
            Self::Mesh(mesh) => mesh.triangles,
            // An open surface: each is a touch.
            Self::Patches(patches) => patches.hits_max() as u32,
            _ => 2 * self.spans_max(),
        }
    }

    /// Where the local coordinates of an unplaced shape have their origin.
    #[inline]
    pub fn centre(&self) -> S::Vec3 {
        each!(self, shape => Primitive::<S>::centre(shape))
    }

    /// Whether every parameter is legal.
    ///
    /// # Errors
    /// The first parameter that is not.
    pub fn check(&self, placed: bool, tables: &Tables<'_, S>) -> Result<(), Flaw> {
        each!(self, shape => Primitive::<S>::check(shape, placed, tables))
    }

    /// A box around the shape, infinite for a half-space.
    pub fn bounds(&self, place: Option<&Placement<S>>, tables: &Tables<'_, S>) -> Bounds<S> {
        each!(self, shape => Primitive::<S>::bounds(shape, place, tables))
    }

    /// Gives each span of the ray inside the shape, in ascending order, behind the origin too.
    /// Of a ray that starts on the shape's own surface only what lies ahead is given.
    ///
    /// A ray in a flat face is inside; one that only touches a curved side or an edge is not.
    /// A component of the direction whose reciprocal is infinite counts as 0. No span is empty:
    /// one that is shorter than the numbers are apart ends at the next number.
    #[inline]
    pub fn spans(&self, sight: &Sight<'_, S>, emit: impl FnMut(Span<S>)) {
        self.spans_until(sight, S::FAR, emit);
    }

    /// The same, but only the boundaries up to `until` are asked for: others may be missing, or lie
    /// elsewhere beyond it.
    #[inline]
    pub fn spans_until(&self, sight: &Sight<'_, S>, until: S, emit: impl FnMut(Span<S>)) {
        self.spans_within(sight, [-S::FAR, until], emit);
    }

    /// The same of a part of the ray: only the boundaries after its start and up to its end are asked for, and
    /// whether its start is inside.
    #[inline]
    pub(crate) fn spans_within(
        &self,
        sight: &Sight<'_, S>,
        window: [S; 2],
        mut emit: impl FnMut(Span<S>),
    ) {
        let open = self.is_open();
        let emit = |span: Span<S>| emit(if open { span } else { span.solid() });
        each!(self, shape => Primitive::<S>::spans_within(shape, sight, window, emit));
    }

    /// Whether a place of the ray is inside, and the first boundary after it and before another.
    #[inline]
    pub(crate) fn first(
        &self,
        sight: &Sight<'_, S>,
        window: [S; 2],
    ) -> (bool, Option<(End<S>, Passage)>) {
        let open = self.is_open();
        each!(self, shape => Primitive::<S>::first(shape, sight, window, open))
    }

    /// The point of a face nearest to a local point close to it.
    #[inline]
    pub fn snap(&self, local: S::WideVec, face: u32, tables: &Tables<'_, S>) -> S::Vec3 {
        each!(self, shape => Primitive::<S>::snap(shape, local, face, tables))
    }

    /// The outward normal at a local point of a face, not of unit length.
    #[inline]
    pub fn normal(&self, local: S::Vec3, face: u32, tables: &Tables<'_, S>) -> S::WideVec {
        each!(self, shape => Primitive::<S>::normal(shape, local, face, tables))
    }

    /// The outward normal that light sees at a local point of a face, where it is not the true one;
    /// not of unit length.
    #[inline]
    pub fn shading_normal(
        &self,
        local: S::Vec3,
        face: u32,
        tables: &Tables<'_, S>,
    ) -> Option<S::WideVec> {
        each!(self, shape => Primitive::<S>::shading_normal(shape, local, face, tables))
    }

    /// The texture coordinates of a local point of a face.
    pub fn uv(&self, local: S::Vec3, face: u32, tables: &Tables<'_, S>) -> [S; 2] {
        each!(self, shape => Primitive::<S>::uv(shape, local, face, tables))
    }
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

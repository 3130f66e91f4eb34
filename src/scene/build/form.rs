//! Shapes as people describe them.

use crate::scalar::Scalar;

/// A shape as people describe it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form<'a, S: Scalar> {
    /// A ball.
    Sphere {
        /// The middle.
        center: S::Vec3,
        /// The radius.
        radius: S,
    },
    /// The half-space `normal · p ≤ offset`.
    Plane {
        /// The outward normal, of any length but 0.
        normal: S::Vec3,
        /// `normal · p` for a point of the plane.
        offset: S,
    },
    /// A box along the axes.
    Box {
        /// The least coordinates.
        min: S::Vec3,
        /// The greatest coordinates.
        max: S::Vec3,
    },
    /// A cylinder between the middles of its caps.
    Cylinder {
        /// The middle of the lower cap.
        base: S::Vec3,
        /// The middle of the upper cap.
        top: S::Vec3,
        /// The radius.
        radius: S,
    },
    /// A cone or frustum between the middles of its caps.
    Cone {
        /// The middle of the lower cap.
        base: S::Vec3,
        /// The radius of the lower cap; may be 0.
        base_radius: S,
        /// The middle of the upper cap.
        top: S::Vec3,
        /// The radius of the upper cap; may be 0.
        top_radius: S,
    },
    /// A torus.
    Torus {
        /// The middle.
        center: S::Vec3,
        /// The axis that it lies around, of any length but 0.
        axis: S::Vec3,
        /// The distance of the middle of the tube from the axis.
        major: S,
        /// The radius of the tube; where it is greater than the other the solid is a filled spindle.
        minor: S,
    },
    /// A surface of revolution about the y axis through a point.
    Lathe {
        /// The origin of the profile's plane.
        center: S::Vec3,
        /// What is turned about the axis.
        profile: Profile<'a, S>,
    },
    /// A polygon in the plane of x and z, drawn out upward from there: a prism.
    Prism {
        /// The vertices, each an x and a z; in either order around.
        vertices: &'a [[S; 2]],
        /// The height, greater than 0.
        height: S,
    },
    /// Where a polynomial of the second degree is not positive, in coordinates from a point on.
    Quadric {
        /// The origin of these coordinates.
        center: S::Vec3,
        /// The coefficients of x², y² and z².
        squares: S::Vec3,
        /// The coefficients of xy, yz and zx.
        products: S::Vec3,
        /// The coefficients of x, y and z.
        linear: S::Vec3,
        /// What is left where all three are 0.
        constant: S,
    },
    /// A triangle, an open surface.
    Triangle {
        /// The corners, counterclockwise from outside.
        corners: [S::Vec3; 3],
        /// The normals that light sees at the corners, if the triangle is to look curved.
        normals: Option<[S::Vec3; 3]>,
    },
    /// A plane polygon, convex or not, an open surface.
    Polygon {
        /// The vertices, counterclockwise from outside.
        vertices: &'a [S::Vec3],
    },
    /// Where a formula is less than 0, within a box.
    Implicit {
        /// The least corner of the box.
        min: S::Vec3,
        /// The greatest corner of the box.
        max: S::Vec3,
        /// The formula, as a [program](crate::shape::program).
        code: &'a [u8],
        /// The numbers of the program.
        numbers: &'a [S],
        /// The most spans along a ray. Without it the bound that follows from the degrees of
        /// the polynomials that the formula is made of, where it is made of polynomials. Where there
        /// would be more, the last one goes on to the last exit.
        spans: Option<u16>,
    },
    /// Where the fields of some components add up to more than a threshold.
    Blob {
        /// The threshold, greater than 0.
        threshold: S,
        /// The components, at least one, and one at least of positive strength.
        components: &'a [Metaball<S>],
    },
    /// Triangles that share vertices, an open surface or a closed solid.
    Mesh(Triangles<'a, S>),
    /// Heights over a rectangle, an open surface or a closed solid; it becomes a mesh.
    HeightField(Heights<'a, S>),
    /// Bicubic Bézier patches that may share control points, an open surface. The scene needs room for the control
    /// points, two more for each patch, and 16 indices for each patch.
    Patches {
        /// The control points.
        points: &'a [S::Vec3],
        /// The control points of each patch: four rows of four along u, one after another along v. Its outer
        /// side is that of ∂/∂u × ∂/∂v.
        patches: &'a [[u32; 16]],
    },
    /// A uniform bicubic B-spline, an open surface. It becomes patches, one for each four rows of four points that follow
    /// one another, with three times as many control points either way.
    Spline {
        /// The control points, row by row.
        points: &'a [S::Vec3],
        /// How many make a row: at least 4, or 3 where rows are closed. There are at least 4 rows, or 3 where columns
        /// are closed.
        columns: u32,
        /// Rows are closed curves; columns are.
        closed: [bool; 2],
    },
}

/// The profile of a surface of revolution: points with their distance from the axis and their height. If it
/// begins and ends on the axis, or begins where it ends, it makes a solid, and else an open surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Profile<'a, S> {
    /// Points joined by lines.
    Linear(&'a [[S; 2]]),
    /// Cubic Bézier curves by their control points: the first point, and three more for each curve.
    Bezier(&'a [[S; 2]]),
    /// Points joined by a smooth curve, Catmull and Rom's uniform spline. It meets the axis at a right angle,
    /// and goes smoothly on where it begins and ends in one place.
    ///
    /// Source: E. Catmull and R. Rom, "A class of local interpolating splines" (1974).
    CatmullRom(&'a [[S; 2]]),
}

/// A component of a blob: a ball or a cylinder with round ends, whose field is `strength·(1 − r²/radius²)²` in
/// the distance r from its centre or axis, up to its radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metaball<S: Scalar> {
    /// The ends of the axis; equal, they are the centre of a ball.
    pub ends: [S::Vec3; 2],
    /// How far the field reaches, greater than 0.
    pub radius: S,
    /// The field in the middle; where it is negative, the component takes away.
    pub strength: S,
}

impl<S: Scalar> Metaball<S> {
    /// A ball.
    pub const fn ball(center: S::Vec3, radius: S, strength: S) -> Self {
        Self { ends: [center; 2], radius, strength }
    }

    /// A cylinder with round ends.
    pub const fn cylinder(base: S::Vec3, top: S::Vec3, radius: S, strength: S) -> Self {
        Self { ends: [base, top], radius, strength }
    }
}

/// Values of the corners of triangles: a table of them, and for each triangle which three it has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corners<'a, T> {
    /// The values.
    pub values: &'a [T],
    /// Three indices into the values for each triangle, in the order of the triangles.
    pub triangles: &'a [[u32; 3]],
}

/// Triangles that share vertices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangles<'a, S: Scalar> {
    /// The corners, counterclockwise from outside.
    pub points: Corners<'a, S::Vec3>,
    /// The normals that light sees at the corners, if the surface is to look curved.
    pub normals: Option<Corners<'a, S::Vec3>>,
    /// The texture coordinates of the corners; without them a triangle has its own.
    pub uvs: Option<Corners<'a, [S; 2]>>,
    /// It is a solid: every edge is one of two triangles, which go along it in opposite directions.
    /// Triangles that all run clockwise are turned round.
    pub closed: bool,
}

/// Heights along y over a grid of points in the plane of x and z, with two triangles to a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heights<'a, S: Scalar> {
    /// The least x and z.
    pub min: [S; 2],
    /// The greatest x and z.
    pub max: [S; 2],
    /// How many points there are along x, at least two.
    pub columns: u32,
    /// The heights, one row of points along x after another, at least two rows, by growing z.
    pub heights: &'a [S],
    /// How far down a solid goes; without it there is only the surface.
    pub base: Option<S>,
    /// The surface is to look curved.
    pub smooth: bool,
}

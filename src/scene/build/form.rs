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

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

//! A shape of a document in the words of the scene builder.

mod mesh;

use nostray::{Form, Heights, Scalar};

use crate::assemble::vector;
use crate::document::Solid;
use crate::flaw::{Flaw, Path};

/// What a form borrows: the lists of a shape, in the number format of the scene.
pub(crate) struct Stock<S: Scalar> {
    points: Vec<S::Vec3>,
    numbers: Vec<S>,
    mesh: mesh::Lists<S>,
}

impl<S: Scalar> Default for Stock<S> {
    fn default() -> Self {
        Self { points: Vec::new(), numbers: Vec::new(), mesh: mesh::Lists::default() }
    }
}

impl<S: Scalar> Stock<S> {
    /// The name of a shape as files spell it, and its form.
    pub(crate) fn form(
        &mut self,
        leaf: &Solid,
        path: &Path<'_>,
    ) -> Result<(&'static str, Form<'_, S>), Flaw> {
        let v = vector::<S>;
        let s = S::from_f64;
        Ok(match *leaf {
            Solid::Sphere { center, radius } => {
                ("Sphere", Form::Sphere { center: v(center), radius: s(radius) })
            }
            Solid::Plane { normal, offset } => {
                ("Plane", Form::Plane { normal: v(normal), offset: s(offset) })
            }
            Solid::Box { min, max } => ("Box", Form::Box { min: v(min), max: v(max) }),
            Solid::Cylinder { base, top, radius } => {
                ("Cylinder", Form::Cylinder { base: v(base), top: v(top), radius: s(radius) })
            }
            Solid::Cone { base, base_radius, top, top_radius } => {
                let (base_radius, top_radius) = (s(base_radius), s(top_radius));
                ("Cone", Form::Cone { base: v(base), base_radius, top: v(top), top_radius })
            }
            Solid::Torus { center, axis, major, minor } => {
                let (center, axis) = (v(center), v(axis));
                ("Torus", Form::Torus { center, axis, major: s(major), minor: s(minor) })
            }
            Solid::Triangle { a, b, c, normals } => {
                let normals = normals.map(|normals| normals.0.map(v));
                ("Triangle", Form::Triangle { corners: [a, b, c].map(v), normals })
            }
            Solid::Polygon(ref written) => {
                self.points.extend(written.iter().map(|&vertex| v(vertex)));
                ("Polygon", Form::Polygon { vertices: &self.points })
            }
            Solid::Mesh { .. } => {
                self.mesh = mesh::Lists::of(leaf, &path.field("Mesh"))?;
                ("Mesh", self.mesh.form())
            }
            Solid::HeightField { min, max, columns, ref heights, base, smooth } => {
                self.numbers.extend(heights.iter().map(|&height| s(height)));
                let (min, max, base) = (min.0.map(s), max.0.map(s), base.map(s));
                let heights = &self.numbers;
                let form = Heights { min, max, columns, heights, base, smooth };
                ("HeightField", Form::HeightField(form))
            }
            _ => return Err(Flaw::new(path, "is not a shape")),
        })
    }
}

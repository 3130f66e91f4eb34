//! A shape of a document in the words of the scene builder.

use nostray::{Form, Profile, Scalar};

use crate::assemble::vector;
use crate::document::{self, Solid};
use crate::flaw::{Flaw, Path};
use crate::written::Several;

/// What a form borrows: the lists of a shape, in the number format of the scene.
pub(crate) struct Stock<S: Scalar> {
    points: Vec<S::Vec3>,
    pairs: Vec<[S; 2]>,
}

impl<S: Scalar> Default for Stock<S> {
    fn default() -> Self {
        Self { points: Vec::new(), pairs: Vec::new() }
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
            Solid::Lathe { center, ref profile } => {
                ("Lathe", Form::Lathe { center: v(center), profile: self.profile(profile) })
            }
            Solid::Prism { ref vertices, height } => {
                let vertices = self.pairs(vertices);
                ("Prism", Form::Prism { vertices, height: s(height) })
            }
            Solid::Quadric { center, squares, products, linear, constant } => {
                let [center, squares, products, linear] =
                    [center, squares, products, linear].map(v);
                let constant = s(constant);
                ("Quadric", Form::Quadric { center, squares, products, linear, constant })
            }
            Solid::Triangle { a, b, c, normals } => {
                let normals = normals.map(|normals| normals.0.map(v));
                ("Triangle", Form::Triangle { corners: [a, b, c].map(v), normals })
            }
            Solid::Polygon(ref written) => {
                self.points.extend(written.iter().map(|&vertex| v(vertex)));
                ("Polygon", Form::Polygon { vertices: &self.points })
            }
            _ => return Err(Flaw::new(path, "is not a shape")),
        })
    }

    fn pairs(&mut self, written: &[Several<f64, 2>]) -> &[[S; 2]] {
        self.pairs.extend(written.iter().map(|pair| pair.0.map(S::from_f64)));
        &self.pairs
    }

    fn profile(&mut self, written: &document::Profile) -> Profile<'_, S> {
        match written {
            document::Profile::Linear(points) => Profile::Linear(self.pairs(points)),
            document::Profile::Bezier(points) => Profile::Bezier(self.pairs(points)),
            document::Profile::CatmullRom(points) => Profile::CatmullRom(self.pairs(points)),
        }
    }
}

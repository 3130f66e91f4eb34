//! A shape of a document in the words of the scene builder.

mod mesh;

use nostray::shape::program;
use nostray::{Form, Heights, Metaball, Profile, Scalar};

use crate::assemble::vector;
use crate::document::{self, Component, Solid};
use crate::expression::{Program, compile};
use crate::flaw::{Flaw, Path};
use crate::written::Several;

/// What a form borrows: the lists of a shape, in the number format of the scene.
pub(crate) struct Stock<S: Scalar> {
    points: Vec<S::Vec3>,
    pairs: Vec<[S; 2]>,
    numbers: Vec<S>,
    code: Vec<u8>,
    components: Vec<Metaball<S>>,
    mesh: mesh::Lists<S>,
    patches: Vec<[u32; 16]>,
}

impl<S: Scalar> Default for Stock<S> {
    fn default() -> Self {
        Self {
            points: Vec::new(),
            pairs: Vec::new(),
            numbers: Vec::new(),
            code: Vec::new(),
            components: Vec::new(),
            mesh: mesh::Lists::default(),
            patches: Vec::new(),
        }
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
            Solid::Implicit { min, max, ref expr, spans } => {
                self.compile(expr, spans, &path.field("Implicit"))?;
                let (min, max, code, numbers) = (v(min), v(max), &self.code, &self.numbers);
                ("Implicit", Form::Implicit { min, max, code, numbers, spans })
            }
            Solid::Blob { threshold, ref components } => {
                ("Blob", self.blob(s(threshold), components))
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
            _ => return self.surface(leaf, path),
        })
    }

    /// The same for surfaces of patches.
    fn surface(
        &mut self,
        leaf: &Solid,
        path: &Path<'_>,
    ) -> Result<(&'static str, Form<'_, S>), Flaw> {
        let v = vector::<S>;
        Ok(match *leaf {
            Solid::Patch(ref rows) => {
                self.points.extend(rows.0.iter().flat_map(|row| row.0).map(v));
                self.patches.push(std::array::from_fn(|index| index as u32));
                ("Patch", Form::Patches { points: &self.points, patches: &self.patches })
            }
            Solid::Patches { ref points, ref patches } => {
                self.points.extend(points.iter().map(|&point| v(point)));
                self.patches.extend(patches.iter().map(|patch| patch.0));
                ("Patches", Form::Patches { points: &self.points, patches: &self.patches })
            }
            Solid::Spline { points: ref rows, closed } => {
                let columns = rows.first().map_or(0, Vec::len);
                if rows.iter().any(|row| row.len() != columns) {
                    let path = path.field("Spline");
                    return Err(Flaw::new(path.field("points"), "has rows of different lengths"));
                }
                self.points.extend(rows.iter().flatten().map(|&point| v(point)));
                let (points, columns) = (&self.points[..], columns as u32);
                ("Spline", Form::Spline { points, columns, closed: closed.0 })
            }
            _ => return Err(Flaw::new(path, "is not a shape")),
        })
    }

    fn blob(&mut self, threshold: S, written: &[Component]) -> Form<'_, S> {
        self.components.extend(written.iter().map(metaball));
        Form::Blob { threshold, components: &self.components }
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

    /// Takes the program of a formula, which must tell how many spans there may be or be told.
    fn compile(&mut self, expr: &str, spans: Option<u16>, path: &Path<'_>) -> Result<(), Flaw> {
        let field = path.field("expr");
        let Program { code, numbers } =
            compile(expr).map_err(|flaw| Flaw::new(field, flaw.to_string()))?;
        let bound = program::spans_bound(&code);
        if spans.is_none() && bound.is_none_or(|bound| bound > u32::from(u16::MAX)) {
            let message = "needs the field `spans`, how often a ray may be inside at most: the \
                           formula is not made of polynomials of low degree alone";
            return Err(Flaw::new(path, message));
        }
        self.numbers.extend(numbers.iter().map(|&number| S::from_f64(number)));
        self.code = code;
        Ok(())
    }
}

fn metaball<S: Scalar>(written: &Component) -> Metaball<S> {
    let (ends, radius, strength) = match *written {
        Component::Sphere { center, radius, strength } => ([center; 2], radius, strength),
        Component::Cylinder { base, top, radius, strength } => ([base, top], radius, strength),
    };
    let [radius, strength] = [radius, strength].map(S::from_f64);
    Metaball { ends: ends.map(vector::<S>), radius, strength }
}

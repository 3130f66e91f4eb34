//! The entities that are objects.

use nostray::glam::DVec3;
use nostray::{Affine, Form, Scalar, SceneError, Vector};

use super::look::within_one;
use super::{NffError, Reader};
use crate::triangulate::triangulate;

/// What became of a form.
enum Added {
    Object,
    Nothing,
    NotPlanar,
}

impl<S: Scalar> Reader<'_, S> {
    pub(super) fn sphere(&mut self, line: usize) -> Result<(), NffError> {
        let center = self.point("s")?;
        let radius = self.scalar("s: radius")?.abs();
        if radius == S::ZERO {
            return Err(self.refuse("s: the radius is 0"));
        }
        self.add_or_skip(Form::Sphere { center, radius }, line)
    }

    pub(super) fn cone(&mut self, line: usize) -> Result<(), NffError> {
        let (base, base_radius) = (self.point("c")?, self.scalar("c: base radius")?);
        let (top, top_radius) = (self.point("c")?, self.scalar("c: apex radius")?);
        if base_radius == S::ZERO && top_radius == S::ZERO {
            return Err(self.refuse("c: both radii are 0"));
        }
        if base_radius.min(top_radius) < S::ZERO && base_radius.max(top_radius) > S::ZERO {
            return Err(self.refuse("c: one radius is negative and the other is not"));
        }
        let (base_radius, top_radius) = (base_radius.abs(), top_radius.abs());
        let form = if base_radius == top_radius {
            Form::Cylinder { base, top, radius: base_radius }
        } else {
            Form::Cone { base, base_radius, top, top_radius }
        };
        self.add_or_skip(form, line)
    }

    pub(super) fn polygon(&mut self, line: usize) -> Result<(), NffError> {
        let mut vertices = Vec::new();
        for _ in 0..self.vertex_count("p")? {
            vertices.push(self.point("p")?);
        }
        let form = match vertices[..] {
            [a, b, c] => Form::Triangle { corners: [a, b, c], normals: None },
            _ => Form::Polygon { vertices: &vertices },
        };
        match self.add(form, line)? {
            Added::Object => {}
            Added::Nothing => self.scene.skipped += 1,
            Added::NotPlanar => self.facets(&vertices, None, line)?,
        }
        Ok(())
    }

    pub(super) fn patch(&mut self, line: usize) -> Result<(), NffError> {
        let (mut vertices, mut normals) = (Vec::new(), Vec::new());
        for _ in 0..self.vertex_count("pp")? {
            vertices.push(self.point("pp")?);
            let normal = within_one(self.words.numbers("pp")?).map(DVec3::from_array);
            let unit = normal.map_or(DVec3::ZERO, Vector::normalize);
            normals.push(S::Vec3::from_array(unit.to_array().map(S::from_f64)));
        }
        let flat = normals.contains(&S::Vec3::ZERO);
        self.scene.flattened += usize::from(flat);
        self.facets(&vertices, (!flat).then_some(&normals), line)
    }

    /// Adds a polygon as triangles.
    fn facets(
        &mut self,
        vertices: &[S::Vec3],
        normals: Option<&Vec<S::Vec3>>,
        line: usize,
    ) -> Result<(), NffError> {
        let wide: Vec<_> = vertices.iter().map(|v| wide::<S>(*v)).collect();
        let mut seen = false;
        for corners in triangulate(&wide) {
            let normals = normals.map(|normals| corners.map(|index| normals[index]));
            let corners = corners.map(|index| vertices[index]);
            let added = self.add(Form::Triangle { corners, normals }, line)?;
            seen |= matches!(added, Added::Object);
        }
        self.scene.skipped += usize::from(!seen);
        Ok(())
    }

    /// Makes an object of a solid, or counts it where it has no length.
    fn add_or_skip(&mut self, form: Form<'_, S>, line: usize) -> Result<(), NffError> {
        let added = self.add(form, line)?;
        self.scene.skipped += usize::from(!matches!(added, Added::Object));
        Ok(())
    }

    /// Makes an object of a form, of the last material.
    fn add(&mut self, form: Form<'_, S>, line: usize) -> Result<Added, NffError> {
        let material = self.material;
        let material =
            material.ok_or_else(|| NffError::new(line, "an object before the first `f`"))?;
        match self.scene.builder.leaf(form, &Affine::identity(), material) {
            Ok(()) => Ok(Added::Object),
            Err(SceneError::Empty { .. }) => Ok(Added::Nothing),
            Err(SceneError::NotPlanar { .. }) => Ok(Added::NotPlanar),
            Err(error) => Err(NffError::new(line, error.to_string())),
        }
    }

    fn vertex_count(&mut self, of: &str) -> Result<u64, NffError> {
        match self.words.count(of)? {
            count @ 0..3 => Err(self.refuse(format!("{of}: {count} vertices; 3 are the least"))),
            count => Ok(count),
        }
    }
}

fn wide<S: Scalar>(v: S::Vec3) -> DVec3 {
    DVec3::from_array(v.to_array().map(S::to_f64))
}

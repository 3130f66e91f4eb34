//! Whether a mesh is what it says it is.

use core::ops::ControlFlow;

use super::{Mesh, widened};
use crate::bounds::Bounds;
use crate::hierarchy::{self, Visit, walk};
use crate::scalar::{Number, Scalar, Vector};
use crate::shape::{Flaw, Tables, check_point, triangle, unplaced};

/// Checks every index and number of a mesh, its hierarchy, and of a closed mesh that it is closed.
///
/// Each triangle is looked for through the hierarchy, and of a closed mesh each edge, among the
/// triangles whose boxes hold it: time grows as n·log n for a mesh whose triangles lie side by side, and
/// as n² at worst, where all boxes overlap in the same place.
#[inline(never)]
pub(super) fn check<S: Scalar>(
    mesh: &Mesh,
    placed: bool,
    tables: &Tables<'_, S>,
) -> Result<(), Flaw> {
    unplaced(placed, "triangles")?;
    if mesh.triangles == 0 {
        return Err(Flaw::Empty("triangles"));
    }
    for face in 0..mesh.triangles {
        check_triangle(mesh, face, tables)?;
    }
    let branches = mesh.hierarchy(tables);
    let margin = mesh.margin::<S>(tables.points, tables.indices);
    let bounds = |face| {
        mesh.corners(face, tables)
            .map_or_else(Bounds::nothing, |corners| widened::<S>(corners, margin))
    };
    let entry = |entry| mesh.face(entry, tables.indices).map_or_else(Bounds::nothing, bounds);
    hierarchy::check(branches, mesh.triangles, entry).map_err(Flaw::Hierarchy)?;
    for face in 0..mesh.triangles {
        // There are as many entries as triangles, so if none is missing none stands twice.
        let mut seek = Seek { mesh, tables, face, bounds: bounds(face), found: false };
        walk(branches, [false; 3], &mut seek);
        if !seek.found {
            return Err(Flaw::Triangle(face, "is not in the hierarchy"));
        }
    }
    if !mesh.closed {
        return Ok(());
    }
    for face in 0..mesh.triangles {
        check_edges(mesh, face, tables)?;
    }
    if mesh.volume::<S>(tables.points, tables.indices) < S::Wide::ZERO {
        let allowed = "counterclockwise as seen from outside";
        return Err(Flaw::OutOfRange("triangles", allowed));
    }
    Ok(())
}

fn check_triangle<S: Scalar>(mesh: &Mesh, face: u32, tables: &Tables<'_, S>) -> Result<(), Flaw> {
    let flaw = |what: &'static str| Flaw::Triangle(face, what);
    let corners = mesh.corners(face, tables).ok_or(flaw("names a point that is not there"))?;
    for corner in corners {
        check_point::<S>(corner, "points")?;
    }
    let normal = triangle::normal(corners.map(S::widen_vec));
    if !(normal.max_abs() > S::EPSILON.widen()) {
        return Err(flaw("has no area"));
    }
    if mesh.smooth {
        let normals = mesh.normals(face, tables).ok_or(flaw("names a normal that is not there"))?;
        for normal in normals {
            check_point::<S>(normal, "normals")?;
        }
    }
    if mesh.mapped {
        let missing = flaw("names texture coordinates that are not there");
        for number in mesh.coordinates(face, tables).ok_or(missing)?.as_flattened() {
            if !number.is_finite() {
                return Err(Flaw::NotFinite("uvs"));
            } else if number.abs() > S::COORD_MAX {
                return Err(Flaw::TooLarge("uvs"));
            }
        }
    }
    Ok(())
}

/// Looks for a triangle in the hierarchy.
struct Seek<'a, S: Scalar> {
    mesh: &'a Mesh,
    tables: &'a Tables<'a, S>,
    face: u32,
    bounds: Bounds<S>,
    found: bool,
}

impl<S: Scalar> Visit<S> for Seek<'_, S> {
    fn wants(&mut self, bounds: &Bounds<S>) -> bool {
        bounds.union(&self.bounds) == *bounds
    }

    fn entries(&mut self, first: u32, count: u32) -> ControlFlow<()> {
        let mut entries = first..first + count;
        let face = |entry| self.mesh.face(entry, self.tables.indices);
        if entries.any(|entry| face(entry) == Some(self.face)) {
            self.found = true;
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }
}

/// Counts the triangles that go along an edge, in both directions.
struct Sides<'a, S: Scalar> {
    mesh: &'a Mesh,
    tables: &'a Tables<'a, S>,
    edge: [S::Vec3; 2],
    forth: u32,
    back: u32,
}

impl<S: Scalar> Visit<S> for Sides<'_, S> {
    fn wants(&mut self, bounds: &Bounds<S>) -> bool {
        self.edge.iter().all(|&end| bounds.contains(end))
    }

    fn entries(&mut self, first: u32, count: u32) -> ControlFlow<()> {
        let [from, to] = self.edge;
        for entry in first..first + count {
            let face = self.mesh.face(entry, self.tables.indices);
            let Some([a, b, c]) = face.and_then(|face| self.mesh.corners(face, self.tables)) else {
                continue;
            };
            for [p, q] in [[a, b], [b, c], [c, a]] {
                self.forth += u32::from(p == from && q == to);
                self.back += u32::from(p == to && q == from);
            }
        }
        ControlFlow::Continue(())
    }
}

/// Each edge of a triangle is one of exactly one other, which goes along it the other way.
fn check_edges<S: Scalar>(mesh: &Mesh, face: u32, tables: &Tables<'_, S>) -> Result<(), Flaw> {
    let Some([a, b, c]) = mesh.corners(face, tables) else {
        return Ok(());
    };
    for edge in [[a, b], [b, c], [c, a]] {
        let mut sides = Sides { mesh, tables, edge, forth: 0, back: 0 };
        walk(mesh.hierarchy(tables), [false; 3], &mut sides);
        let what = match (sides.forth, sides.back) {
            (1, 1) => continue,
            (1, 0) => "has an edge without a neighbour that goes along it the other way",
            _ => "has an edge that it shares with more than one other, or in the same direction",
        };
        return Err(Flaw::Triangle(face, what));
    }
    Ok(())
}

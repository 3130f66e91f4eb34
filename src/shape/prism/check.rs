//! What the polygon of a prism must be.

use super::plan::{edges, spot};
use super::{Prism, Winding};
use crate::scalar::{Number, Scalar, Vector};
use crate::shape::outline::cross_properly;
use crate::shape::{Flaw, Tables, check_point};

/// Checks all that a prism says of its polygon.
pub(super) fn check<S: Scalar>(prism: &Prism<S>, tables: &Tables<'_, S>) -> Result<(), Flaw> {
    let vertices = prism.vertices(tables);
    if vertices.is_empty() {
        return Err(if prism.count == 0 {
            Flaw::Empty("vertices")
        } else {
            Flaw::Index("vertices")
        });
    }
    if prism.count < 3 {
        return Err(Flaw::Empty("vertices"));
    }
    for &vertex in vertices {
        check_point::<S>(vertex, "vertices")?;
        if vertex.y() != S::ZERO {
            return Err(Flaw::NotPlanar("vertices"));
        }
    }
    for [[a, b], [c, d]] in edges::<S>(vertices) {
        if (c - a).abs().max((d - b).abs()) < S::LENGTH_MIN.widen() {
            return Err(Flaw::Empty("vertices"));
        }
    }
    let found = winding::<S>(vertices);
    if found != Winding::Crossed && area::<S>(vertices) == S::Wide::ZERO {
        return Err(Flaw::Empty("vertices"));
    }
    if found == prism.winding {
        Ok(())
    } else {
        Err(Flaw::OutOfRange("winding", "the way around that the vertices go"))
    }
}

/// Which way around these vertices go.
pub(super) fn winding<S: Scalar>(vertices: &[S::Vec3]) -> Winding {
    if crosses_itself::<S>(vertices) {
        Winding::Crossed
    } else if area::<S>(vertices) < S::Wide::ZERO {
        Winding::Clockwise
    } else {
        Winding::Counterclockwise
    }
}

/// Twice the area on the left.
fn area<S: Scalar>(vertices: &[S::Vec3]) -> S::Wide {
    let first = vertices.first().map_or([S::Wide::ZERO; 2], |first| spot::<S>(*first));
    edges::<S>(vertices).fold(S::Wide::ZERO, |area, ends| {
        let [[a, b], [c, d]] = ends.map(|[x, z]| [x - first[0], z - first[1]]);
        area + (a * d - b * c)
    })
}

fn crosses_itself<S: Scalar>(vertices: &[S::Vec3]) -> bool {
    let edges = edges::<S>(vertices);
    edges
        .clone()
        .zip(1..)
        .any(|(edge, next)| edges.clone().skip(next).any(|other| cross_properly::<S>(edge, other)))
}

//! Polygons as triangles, by the clipping of ears.

use nostray::glam::DVec3;
use nostray::{Axis, Number, Polygon, Scalar, Vector};

/// A point of a polygon seen along an axis.
type Flat = [f64; 2];

/// The triangles of a simple polygon, as indices of its vertices, turning as it turns: two less
/// than it has vertices, or none where it has no area. A convex polygon becomes a fan.
///
/// The polygon need not be plane; it is seen along the axis nearest to its normal. One that
/// crosses itself there becomes triangles that overlap. The time grows with the square of the
/// number of vertices where ears are easy to find, and never faster than the cube.
///
/// Source: G. H. Meisters, "Polygons Have Ears" (1975).
pub(crate) fn triangulate(vertices: &[DVec3]) -> Vec<[usize; 3]> {
    let normal = Polygon::<f64>::newell(vertices);
    if normal == DVec3::ZERO {
        return Vec::new();
    }
    let points = flatten(vertices, normal);
    let mut left: Vec<usize> = (0..points.len()).collect();
    let mut triangles = Vec::with_capacity(points.len().saturating_sub(2));
    while left.len() >= 3 {
        let ears = (0..left.len()).find(|&tip| is_ear(&points, &left, tip));
        let tip = ears.unwrap_or_else(|| most_convex(&points, &left));
        triangles.push(around(&left, tip));
        left.remove(tip);
    }
    triangles
}

/// The polygon along the axis nearest to its normal, counterclockwise.
fn flatten(vertices: &[DVec3], normal: DVec3) -> Vec<Flat> {
    let size = |axis: Axis| Number::abs(normal.get(axis));
    let along = Axis::ALL.into_iter().fold(Axis::X, |a, b| if size(b) > size(a) { b } else { a });
    let (mut u, mut v) = (along.next(), along.next().next());
    if normal.get(along) < 0.0 {
        (u, v) = (v, u);
    }
    vertices.iter().map(|vertex| [vertex.get(u), vertex.get(v)]).collect()
}

/// A vertex between its neighbours.
fn around(left: &[usize], tip: usize) -> [usize; 3] {
    let count = left.len();
    [left[(tip + count - 1) % count], left[tip], left[(tip + 1) % count]]
}

/// Twice the area of a triangle, positive counterclockwise; the sign is that of the rounded edges.
fn area(a: Flat, b: Flat, c: Flat) -> f64 {
    f64::det2(b[0] - a[0], c[1] - a[1], b[1] - a[1], c[0] - a[0])
}

/// The triangle at a vertex lies in the polygon, with no other vertex in it or on it.
fn is_ear(points: &[Flat], left: &[usize], tip: usize) -> bool {
    let [a, b, c] = around(left, tip).map(|index| points[index]);
    let holds = |p: Flat| {
        p != a && p != b && p != c && {
            area(a, b, p) >= 0.0 && area(b, c, p) >= 0.0 && area(c, a, p) >= 0.0
        }
    };
    area(a, b, c) > 0.0 && !left.iter().any(|&index| holds(points[index]))
}

/// The vertex with the greatest triangle: what is taken where the polygon has no ear, because
/// it crosses itself or has no width.
fn most_convex(points: &[Flat], left: &[usize]) -> usize {
    let area_at = |tip| {
        let [a, b, c] = around(left, tip).map(|index| points[index]);
        area(a, b, c)
    };
    (0..left.len()).fold(0, |best, tip| if area_at(tip) > area_at(best) { tip } else { best })
}

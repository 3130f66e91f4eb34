//! A mesh in double precision, on its way from a file or a program to a scene.

use nostray::Vector;
use nostray::glam::DVec3;

/// Triangles that share points, normals and texture coordinates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figure {
    /// The points.
    pub points: Vec<[f64; 3]>,
    /// The normals, of any length but 0.
    pub normals: Vec<[f64; 3]>,
    /// The texture coordinates.
    pub uvs: Vec<[f64; 2]>,
    /// The points of each triangle.
    pub corners: Vec<[u32; 3]>,
    /// The normals of each triangle; none at all for a flat mesh.
    pub normal_corners: Vec<[u32; 3]>,
    /// The texture coordinates of each triangle, if it has them.
    pub uv_corners: Vec<[u32; 3]>,
}

impl Figure {
    /// Gives each point the normal of a smooth surface through its neighbours. Nothing happens where a corner
    /// names no point.
    ///
    /// Source: N. Max, "Weights for Computing Vertex Normals from Facet Normals" (1999).
    pub fn smooth(&mut self) {
        let mut sums = vec![DVec3::ZERO; self.points.len()];
        for &triangle in &self.corners {
            let place = |index: u32| self.points.get(index as usize).copied();
            let [Some(a), Some(b), Some(c)] = triangle.map(place) else {
                return;
            };
            let [a, b, c] = [a, b, c].map(DVec3::from_array);
            for (index, from, to) in [(0, b - a, c - a), (1, c - b, a - b), (2, a - c, b - c)] {
                let weight = from.length_squared() * to.length_squared();
                sums[triangle[index] as usize] += Vector::cross(from, to) / weight;
            }
        }
        // A point of nothing, or of surfaces that look away from each other.
        let whole =
            |sum: DVec3| if Vector::is_finite(sum) && sum != DVec3::ZERO { sum } else { DVec3::Y };
        self.normals =
            sums.into_iter().map(|sum| Vector::normalize(whole(sum)).to_array()).collect();
        self.normal_corners = self.corners.clone();
    }
}

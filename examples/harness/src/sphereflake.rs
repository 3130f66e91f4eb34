//! The sphereflake of E. Haines ("A Proposal for Standard Graphics Environments", 1987): a
//! sphere with nine smaller ones on it, each with nine on it, and so on.

use nostray::Vector;
use nostray::glam::DVec3;

use crate::document::{Camera, Document, Drawn, Light, Material, Object, Solid, Texture};
use crate::moves::sin_cos_degrees;
use crate::written::{Background, Factor, Gradient, Many, Paint, Table, Triple};

/// How much smaller a sphere is than the one it sits on.
const SHRINK: f64 = 1.0 / 3.0;

/// The scene for a depth: 1, 10, 91, 820, … spheres for 0, 1, 2, 3, …
pub(crate) fn sphereflake(depth: u32) -> Document {
    let mut objects = vec![Object {
        solid: Solid::Plane { normal: Triple([0.0, 1.0, 0.0]), offset: -1.45 },
        material: Some("floor".to_owned()),
        place: Vec::new(),
    }];
    let mut waiting = vec![(DVec3::ZERO, 1.0, DVec3::Y, depth)];
    while let Some((center, radius, axis, depth)) = waiting.pop() {
        objects.push(Object {
            solid: Solid::Sphere { center: Triple(center.to_array()), radius },
            material: Some("mirror".to_owned()),
            place: Vec::new(),
        });
        if depth > 0 {
            for direction in directions(axis) {
                let small = radius * SHRINK;
                let next = center + direction * (radius + small);
                waiting.push((next, small, direction, depth - 1));
            }
        }
    }
    Document { objects, ..surroundings() }
}

/// Where the nine sit: six around the equator of the axis that a sphere grew along, and three
/// above, between them.
fn directions(axis: DVec3) -> [DVec3; 9] {
    let (u, v) = Vector::basis(axis);
    let around = |turn: f64, height: f64| {
        let ((sin, cos), (up, out)) = (sin_cos_degrees(turn), sin_cos_degrees(height));
        Vector::normalize((u * cos + v * sin) * out + axis * up)
    };
    std::array::from_fn(|index| match index {
        0..6 => around(60.0 * index as f64, 0.0),
        _ => around(120.0 * index as f64 + 30.0, 54.735_610_317_245_346),
    })
}

/// Everything but the spheres.
fn surroundings() -> Document {
    let colors =
        vec![Paint::Color(Triple([0.62, 0.55, 0.45])), Paint::Color(Triple([0.14, 0.12, 0.11]))];
    let (colors, size) = (Some(Many(colors)), Some(Factor([1.2; 3])));
    let drawn = Drawn { colors, size, ..Drawn::default() };
    let tiles = Texture { pattern: "Checker", drawn };
    let floor = Material {
        color: Paint::Texture("tiles".to_owned()),
        diffuse: 0.8.into(),
        reflect: 0.12.into(),
        ..Material::default()
    };
    let mirror = Material {
        color: Paint::Color(Triple([0.55, 0.62, 0.72])),
        diffuse: 0.32.into(),
        specular: 0.6.into(),
        shininess: 60.0.into(),
        reflect: 0.55.into(),
        ..Material::default()
    };
    let lamp = |at, color| Light::Point { at: Triple(at), color, attenuation: Default::default() };
    Document {
        camera: Camera {
            eye: Triple([2.3, 1.9, -4.6]),
            look_at: Triple([0.0, 0.05, 0.0]),
            up: Triple([0.0, 1.0, 0.0]),
            fov: Some(38.0),
            height: None,
            aperture: None,
            focus: None,
        },
        background: Background::Gradient(Gradient {
            bottom: Triple([0.30, 0.33, 0.38]),
            top: Triple([0.16, 0.30, 0.55]),
        }),
        ambient: Triple([0.12; 3]),
        lights: vec![
            lamp([-4.0, 7.0, -5.0], Triple([0.75, 0.72, 0.66])),
            lamp([6.0, 4.0, -3.0], Triple([0.30, 0.34, 0.42])),
        ],
        textures: Table(vec![("tiles".to_owned(), tiles)]),
        materials: Table(vec![("floor".to_owned(), floor), ("mirror".to_owned(), mirror)]),
        objects: Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::indexing_slicing, reason = "a test may fail loudly")]

    use super::*;

    fn spheres(depth: u32) -> Vec<(DVec3, f64)> {
        let of = |object: &Object| match object.solid {
            Solid::Sphere { center, radius } => Some((DVec3::from_array(center.0), radius)),
            _ => None,
        };
        sphereflake(depth).objects.iter().filter_map(of).collect()
    }

    #[test]
    fn there_are_nine_times_as_many_at_each_depth() {
        assert_eq!([0, 1, 2, 3].map(|depth| spheres(depth).len()), [1, 10, 91, 820]);
    }

    #[test]
    fn each_touches_the_one_it_sits_on_and_no_other_of_its_size() {
        let spheres = spheres(1);
        let (first, small) = (spheres[0], &spheres[1..]);
        for (index, &(center, radius)) in small.iter().enumerate() {
            assert!((Vector::length(center - first.0) - (first.1 + radius)).abs() < 1e-12);
            for &(other, _) in &small[..index] {
                assert!(Vector::length(center - other) > 2.0 * radius - 1e-12);
            }
        }
    }
}

//! A trefoil knot over dunes: meshes that are made at run time.

use nostray::glam::DVec3;
use nostray::{Number, Vector};

use crate::document::{Camera, Document, Fresnel, Highlight, Light, Material, Move, Object, Solid};
use crate::figure::Figure;
use crate::moves::sin_cos_degrees;
use crate::written::{Background, Factor, Gradient, Paint, Several, Table, Triple};

/// A tube along a curve, with ribs that wind around it.
struct Tube {
    /// How many rings it has, and points on a ring.
    rings: u32,
    sides: u32,
    /// The mean radius, the height of the ribs as a share of it, how many there are and how many times
    /// they wind around on the whole way.
    radius: f64,
    height: f64,
    ribs: f64,
    turns: f64,
}

/// A point of the trefoil knot, which goes three times through a torus while it goes two times
/// around it, and the normal of the torus there.
fn trefoil(degrees: f64) -> (DVec3, DVec3) {
    let ((sin_a, cos_a), (sin_b, cos_b)) =
        (sin_cos_degrees(2.0 * degrees), sin_cos_degrees(3.0 * degrees));
    let normal = DVec3::new(cos_b * cos_a, cos_b * sin_a, sin_b);
    (DVec3::new(cos_a, sin_a, 0.0) + normal * 0.46, normal)
}

impl Tube {
    /// The closed tube around the trefoil knot.
    fn knot(&self) -> Figure {
        let mut figure = Figure::default();
        let step = 360.0 / f64::from(self.rings);
        for ring in 0..self.rings {
            let degrees = step * f64::from(ring);
            let (center, u) = trefoil(degrees);
            let along = trefoil(degrees + 0.01).0 - trefoil(degrees - 0.01).0;
            let v = Vector::cross(Vector::normalize(along), u);
            for side in 0..self.sides {
                let angle = 360.0 / f64::from(self.sides) * f64::from(side);
                let (sin, cos) = sin_cos_degrees(angle);
                let rib = sin_cos_degrees(self.ribs * angle + self.turns * degrees).1;
                let radius = self.radius * (1.0 + self.height * rib);
                figure.points.push((center + (u * cos + v * sin) * radius).to_array());
            }
        }
        let place = |ring: u32, side: u32| ring % self.rings * self.sides + side % self.sides;
        for ring in 0..self.rings {
            for side in 0..self.sides {
                let [a, b, c, d] =
                    [[0, 0], [0, 1], [1, 0], [1, 1]].map(|[far, on]| place(ring + far, side + on));
                figure.corners.extend([[a, c, b], [b, c, d]]);
            }
        }
        figure.smooth();
        figure
    }
}

/// An icosahedron whose faces are divided in four, all points on the unit ball: 80 facets.
fn gem() -> Figure {
    let golden = (1.0 + nostray::Real::sqrt(5.0_f64)) / 2.0;
    let mut figure = Figure::default();
    for (a, b) in [(1.0, golden), (-1.0, golden), (1.0, -golden), (-1.0, -golden)] {
        figure.points.extend([[0.0, a, b], [a, b, 0.0], [b, 0.0, a]]);
    }
    let at = |points: &[[f64; 3]], index: u32| DVec3::from_array(points[index as usize]);
    let near = |points: &[[f64; 3]], a: u32, b: u32| {
        let gap = at(points, a) - at(points, b);
        Number::abs(Vector::length(gap) - 2.0) < 1e-9
    };
    let count = figure.points.len() as u32;
    for a in 0..count {
        for b in a + 1..count {
            for c in b + 1..count {
                let points = &figure.points;
                if near(points, a, b) && near(points, b, c) && near(points, c, a) {
                    let [p, q, r] = [a, b, c].map(|index| at(points, index));
                    let outward = Vector::dot(p, Vector::cross(q, r)) > 0.0;
                    figure.corners.push(if outward { [a, b, c] } else { [a, c, b] });
                }
            }
        }
    }
    let mut middles = std::collections::BTreeMap::new();
    let whole = std::mem::take(&mut figure.corners);
    for [a, b, c] in whole {
        let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(from, to)| {
            *middles.entry((from.min(to), from.max(to))).or_insert_with(|| {
                let sum = at(&figure.points, from) + at(&figure.points, to);
                figure.points.push((sum * 0.5).to_array());
                figure.points.len() as u32 - 1
            })
        });
        figure.corners.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
    }
    for point in &mut figure.points {
        *point = Vector::normalize(DVec3::from_array(*point)).to_array();
    }
    figure
}

/// A solid of a document.
fn solid(figure: Figure) -> Solid {
    Solid::Mesh {
        file: None,
        points: figure.points.into_iter().map(Triple).collect(),
        triangles: figure.corners.into_iter().map(Several).collect(),
        normals: figure.normals.into_iter().map(Triple).collect(),
        uvs: Vec::new(),
        closed: true,
        smooth: false,
    }
}

/// Dunes, and ripples across them.
fn dunes() -> Solid {
    const COLUMNS: u32 = 88;
    let height = |x: f64, z: f64| {
        let wave = |degrees: f64| sin_cos_degrees(degrees).0;
        let bend = 25.0 * wave(31.0 * x) + 14.0 * wave(57.0 * z + 40.0);
        let ripple = 0.035 * wave(330.0 * z + 60.0 * x + 4.0 * bend) * (1.0 + 0.4 * wave(40.0 * x));
        0.45 * wave(33.0 * z + 20.0 * wave(30.0 * x) - 120.0) * wave(20.0 * x + 30.0) + ripple
    };
    let (min, max) = ([-7.0, -10.0], [7.0, 4.0]);
    let share = |index: u32| f64::from(index) / f64::from(COLUMNS - 1);
    let place = |axis: usize, index: u32| min[axis] + (max[axis] - min[axis]) * share(index);
    let all = (0..COLUMNS).flat_map(|row| (0..COLUMNS).map(move |column| (column, row)));
    let heights = all.map(|(column, row)| height(place(0, column), place(1, row)) - 1.9).collect();
    Solid::HeightField {
        min: Several(min),
        max: Several(max),
        columns: COLUMNS,
        heights,
        base: None,
        smooth: true,
    }
}

/// The scene.
pub(crate) fn knot() -> Document {
    let tube = Tube { rings: 132, sides: 24, radius: 0.27, height: 0.09, ribs: 4.0, turns: 6.0 };
    // A slice across the lobe on the right, 10 degrees along the way.
    let slice = Solid::Box { min: Triple([-0.5, -0.2, -0.5]), max: Triple([0.5, 0.2, 0.5]) };
    let cut = Solid::With {
        solid: Box::new(slice),
        material: Some("gold".to_owned()),
        place: vec![
            Move::Rotate { axis: Triple([0.597, 0.0, 0.802]), degrees: 39.9 },
            Move::Translate(Triple([1.314, 0.478, 0.23])),
        ],
    };
    let object = |solid: Solid, material: &str, place: Vec<Move>| Object {
        solid,
        material: Some(material.to_owned()),
        place,
    };
    let objects = vec![
        object(dunes(), "sand", Vec::new()),
        object(
            Solid::Difference(vec![solid(tube.knot()), cut]),
            "enamel",
            vec![Move::RotateY(-14.0), Move::Translate(Triple([-0.3, 0.05, 0.0]))],
        ),
        object(
            solid(gem()),
            "glass",
            vec![
                Move::RotateX(17.0),
                Move::RotateZ(24.0),
                Move::Scale(Factor([0.5; 3])),
                Move::Translate(Triple([1.85, -1.3, 0.85])),
            ],
        ),
    ];
    Document { objects, ..surroundings() }
}

/// Everything but the solids.
fn surroundings() -> Document {
    let sand = Material {
        color: Paint::Color(Triple([0.78, 0.60, 0.40])),
        diffuse: 0.9.into(),
        ..Material::default()
    };
    let enamel = Material {
        color: Paint::Color(Triple([0.02, 0.22, 0.30])),
        diffuse: 0.8.into(),
        specular: 0.7.into(),
        shininess: 140.0.into(),
        highlight: Highlight::Blinn,
        reflect: 0.06.into(),
        fresnel: Fresnel::Schlick,
        ior: 1.5,
        ..Material::default()
    };
    let gold = Material {
        color: Paint::Color(Triple([0.95, 0.66, 0.22])),
        diffuse: 0.55.into(),
        specular: 0.8.into(),
        shininess: 50.0.into(),
        metallic: true,
        reflect: 0.35.into(),
        ..Material::default()
    };
    let glass = Material {
        color: Paint::Color(Triple([1.0; 3])),
        ambient: 0.0.into(),
        diffuse: 0.0.into(),
        specular: 0.8.into(),
        shininess: 300.0.into(),
        transmit: 0.95.into(),
        ior: 1.5,
        fresnel: Fresnel::Exact,
        absorb: Triple([0.12, 1.1, 0.85]),
        ..Material::default()
    };
    let lamp = |at, color| Light::Point { at: Triple(at), color, attenuation: Default::default() };
    Document {
        camera: Camera {
            eye: Triple([0.7, 1.25, 6.3]),
            look_at: Triple([0.15, -0.2, 0.0]),
            up: Triple([0.0, 1.0, 0.0]),
            fov: Some(38.0),
            height: None,
        },
        background: Background::Gradient(Gradient {
            bottom: Triple([1.0, 0.62, 0.34]),
            top: Triple([0.05, 0.14, 0.42]),
        }),
        ambient: Triple([0.20, 0.18, 0.22]),
        lights: vec![
            lamp([-6.5, 3.6, 3.0], Triple([1.0, 0.84, 0.60])),
            lamp([5.0, 6.0, 6.0], Triple([0.18, 0.22, 0.34])),
        ],
        textures: Table::default(),
        materials: Table(
            [("sand", sand), ("enamel", enamel), ("gold", gold), ("glass", glass)]
                .map(|(name, material)| (name.to_owned(), material))
                .into(),
        ),
        objects: Vec::new(),
    }
}

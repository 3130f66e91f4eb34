//! Meshes for the tests, as points and triangles, and the scenes that are made of them.
#![allow(unreachable_pub, reason = "public within this test")]

use std::collections::BTreeMap;

use nostray::{
    Affine, Boundary, Corners, Form, Material, Mesh, Node, Passage, Ray, Rgb, Scalar, Scene,
    SceneBuilder, Shape, Triangles, Vector,
};
use nostray_harness::Heap;

use crate::oracle::{Random, along, length};

/// Points, and triangles that run counterclockwise as seen from outside.
#[derive(Clone, Debug, Default)]
pub struct Figure {
    pub points: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
}

impl Figure {
    /// Triangles whose equal corners become one point.
    fn of(triangles: impl IntoIterator<Item = [[f64; 3]; 3]>) -> Self {
        let (mut figure, mut known) = (Self::default(), BTreeMap::new());
        for triangle in triangles {
            let indices = triangle.map(|corner| {
                // Adding 0 makes the two zeros one.
                *known.entry(corner.map(|x| (x + 0.0).to_bits())).or_insert_with(|| {
                    figure.points.push(corner);
                    figure.points.len() as u32 - 1
                })
            });
            figure.triangles.push(indices);
        }
        figure
    }

    /// The same, with every point moved.
    pub fn map(mut self, f: impl FnMut([f64; 3]) -> [f64; 3]) -> Self {
        self.points = self.points.into_iter().map(f).collect();
        self
    }

    /// The same, moved and scaled.
    pub fn placed(self, size: f64, center: [f64; 3]) -> Self {
        self.map(|p| along(center, size, p))
    }

    /// The corners of a triangle.
    pub fn corners(&self, triangle: usize) -> [[f64; 3]; 3] {
        self.triangles[triangle].map(|index| self.points[index as usize])
    }

    /// A point of an edge, often its middle or its end.
    pub fn on_edge(&self, random: &mut Random) -> [f64; 3] {
        let [a, b, _] = self.corners(random.below(self.triangles.len()));
        let way = along(b, -1.0, a);
        match random.below(3) {
            0 => a,
            1 => along(a, 0.5, way),
            _ => along(a, random.within(0.0, 1.0), way),
        }
    }
}

/// The unit octahedron in 8·4^`levels` triangles.
pub fn octahedron(levels: u32) -> Figure {
    let mut triangles = Vec::new();
    for x in [1.0, -1.0] {
        for y in [1.0, -1.0] {
            for z in [1.0, -1.0] {
                let (a, b, c) = ([x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]);
                triangles.push(if x * y * z > 0.0 { [a, b, c] } else { [a, c, b] });
            }
        }
    }
    let middle = |a: [f64; 3], b: [f64; 3]| along(a, 1.0, b).map(|x| x / 2.0);
    for _ in 0..levels {
        let divided = triangles.iter().flat_map(|&[a, b, c]| {
            let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        });
        triangles = divided.collect();
    }
    Figure::of(triangles)
}

/// A ball of 8·4^`levels` triangles: convex.
pub fn ball(levels: u32) -> Figure {
    octahedron(levels).map(|p| p.map(|x| x / length(p)))
}

/// A ball with dents, which a small ball in its middle does not touch.
pub fn dented(random: &mut Random, levels: u32) -> Figure {
    ball(levels).map(|p| {
        let radius = random.within(0.6, 1.4);
        p.map(|x| x * radius)
    })
}

/// The cube −1..1, each face in 2·`steps`² triangles.
pub fn cube(steps: u32) -> Figure {
    let place = |axis: usize, side: f64, u: u32, v: u32| {
        let share = |index: u32| f64::from(index) / f64::from(steps) * 2.0 - 1.0;
        let mut p = [side; 3];
        (p[(axis + 1) % 3], p[(axis + 2) % 3]) = (share(u), share(v));
        p
    };
    let mut triangles = Vec::new();
    for axis in 0..3 {
        for side in [1.0, -1.0] {
            for (u, v) in (0..steps).flat_map(|u| (0..steps).map(move |v| (u, v))) {
                let [a, b, c, d] = [(0, 0), (1, 0), (1, 1), (0, 1)]
                    .map(|(du, dv)| place(axis, side, u + du, v + dv));
                for [a, b, c] in [[a, b, c], [a, c, d]] {
                    triangles.push(if side > 0.0 { [a, b, c] } else { [a, c, b] });
                }
            }
        }
    }
    Figure::of(triangles)
}

/// A ring about the y axis of major radius 1.
pub fn ring(around: u32, across: u32, minor: f64) -> Figure {
    let place = |i: u32, j: u32| {
        let turn = std::f64::consts::TAU;
        let (a, b) = (
            turn * f64::from(i % around) / f64::from(around),
            turn * f64::from(j % across) / f64::from(across),
        );
        let distance = 1.0 + minor * b.cos();
        [distance * a.cos(), minor * b.sin(), distance * a.sin()]
    };
    let cells = (0..around).flat_map(|i| (0..across).map(move |j| (i, j)));
    Figure::of(cells.flat_map(|(i, j)| {
        let [a, b, c, d] =
            [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)].map(|(i, j)| place(i, j));
        [[a, b, c], [a, c, d]]
    }))
}

/// A mesh as a form, in the number format of a scene.
pub struct Made<S: Scalar> {
    pub points: Vec<S::Vec3>,
    pub triangles: Vec<[u32; 3]>,
}

impl<S: Scalar> Made<S> {
    pub fn new(figure: &Figure) -> Self {
        Self {
            points: figure.points.iter().map(|&p| vector::<S>(p)).collect(),
            triangles: figure.triangles.clone(),
        }
    }

    pub fn form(&self, closed: bool) -> Form<'_, S> {
        let points = Corners { values: &self.points, triangles: &self.triangles };
        Form::Mesh(Triangles { points, normals: None, uvs: None, closed })
    }
}

pub type Builder<S> = SceneBuilder<S, Heap>;

/// An empty scene with one material.
pub fn builder<S: Scalar>() -> Builder<S> {
    let mut builder = Builder::<S>::new();
    builder.material(Material::matte(Rgb::WHITE)).expect("room for a material");
    builder
}

/// A scene of one mesh.
pub fn scene_of<S: Scalar>(figure: &Figure, closed: bool) -> Builder<S> {
    let mut builder = builder::<S>();
    let form = Made::<S>::new(figure);
    builder.leaf(form.form(closed), &Affine::identity(), 0).expect("a legal mesh");
    builder
}

/// The mesh that is the first object of a scene.
pub fn mesh_of<S: Scalar>(scene: &Scene<'_, S>) -> Mesh {
    match scene.parts().nodes[0] {
        Node::Leaf(leaf) => match leaf.shape {
            Shape::Mesh(mesh) => mesh,
            other => panic!("not a mesh: {other:?}"),
        },
        Node::Operator { .. } => panic!("not a leaf"),
    }
}

/// The boundaries of an object along a ray, and whether its origin is inside.
pub fn spans<S: Scalar>(
    scene: &Scene<'_, S>,
    object: u32,
    ray: Ray<S>,
) -> (bool, Vec<Boundary<S>>) {
    let vacant =
        Boundary { t: S::ZERO, node: 0, face: 0, passage: Passage::Touch, inverted: false };
    let room = scene.room(object).expect("an object of the scene");
    let mut buffer = vec![vacant; room as usize];
    let spans = scene.spans(object, ray, &mut buffer).expect("room enough");
    (spans.inside, spans.boundaries.to_vec())
}

pub fn vector<S: Scalar>(v: [f64; 3]) -> S::Vec3 {
    S::Vec3::from_array(v.map(S::from_f64))
}

/// A ray from a point towards another, of unit length in fixed point.
pub fn ray<S: Scalar>(origin: [f64; 3], target: [f64; 3]) -> Ray<S> {
    let origin = vector::<S>(origin);
    let way = S::widen_vec(vector::<S>(target)) - S::widen_vec(origin);
    Ray { origin, dir: S::steer(way).0 }
}

/// Rays for each test: so many, or the share of as many as `NOSTRAY_RAYS` says in all.
pub fn rays(few: u32, share: f64) -> u32 {
    let all = std::env::var("NOSTRAY_RAYS").ok().and_then(|all| all.parse::<f64>().ok());
    all.map_or(few, |all| few.max((all * share) as u32))
}

//! Surfaces made of triangles and polygons have no gaps: along shared edges and vertices no
//! ray slips through, and away from edges every hit is where exact arithmetic has it.
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

use std::collections::HashMap;

use crate::oracle::{
    Float, Path, Point, Random, Real, along, array, cross, dot, length, point, sub, ulp, vector,
};
use nostray::ray::Line;
use nostray::shape::{Sight, Tables};
use nostray::{Affine, Axis, Polygon, Ray, Shape, Triangle, Vector};

/// A surface, with its edges to aim at.
struct Mesh<S: Float> {
    points: Vec<S::Vec3>,
    faces: Vec<Shape<S>>,
    edges: Vec<[S::Vec3; 2]>,
    size: f64,
}

impl<S: Float> Mesh<S> {
    fn new(size: f64) -> Self {
        Self { points: Vec::new(), faces: Vec::new(), edges: Vec::new(), size }
    }

    /// Adds a face: three vertices as a triangle, more as a polygon.
    fn face(&mut self, vertices: &[S::Vec3]) {
        let (first, count) = (self.points.len() as u32, vertices.len() as u32);
        self.points.extend(vertices);
        self.faces.push(if count == 3 {
            let corners = [first, first + 1, first + 2];
            Shape::Triangle(Triangle { corners, normals: Triangle::FLAT })
        } else {
            let normal = Polygon::<S>::newell(vertices);
            Shape::Polygon(Polygon { first, count, normal })
        });
        for i in 0..vertices.len() {
            self.edges.push([vertices[i], vertices[(i + 1) % vertices.len()]]);
        }
    }

    /// The t of every hit, before and behind the origin.
    fn hits(&self, ray: Ray<S>) -> Vec<f64> {
        let line = Line::new(ray, None);
        let tables = Tables { points: &self.points, ..Tables::EMPTY };
        let sight = Sight { line: &line, place: None, start: None, tables: &tables };
        let mut hits = Vec::new();
        for face in &self.faces {
            face.spans(&sight, |span| {
                assert!(span.enter.t.is_finite(), "{:?}", span.enter);
                hits.push(span.enter.t.to_f64());
            });
        }
        hits
    }

    /// A point of an edge, often its end.
    fn on_edge(&self, random: &mut Random) -> [f64; 3] {
        let [a, b] = self.edges[random.below(self.edges.len())].map(array::<S>);
        match random.below(3) {
            0 => a,
            1 => along(a, 0.5, along(b, -1.0, a)),
            _ => along(a, random.within(0.0, 1.0), along(b, -1.0, a)),
        }
    }
}

/// An octahedron divided into 8·4^`levels` triangles and dented at random.
fn dented<S: Float>(random: &mut Random, levels: u32, size: f64, center: [f64; 3]) -> Mesh<S> {
    let mut triangles = Vec::new();
    for x in [1.0, -1.0] {
        for y in [1.0, -1.0] {
            for z in [1.0, -1.0] {
                triangles.push([[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]]);
            }
        }
    }
    for _ in 0..levels {
        let middle = |a: [f64; 3], b: [f64; 3]| along(a, 1.0, b).map(|x| x / 2.0);
        triangles = triangles
            .iter()
            .flat_map(|&[a, b, c]| {
                let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    let mut moved = HashMap::new();
    let mut mesh = Mesh::new(size);
    for triangle in triangles {
        let vertices = triangle.map(|v| {
            *moved.entry(v.map(f64::to_bits)).or_insert_with(|| {
                let radius = size * random.within(0.7, 1.3) / length(v);
                vector::<S>(along(center, radius, v))
            })
        });
        mesh.face(&vertices);
    }
    mesh
}

/// A prism on a star: concave caps of 2·`points` vertices, sides as quadrangles and as pairs of
/// triangles by turns, turned and moved.
fn star<S: Float>(random: &mut Random, points: usize, size: f64, center: [f64; 3]) -> Mesh<S> {
    let mut map = Affine::<f64>::scale(nostray::glam::DVec3::splat(size));
    for axis in Axis::ALL {
        map = map.then(&Affine::rotate(axis, random.within(0.0, 360.0)));
    }
    let map = map.then(&Affine::translate(vector::<f64>(center)));
    let ring = |y: f64| -> Vec<S::Vec3> {
        (0..2 * points)
            .map(|i| {
                let angle = i as f64 * std::f64::consts::PI / points as f64;
                let radius = if i % 2 == 0 { 1.0 } else { 0.4 };
                let local = [radius * angle.cos(), y, radius * angle.sin()];
                vector::<S>(map.point(vector::<f64>(local)).to_array())
            })
            .collect()
    };
    let (low, high) = (ring(-0.5), ring(0.5));
    let mut mesh = Mesh::new(size);
    mesh.face(&low);
    mesh.face(&high);
    for i in 0..low.len() {
        let j = (i + 1) % low.len();
        if i % 3 == 0 {
            mesh.face(&[low[i], low[j], high[j], high[i]]);
        } else {
            mesh.face(&[low[i], low[j], high[j]]);
            mesh.face(&[low[i], high[j], high[i]]);
        }
    }
    mesh
}

fn meshes<S: Float>(seed: u64, mut check: impl FnMut(&mut Random, &Mesh<S>, [f64; 3])) {
    let mut random = Random::new(seed);
    for n in 0..20 {
        let size = random.decades(-4.0, 4.0);
        let center = random.cube().map(|x| x * size * 3.0);
        let mesh = if n % 2 == 0 {
            dented::<S>(&mut random, 2, size, center)
        } else {
            star::<S>(&mut random, 7, size, center)
        };
        check(&mut random, &mesh, center);
    }
}

/// Rays from inside at shared edges and vertices must hit something.
fn leaks<S: Float>(rays: u32) {
    let (mut leaks, mut shot) = (0, 0);
    meshes::<S>(1, |random, mesh, center| {
        for _ in 0..rays / 20 {
            let origin = vector::<S>(along(center, 0.2 * mesh.size, random.ball()));
            let target = mesh.on_edge(random);
            let dir = vector::<S>(along(target, -1.0, array::<S>(origin)));
            shot += 1;
            leaks += u32::from(!mesh.hits(Ray { origin, dir }).iter().any(|&t| t > 0.0));
        }
    });
    println!("{}: {leaks} leaks of {shot} rays at edges and vertices", S::NAME);
    assert!(leaks == 0 && shot >= rays);
}

#[test]
fn no_leaks() {
    leaks::<f32>(100_000);
    leaks::<f64>(20_000);
}

/// How near a line passes to an edge, relative to the size of what it spans.
fn clearance(path: &Path, edge: [Point; 2]) -> f64 {
    let axis = sub(&edge[1], &edge[0]);
    let from = sub(&path.origin, &edge[0]);
    let normal = cross(&path.dir, &axis);
    let square = dot(&normal, &normal);
    if square.sign() == 0 {
        return 0.0;
    }
    (dot(&from, &normal).abs() / square.sqrt()).to_f64()
}

/// Lines go into a closed surface as often as out of it, through edges and vertices too: a
/// point of an edge belongs to one of its faces.
fn parity<S: Float>(rays: u32) {
    let mut crossed = 0;
    meshes::<S>(2, |random, mesh, center| {
        for _ in 0..rays / 20 {
            let distance = random.decades(0.0, 3.0) * mesh.size;
            let dir = random.direction();
            let mut ray = Ray { origin: vector::<S>(center), dir: vector::<S>(dir) };
            if random.bits() & 1 == 0 {
                let target = along(center, mesh.size, random.ball());
                ray.origin = vector::<S>(along(target, -distance, dir));
            } else {
                // From a vertex or back to one, so that many edge functions are exactly 0.
                let target = mesh.on_edge(random);
                ray.origin = vector::<S>(along(target, -distance, dir));
                ray.dir = vector::<S>(along(target, -1.0, array::<S>(ray.origin)));
            }
            let hits = mesh.hits(ray);
            crossed += u32::from(!hits.is_empty());
            assert!(hits.len() % 2 == 0, "{hits:?}");
        }
    });
    assert!(crossed > rays / 3);
}

#[test]
fn even_hits() {
    parity::<f32>(100_000);
    parity::<f64>(20_000);
}

/// A simple concave polygon with whole coordinates in the plane z = x·a + y·b.
fn concave(random: &mut Random) -> Vec<[f64; 3]> {
    let (a, b) = (random.below(9) as f64 - 4.0, random.below(9) as f64 - 4.0);
    let count = 3 + random.below(10);
    (0..count)
        .map(|i| {
            let angle = (i as f64 + random.within(0.0, 0.8)) / count as f64 * 2.0;
            let (sin, cos) = (angle * std::f64::consts::PI).sin_cos();
            let radius = random.within(20.0, 200.0);
            let (x, y) = ((radius * cos).round(), (radius * sin).round());
            [x, y, a * x + b * y]
        })
        .collect()
}

/// Inside by the even-odd rule in the plane of x and y, from the definition.
fn holds(vertices: &[Point], p: &Point) -> bool {
    let mut inside = false;
    for i in 0..vertices.len() {
        let (a, b) = (&vertices[i], &vertices[(i + 1) % vertices.len()]);
        if (a[1] > p[1]) != (b[1] > p[1]) {
            let x = &a[0] + (&b[0] - &a[0]) * (&p[1] - &a[1]) / (&b[1] - &a[1]);
            inside ^= p[0] < x;
        }
    }
    inside
}

/// Faces one by one: hit or miss as exact arithmetic says, unless the ray passes within
/// rounding of an edge; t within ulp(t) + c·ε·reach/|n·d|.
fn faces<S: Float>(rays: u32) {
    let mut random = Random::new(3);
    let (mut worst, mut hits, mut compared) = (0.0_f64, 0, 0);
    let eps = S::EPSILON.to_f64();
    for _ in 0..rays {
        let corners = concave(&mut random);
        let vertices: Vec<_> = corners.iter().map(|&v| vector::<S>(v)).collect();
        let mut mesh = Mesh::<S>::new(200.0);
        mesh.face(&vertices);
        let exact: Vec<_> = vertices.iter().map(|&v| point::<S>(v)).collect();
        let normal = cross(&sub(&exact[1], &exact[0]), &sub(&exact[2], &exact[0]));
        let target = [0, 1, 2].map(|i| corners.iter().map(|v| v[i]).sum::<f64>());
        let target = target.map(|x| x / corners.len() as f64);
        let target = along(target, 100.0, random.ball());
        let distance = random.decades(0.0, 5.0);
        let (dir, speed) = (random.direction(), random.decades(-3.0, 3.0));
        let ray = Ray {
            origin: vector::<S>(along(target, -distance, dir)),
            dir: vector::<S>(dir.map(|x| x * speed)),
        };
        let path = Path::of(&ray);
        let speed = dot(&normal, &path.dir);
        if normal.iter().all(|x| x.sign() == 0) || speed.sign() == 0 {
            continue;
        }
        let t = dot(&normal, &sub(&exact[0], &path.origin)) / &speed;
        let p = [0, 1, 2].map(|i: usize| &path.origin[i] + &t * &path.dir[i]);
        let truth = holds(&exact, &p);
        let reach = distance + 1000.0;
        let clear = mesh
            .edges
            .iter()
            .all(|edge| clearance(&path, edge.map(point::<S>)) > 4.0 * eps * reach);
        let found = mesh.hits(ray);
        if clear {
            assert_eq!(found.len(), usize::from(truth), "{corners:?} {ray:?}");
            compared += 1;
        }
        for found in found {
            let rate = (&speed * &speed / dot(&normal, &normal)).sqrt().to_f64();
            let bound = ulp::<S>(t.to_f64()) + eps * reach / rate;
            worst = worst.max((Real::from(found) - &t).abs().to_f64() / bound);
            hits += 1;
        }
    }
    println!("{}: faces alone: {hits} hits, t error {worst:.2} of its bound", S::NAME);
    assert!(compared > rays * 9 / 10 && hits > rays / 4);
    assert!(worst <= 1.0, "{worst}");
}

#[test]
fn single_faces() {
    faces::<f32>(5_000);
    faces::<f64>(1_000);
}

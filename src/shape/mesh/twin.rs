//! The slow, obvious twin of a ray's way through a mesh: all triangles one after the other, all
//! crossings in one list, and inside or outside by counting. Both agree to the bit.

use super::course::Course;
use super::view::{Crossing, View};
use super::{Branch, Mesh};
use crate::ray::{Line, Ray, Start};
use crate::scalar::{Axis, Number, Real, Scalar, Vector};
use crate::scene::{Corners, Fixed, Form, SceneBuilder, Triangles};
use crate::shape::{Primitive, Shape, Sight, Tables};
use crate::solid::Node;
use crate::span::{End, Passage, Span};
use crate::{Affine, Material, Q16, Q32, Rgb};
extern crate std;
use std::collections::BTreeMap;
use std::vec::Vec;

/// Numbers that are the same in every run (SplitMix).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    /// In −1..1.
    fn number(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn cube(&mut self) -> [f64; 3] {
        [0; 3].map(|_| self.number())
    }
}

fn vector<S: Scalar>(v: [f64; 3]) -> S::Vec3 {
    S::Vec3::from_array(v.map(S::from_f64))
}

/// Points and triangles.
type Figure = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// An octahedron in 8·4^`levels` triangles, dented at random or with whole faces left flat.
fn octahedron(random: &mut Random, levels: u32, dents: f64) -> Figure {
    let mut triangles = Vec::new();
    for x in [1.0, -1.0] {
        for y in [1.0, -1.0] {
            for z in [1.0, -1.0] {
                let (a, b, c) = ([x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]);
                triangles.push(if x * y * z > 0.0 { [a, b, c] } else { [a, c, b] });
            }
        }
    }
    let middle = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|i: usize| (a[i] + b[i]) / 2.0);
    for _ in 0..levels {
        let divided = triangles.iter().flat_map(|&[a, b, c]| {
            let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        });
        triangles = divided.collect();
    }
    let (mut points, mut known) = (Vec::new(), BTreeMap::new());
    let indices = triangles.iter().map(|triangle| {
        triangle.map(|corner| {
            // Halves and quarters: exact in every format.
            let key = corner.map(|x| (x * 4096.0) as i64);
            *known.entry(key).or_insert_with(|| {
                let factor = 1.0 + dents * random.number();
                points.push(corner.map(|x| x * factor));
                points.len() as u32 - 1
            })
        })
    });
    let indices = indices.collect();
    (points, indices)
}

type Builder<S> = SceneBuilder<S, Fixed<1, 1, 1, 600, 4000, 0, 1000>>;

/// A scene of one mesh.
fn scene<S: Scalar>(figure: &Figure, size: f64, centre: [f64; 3], closed: bool) -> Builder<S> {
    let mut builder = Builder::<S>::new();
    builder.material(Material::matte(Rgb::WHITE)).unwrap();
    let place = |p: &[f64; 3]| vector::<S>([0, 1, 2].map(|i: usize| centre[i] + size * p[i]));
    let values: Vec<S::Vec3> = figure.0.iter().map(place).collect();
    let points = Corners { values: &values, triangles: &figure.1 };
    let form = Form::Mesh(Triangles { points, normals: None, uvs: None, closed });
    builder.leaf(form, &Affine::identity(), 0).unwrap();
    builder
}

/// The boundaries that follow from all crossings: where what is inside changes, from number to number.
fn boundaries<S: Scalar>(mut all: Vec<Crossing<S>>) -> Vec<(S, Passage)> {
    all.sort_by(|a, b| a.t.partial_cmp(&b.t).unwrap());
    let count = |t: S| all.iter().filter(|c| c.t == t).count();
    let inside = |t: S| {
        all.iter().filter(|c| c.t <= t).count() % 2 == 1 || count(t) > 1 && count(t) % 2 == 0
    };
    let mut places: Vec<S> = all.iter().flat_map(|c| [c.t, c.t.next_up()]).collect();
    places.sort_by(|a, b| a.partial_cmp(b).unwrap());
    places.dedup();
    let (mut state, mut found) = (false, Vec::new());
    for t in places {
        if inside(t) != state {
            state = !state;
            found.push((t, if state { Passage::Enter } else { Passage::Leave }));
        }
    }
    assert!(!state, "as often out as in");
    found
}

fn listed<S: Scalar>(mesh: &Mesh, sight: &Sight<'_, S>) -> Vec<Span<S>> {
    let mut spans = Vec::new();
    mesh.spans(sight, |span| spans.push(span));
    spans
}

/// The boundaries that spans tell of.
fn ends<S: Scalar>(spans: &[Span<S>], closed: bool) -> Vec<(End<S>, Passage)> {
    let both = |span: &Span<S>| [(span.enter, Passage::Enter), (span.exit, Passage::Leave)];
    if closed {
        spans.iter().flat_map(both).collect()
    } else {
        spans.iter().map(|span| (span.enter, Passage::Touch)).collect()
    }
}

/// What is asked for in parts is what the whole list has there.
fn compare_parts<S: Scalar>(
    random: &mut Random,
    (mesh, sight): (&Mesh, &Sight<'_, S>),
    list: &[(End<S>, Passage)],
) {
    let mut places = std::vec![S::ZERO, S::FAR, S::from_f64(random.number() * 8.0)];
    places.extend(list.iter().flat_map(|(end, _)| [end.t, end.t.next_up()]));
    for _ in 0..4 {
        let [after, before] = [0; 2].map(|_| places[random.below(places.len())]);
        let after = if sight.start.is_some() { after.max(S::ZERO) } else { after };
        let (inside, first) = Course::searching(mesh, sight).unwrap().first([after, before]);
        let passed =
            list.iter().filter(|(end, passage)| end.t <= after && *passage != Passage::Touch);
        assert_eq!(inside, passed.count() % 2 == 1, "{after} in {list:?}");
        let expected = list.iter().find(|(end, _)| end.t > after && end.t < before);
        assert_eq!(first, expected.copied(), "{after}..{before} in {list:?}");
        // A part of the list, but for where spans begin before it or end after it.
        let mut part = Vec::new();
        let course = Course::listing(mesh, sight).unwrap();
        course.spans([after, before], |span| part.push(span));
        let within = |(end, _): &(End<S>, Passage)| end.t > after && end.t <= before;
        let part: Vec<_> = ends(&part, mesh.closed).into_iter().filter(within).collect();
        let expected: Vec<_> = list.iter().copied().filter(within).collect();
        assert_eq!(part, expected, "{after}..{before} in {list:?}");
    }
}

/// One ray through a mesh, against its twins; the boundaries.
fn compare<S: Scalar>(
    random: &mut Random,
    mesh: &Mesh,
    tables: &Tables<'_, S>,
    fat: &[Branch<S>],
    line: &Line<S>,
) -> Vec<(End<S>, Passage)> {
    let sight = Sight { line, place: None, start: line.start.as_ref(), tables };
    let spans = listed(mesh, &sight);
    let list = ends(&spans, mesh.closed);
    for pair in list.windows(2) {
        assert!(pair[0].0.t < pair[1].0.t, "{list:?}");
    }
    // All boxes as large as the whole: every triangle is looked at.
    let every = Tables { branches: fat, ..*tables };
    assert_eq!(spans, listed(mesh, &Sight { tables: &every, ..sight }));
    if line.start.is_none() {
        let view = View::new(mesh, &sight).unwrap();
        let all: Vec<_> = (0..mesh.triangles).filter_map(|face| view.crossing(face)).collect();
        let places = list.iter().map(|&(end, passage)| (end.t, passage));
        if mesh.closed {
            assert_eq!(places.collect::<Vec<_>>(), boundaries(all));
        } else {
            let mut expected: Vec<S> = all.iter().map(|crossing| crossing.t).collect();
            expected.sort_by(|a, b| a.partial_cmp(b).unwrap());
            expected.dedup();
            assert_eq!(places.map(|(t, _)| t).collect::<Vec<_>>(), expected);
        }
    }
    compare_parts(random, (mesh, &sight), &list);
    list
}

/// A ray that is made to be hard: at vertices and edges, along axes, from within, from far away.
fn line<S: Scalar>(
    random: &mut Random,
    points: &[S::Vec3],
    size: f64,
    centre: [f64; 3],
) -> Line<S> {
    let around = |random: &mut Random, by: f64| {
        let v = random.cube();
        [0, 1, 2].map(|i: usize| centre[i] + size * by * v[i])
    };
    let corner = |random: &mut Random| points[random.below(points.len())];
    let target = match random.below(4) {
        0 => vector::<S>(around(random, 1.0)),
        1 => (corner(random) + corner(random)) * S::HALF,
        _ => corner(random),
    };
    let far = if random.below(8) == 0 { 100.0 } else { 4.0 };
    let mut origin = match random.below(4) {
        0 => vector::<S>(around(random, 0.5)),
        1 => corner(random),
        _ => vector::<S>(around(random, far)),
    };
    if random.below(3) == 0 {
        let axis = Axis::ALL[random.below(3)];
        origin = target.with(axis, origin.get(axis));
    }
    let mut dir = S::widen_vec(target) - S::widen_vec(origin);
    if dir == S::WideVec::ZERO {
        dir = dir.with(Axis::ALL[random.below(3)], S::Wide::ONE);
    }
    Line::new(Ray { origin, dir: S::steer(dir).0 }, None)
}

/// Rays that start where others met the mesh.
fn depart<S: Scalar>(
    random: &mut Random,
    mesh: &Mesh,
    tables: &Tables<'_, S>,
    line: &Line<S>,
    end: End<S>,
) -> Line<S> {
    let local = mesh.snap(line.recentred(S::Vec3::ZERO, end.t), end.face, tables);
    let normal = Primitive::<S>::normal(mesh, local, end.face, tables);
    let aside = S::widen_vec(vector::<S>(random.cube()));
    let lift = S::Wide::from_f64(random.number() * [1.0, 1e-3, 1e-7][random.below(3)]);
    let dir = S::steer(aside - normal * aside.dot(normal) + normal * lift).0;
    let inward = S::widen_dir(dir).dot(normal) < S::Wide::ZERO;
    let start = Start { node: 0, face: end.face, inward, local };
    Line::new(Ray { origin: local, dir }, Some(start))
}

fn compare_meshes<S: Scalar>(meshes: u64, rays: usize) {
    let (mut met, mut started) = (0, 0);
    for seed in 0..meshes {
        let mut random = Random(seed);
        let size = if S::REFINES {
            [1e-4, 1e-2, 1.0, 30.0, 1e4][random.below(5)]
        } else {
            1.0 + random.below(20) as f64
        };
        let offset = random.cube();
        let away = [0.0, 1.0, 10.0][random.below(3)];
        let centre = offset.map(|x| x * size * away);
        let dents = [0.0, 0.0, 0.1, 0.4][random.below(4)];
        let levels = random.below(3) as u32;
        let figure = octahedron(&mut random, levels, dents);
        let builder = scene::<S>(&figure, size, centre, seed % 3 > 0);
        let scene = builder.scene().unwrap();
        let Node::Leaf(leaf) = scene.parts().nodes[0] else { panic!("one leaf") };
        let Shape::Mesh(mesh) = leaf.shape else { panic!("a mesh") };
        let tables = &scene.parts().tables;
        let root = tables.branches[0].bounds;
        let fat: Vec<_> =
            tables.branches.iter().map(|branch| Branch { bounds: root, ..*branch }).collect();
        for _ in 0..rays {
            let line = line::<S>(&mut random, tables.points, size, centre);
            let list = compare(&mut random, &mesh, tables, &fat, &line);
            met += list.len();
            for (end, _) in list {
                let line = depart(&mut random, &mesh, tables, &line, end);
                started += compare(&mut random, &mesh, tables, &fat, &line).len();
            }
        }
    }
    assert!(met > rays && started > rays, "{met} {started}");
}

#[test]
fn ways_are_their_slow_twins_in_floats() {
    compare_meshes::<f32>(60, 200);
    compare_meshes::<f64>(60, 200);
}

#[test]
fn ways_are_their_slow_twins_in_fixed_point() {
    compare_meshes::<Q16>(20, 40);
    compare_meshes::<Q32>(20, 40);
}

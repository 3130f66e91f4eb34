//! Rays that start on a mesh: none meets the triangle that it starts on or one beside it by rounding, and
//! none loses the far side.

use nostray::ray::{Line, Start};
use nostray::shape::Sight;
use nostray::span::Span;
use nostray::{Hit, Mesh, Passage, Q16, Q32, Ray, Real as _, Scalar, Scene, Shape, Vector};

use super::figures::{self, Figure, mesh_of, ray, rays, scene_of, spans, vector};
use crate::oracle::{Random, along, length};

/// A ray that starts on a mesh.
struct Departure<S: Scalar> {
    ray: Ray<S>,
    start: Start<S>,
    /// The cosine between its direction and the normal.
    cosine: f64,
}

/// A ray from where another one, aimed at an edge or a vertex as often as not, meets the mesh.
fn departure<S: Scalar>(
    random: &mut Random,
    scene: &Scene<'_, S>,
    figure: &Figure,
    [size, reach]: [f64; 2],
    center: [f64; 3],
) -> Option<Departure<S>> {
    let origin = along(center, size * reach, random.direction());
    let target = match random.below(2) {
        0 => along(center, size, random.ball()),
        _ => figure.on_edge(random),
    };
    let first = ray::<S>(origin, target);
    let (_, list) = spans(scene, 0, first);
    let boundary = *list.get(random.below(list.len().max(1)))?;
    let contact = scene.contact(first, &Hit { object: 0, boundary })?;
    let normal = S::widen_dir(contact.normal).to_array().map(|x| x.to_f64());
    let mut dir = random.direction();
    if random.below(2) == 0 {
        // Grazing.
        let least = if S::NAME == "q16" { -4.0 } else { -6.0 };
        let tilt = (0..3).map(|i| dir[i] * normal[i]).sum::<f64>();
        dir = along(dir, random.decades(least, -1.0) * random.sign() - tilt, normal);
    }
    let size = length(dir);
    let dir = S::steer(S::WideVec::from_array(dir.map(|x| S::Wide::from_f64(x / size)))).0;
    let cosine = S::widen_dir(dir).dot(S::widen_dir(contact.normal)).to_f64();
    let start = Start { node: 0, face: boundary.face, inward: cosine < 0.0, local: contact.local };
    Some(Departure { ray: Ray { origin: contact.position, dir }, start, cosine })
}

/// The spans of a ray that starts on the mesh.
fn ahead<S: Scalar>(
    scene: &Scene<'_, S>,
    mesh: Mesh,
    ray: Ray<S>,
    start: Start<S>,
) -> Vec<Span<S>> {
    let line = Line::new(ray, Some(start));
    let tables = &scene.parts().tables;
    let sight = Sight { line: &line, place: None, start: line.start.as_ref(), tables };
    let mut found = Vec::new();
    Shape::Mesh(mesh).spans(&sight, |span| found.push(span));
    found
}

/// The size of a figure, how far from it rays come, and where it stands.
fn standing<S: Scalar>(random: &mut Random) -> (f64, f64, [f64; 3]) {
    let size = if S::REFINES { random.decades(-3.0, 3.0) } else { random.decades(0.5, 2.0) };
    let reach = if S::REFINES { random.decades(0.3, 2.0) } else { 3.0 };
    (size, reach, random.cube().map(|x| x * size * 2.0))
}

/// Convex meshes: nothing ahead of a ray that goes outward, and one end of one that goes inward.
fn convex<S: Scalar>(count: u32) {
    let (mut random, mut outward, mut inward) = (Random::new(6), 0, 0);
    for n in 0..24 {
        let figure = match n % 4 {
            0 => figures::ball(3),
            1 => figures::cube(1 + n % 3),
            2 => figures::cube(6),
            _ => figures::octahedron(n % 3).map(|[x, y, z]| [x, 0.2 * y, 0.6 * z]),
        };
        let (size, reach, center) = standing::<S>(&mut random);
        let figure = figure.placed(size, center);
        let builder = scene_of::<S>(&figure, true);
        let scene = builder.scene().expect("a legal scene");
        let mesh = mesh_of(&scene);
        for _ in 0..count.div_ceil(24) {
            let from = departure::<S>(&mut random, &scene, &figure, [size, reach], center);
            let Some(Departure { ray, start, cosine }) = from else { continue };
            let spans = ahead(&scene, mesh, ray, start);
            if !start.inward {
                assert!(spans.is_empty(), "{n}: a self-hit: {cosine} {spans:?}");
                outward += 1;
                continue;
            }
            let [Span { enter, exit }] = spans[..] else {
                panic!("{n}: one exit: {cosine} {spans:?}")
            };
            assert!(enter.t == S::ZERO && enter.face == start.face, "{enter:?}");
            assert!(exit.t > S::ZERO && exit.t < S::FAR, "{exit:?}");
            let way =
                exit.t.to_f64() * length(S::widen_dir(ray.dir).to_array().map(|x| x.to_f64()));
            assert!(way < 4.0 * size, "{way} {size}");
            inward += 1;
        }
    }
    println!("{}: {outward} rays outward without a hit, {inward} inward with one exit", S::NAME);
    assert!(outward > count / 6 && inward > count / 6, "{outward} {inward}");
}

#[test]
fn convex_meshes_are_left_once() {
    convex::<f32>(rays(20_000, 0.2));
    convex::<f64>(rays(5_000, 0.1));
    convex::<Q16>(rays(1_000, 0.01));
    convex::<Q32>(rays(1_000, 0.01));
}

/// Where a ray meets the plane of a triangle, and how far outside of the triangle at most, in shares.
fn plainly([a, b, c]: [[f64; 3]; 3], origin: [f64; 3], dir: [f64; 3]) -> (f64, f64) {
    let sub = |p: [f64; 3], q: [f64; 3]| along(p, -1.0, q);
    let cross = |p: [f64; 3], q: [f64; 3]| {
        [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
    };
    let dot = |p: [f64; 3], q: [f64; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    let normal = cross(sub(b, a), sub(c, a));
    let t = dot(normal, sub(a, origin)) / dot(normal, dir);
    let p = along(origin, t, dir);
    let square = dot(normal, normal);
    let share =
        |p: [f64; 3], q: [f64; 3], r: [f64; 3]| dot(cross(sub(q, p), sub(r, p)), normal) / square;
    let shares = [share(a, b, p), share(b, c, p), share(c, a, p)];
    (t, shares.into_iter().fold(0.0, |most, share| if -share > most { -share } else { most }))
}

/// The same of all triangles but one, and whether they share a point with that one.
fn all_plainly(
    figure: &Figure,
    points: &[[f64; 3]],
    but: u32,
    origin: [f64; 3],
    dir: [f64; 3],
) -> Vec<(f64, f64, bool)> {
    let own = figure.triangles[but as usize];
    let others = (0..).zip(&figure.triangles).filter(|&(face, _)| face != but);
    others
        .map(|(_, triangle)| {
            let (t, outside) = plainly(triangle.map(|i| points[i as usize]), origin, dir);
            (t, outside, triangle.iter().any(|i| own.contains(i)))
        })
        .collect()
}

/// Rings and dented balls. Going in and out by turns; where the mesh bulges around the start, nothing near is met by a
/// ray that goes outward; and what plain double arithmetic says without doubt is so.
fn bent<S: Scalar>(count: u32, near: f64) {
    let (mut random, mut clear, mut sure) = (Random::new(7), 0, 0);
    for n in 0..12 {
        let (size, reach, center) = standing::<S>(&mut random);
        let figure =
            if n % 2 == 0 { figures::ring(24, 12, 0.4) } else { figures::dented(&mut random, 2) };
        let figure = figure.placed(size, center);
        let builder = scene_of::<S>(&figure, true);
        let scene = builder.scene().expect("a legal scene");
        let mesh = mesh_of(&scene);
        let points: Vec<[f64; 3]> =
            scene.parts().tables.points.iter().map(|p| p.to_array().map(|x| x.to_f64())).collect();
        let corners = |face: u32| figure.triangles[face as usize].map(|i| points[i as usize]);
        for _ in 0..count.div_ceil(12) {
            let from = departure::<S>(&mut random, &scene, &figure, [size, reach], center);
            let Some(Departure { ray, start, cosine }) = from else { continue };
            let spans = ahead(&scene, mesh, ray, start);
            assert!(spans.windows(2).all(|pair| pair[0].exit.t < pair[1].enter.t), "{spans:?}");
            assert!(spans.iter().all(|span| span.enter.t < span.exit.t && span.exit.t < S::FAR));
            let begins = spans.first().is_some_and(|span| span.enter.t == S::ZERO);
            assert_eq!(begins, start.inward, "{cosine} {spans:?}");
            let mut ends: Vec<f64> =
                spans.iter().flat_map(|s| [s.enter.t, s.exit.t]).map(|t| t.to_f64()).collect();
            if start.inward {
                ends.remove(0);
            }
            let origin = ray.origin.to_array().map(|x| x.to_f64());
            let dir = S::widen_dir(ray.dir).to_array().map(|x| x.to_f64());
            let own = figure.triangles[start.face as usize];
            let all = all_plainly(&figure, &points, start.face, origin, dir);
            let mut plain = all.clone();
            plain.retain(|&(_, outside, _)| outside < near);
            plain.sort_by(|a, b| a.0.total_cmp(&b.0));
            // Everything around bulges, and nothing else is near: no hit nearby.
            let [a, b, c] = corners(start.face);
            let bulges = figure.triangles.iter().filter(|t| t.iter().any(|i| own.contains(i)));
            let bulges = bulges.flatten().all(|&i| {
                let apex = points[i as usize];
                let (t, _) = plainly([a, b, c], apex, normal_of([a, b, c]));
                t >= 0.0 || own.contains(&i)
            });
            let far = plain.iter().all(|&(t, _, beside)| beside || t.abs() > 0.05 * size);
            if !start.inward && bulges && far {
                assert!(!ends.first().is_some_and(|&t| t < 0.04 * size), "{cosine} {ends:?}");
                clear += 1;
            }
            // No doubt about anything: away from edges and from the start.
            let doubtful = plain.iter().any(|&(t, _, _)| t.abs() < 0.01 * size)
                || all.iter().any(|&(_, outside, _)| outside > 0.0 && outside < near)
                || cosine.abs() < 0.01;
            if !doubtful {
                let expected: Vec<f64> =
                    plain.iter().map(|&(t, _, _)| t).filter(|&t| t > 0.0).collect();
                let inside = plain.iter().all(|&(_, outside, _)| outside == 0.0);
                if inside {
                    assert_eq!(ends.len(), expected.len(), "{ends:?} {expected:?}");
                    for (end, expected) in ends.iter().zip(&expected) {
                        assert!((end - expected).abs() < 0.1 * size, "{ends:?} {expected:?}");
                    }
                    sure += 1;
                }
            }
        }
    }
    println!("{}: {clear} rays clear of what is beside the start, {sure} beyond doubt", S::NAME);
    assert!(clear > count / 40 && sure > count / 20, "{clear} {sure}");
}

fn normal_of([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let (u, v) = (along(b, -1.0, a), along(c, -1.0, a));
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

#[test]
fn bent_meshes_are_left_and_met_again() {
    bent::<f32>(rays(3_000, 0.02), 1e-3);
    bent::<f64>(rays(3_000, 0.02), 1e-6);
    bent::<Q16>(rays(600, 0.005), 1e-2);
    bent::<Q32>(rays(600, 0.005), 1e-5);
}

/// The same surface without an inside: outward nothing, inward the far side, unless that is at the start itself: at an edge
/// a ray may go in and out within `near`.
fn open<S: Scalar>(count: u32, near: f64) {
    let (mut random, mut outward, mut inward) = (Random::new(8), 0, 0);
    let mut at_once = 0;
    for _ in 0..12 {
        let (size, reach, center) = standing::<S>(&mut random);
        let figure = figures::ball(2).placed(size, center);
        let builder = scene_of::<S>(&figure, false);
        let scene = builder.scene().expect("a legal scene");
        let mesh = mesh_of(&scene);
        let solid = Mesh { closed: true, ..mesh };
        for _ in 0..count.div_ceil(12) {
            let from = departure::<S>(&mut random, &scene, &figure, [size, reach], center);
            let Some(Departure { ray, start, cosine }) = from else { continue };
            let spans = ahead(&scene, mesh, ray, start);
            let ascends = |pair: &[Span<S>]| pair[0].enter.t < pair[1].enter.t;
            assert!(spans.windows(2).all(ascends) && spans.iter().all(|s| s.enter == s.exit));
            if start.inward {
                let exit = ahead(&scene, solid, ray, start)[0].exit.t.to_f64();
                let leaves_at_once = exit < near * size;
                assert!(leaves_at_once || spans.len() == 1, "{cosine} {exit} {spans:?}");
                at_once += u32::from(leaves_at_once);
                inward += 1;
            } else {
                assert!(spans.is_empty(), "a self-hit: {cosine} {spans:?}");
                outward += 1;
            }
        }
    }
    println!("{}: {outward} rays outward, {inward} inward, {at_once} of them out at once", S::NAME);
    assert!(outward > count / 6 && inward > count / 6 && at_once < inward / 2);
}

#[test]
fn open_meshes_are_left_too() {
    open::<f32>(rays(10_000, 0.1), 1e-4);
    open::<f64>(rays(2_000, 0.02), 1e-12);
    open::<Q16>(rays(500, 0.005), 1e-2);
    open::<Q32>(rays(500, 0.005), 1e-6);
}

/// A plate far thinner than rounding would let an epsilon be: through it and out again.
#[test]
fn thin_plates_have_two_sides() {
    let mut random = Random::new(12);
    let figure = figures::cube(3).map(|[x, y, z]| [x, 1e-5 * y, z]);
    let builder = scene_of::<f32>(&figure, true);
    let scene = builder.scene().expect("a legal scene");
    let mesh = mesh_of(&scene);
    for _ in 0..2_000 {
        let from = departure::<f32>(&mut random, &scene, &figure, [1.0, 3.0], [0.0; 3]);
        let Some(Departure { ray, start, .. }) = from else { continue };
        let spans = ahead(&scene, mesh, ray, start);
        assert_eq!(spans.len(), usize::from(start.inward), "{spans:?}");
    }
    // From far away it is one step thick, or more.
    let far = ray::<f32>([0.1, 3e4, 0.2], [0.1, 0.0, 0.2]);
    let (_, list) = spans(&scene, 0, far);
    assert_eq!(list.len(), 2);
    assert_eq!([list[0].passage, list[1].passage], [Passage::Enter, Passage::Leave]);
    assert!(list[0].t < list[1].t && list[1].t <= list[0].t.next_up().max(list[0].t * 1.000_001));
    assert_eq!(vector::<f32>([0.0; 3]), nostray::glam::Vec3::ZERO);
}

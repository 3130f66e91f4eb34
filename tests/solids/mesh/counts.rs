//! How often a ray meets a mesh, and where.

use nostray::{Passage, Q16, Q32, Ray, Scalar, Vector};

use super::figures::{self, Builder, Figure, mesh_of, ray, rays, scene_of, spans};
use crate::oracle::{
    Float, Path, Point, Random, Real, along, array, cross, dot, point, sub, ulp, vector,
};

/// Closed meshes of all kinds and sizes, each with its middle.
fn closed<S: Scalar>(random: &mut Random, n: u32) -> (Figure, f64, [f64; 3]) {
    let fixed = !S::REFINES;
    let size = if fixed { random.decades(0.0, 2.0) } else { random.decades(-4.0, 4.0) };
    let center = random.cube().map(|x| x * size * 3.0);
    let figure = match n % 4 {
        0 => figures::dented(random, 2),
        1 => figures::ball(2),
        2 => figures::cube(1 + n % 5),
        _ => figures::octahedron(2).map(|p| [p[0], p[1] * 0.001, p[2] * 0.3]),
    };
    (figure.placed(size, center), size, center)
}

/// From inside at edges and vertices: the ray is inside, and leaves before it enters.
fn leaks<S: Scalar>(count: u32) {
    let (mut random, mut shot) = (Random::new(1), 0);
    for n in 0..20 {
        let (figure, size, center) = closed::<S>(&mut random, if n % 4 == 3 { 0 } else { n });
        let builder = scene_of::<S>(&figure, true);
        let scene = builder.scene().expect("a legal scene");
        for _ in 0..count.div_ceil(20) {
            let origin = along(center, 0.2 * size, random.ball());
            let (inside, list) = spans(&scene, 0, ray::<S>(origin, figure.on_edge(&mut random)));
            let first = list.first().map(|boundary| boundary.passage);
            assert!(inside && first == Some(Passage::Leave), "{inside} {list:?}");
            shot += 1;
        }
    }
    println!("{}: no leak of {shot} rays at edges and vertices", S::NAME);
}

#[test]
fn no_ray_leaks_out() {
    leaks::<f32>(rays(20_000, 0.4));
    leaks::<f64>(rays(5_000, 0.1));
    leaks::<Q16>(rays(500, 0.01));
    leaks::<Q32>(rays(500, 0.01));
}

/// Lines through edges and vertices, from far and near, also within faces: every boundary ends what
/// the one before began.
fn evenness<S: Scalar>(count: u32) {
    let (mut random, mut met) = (Random::new(2), 0);
    for n in 0..20 {
        let (figure, size, center) = closed::<S>(&mut random, n);
        let builder = scene_of::<S>(&figure, true);
        let scene = builder.scene().expect("a legal scene");
        for _ in 0..count.div_ceil(20) {
            let target = figure.on_edge(&mut random);
            let reach =
                if S::REFINES { random.decades(0.0, 5.0) } else { random.decades(0.0, 1.0) };
            let origin = match random.below(4) {
                0 => figure.on_edge(&mut random),
                1 => {
                    let mut beside = target;
                    beside[random.below(3)] += size * reach;
                    beside
                }
                _ => along(center, size * reach, random.direction()),
            };
            if origin == target {
                continue;
            }
            let (mut state, list) = spans(&scene, 0, ray::<S>(origin, target));
            met += u32::from(!list.is_empty());
            let mut last = S::ZERO;
            for boundary in &list {
                assert!(boundary.t > last, "{list:?}");
                assert_eq!(boundary.passage == Passage::Leave, state, "{list:?}");
                (state, last) = (!state, boundary.t);
            }
            assert!(!state, "{list:?}");
        }
    }
    println!("{}: {met} rays at edges and vertices, all even", S::NAME);
    assert!(met > count / 4);
}

#[test]
fn boundaries_come_in_pairs() {
    evenness::<f32>(rays(20_000, 0.4));
    evenness::<f64>(rays(5_000, 0.1));
    evenness::<Q16>(rays(500, 0.01));
    evenness::<Q32>(rays(500, 0.01));
}

/// Where a line meets a triangle, exactly: t, and how fast it goes through the plane; `None` beside it, and
/// an error within `margin` of an edge, as a share of the product of the lengths.
fn exact(path: &Path, corners: &[Point; 3], margin: f64) -> Result<Option<(Real, f64)>, ()> {
    let [a, b, c] = [0, 1, 2].map(|i| sub(&corners[i], &path.origin));
    let mut signs = [0; 3];
    for (sign, (p, q)) in signs.iter_mut().zip([(&a, &b), (&b, &c), (&c, &a)]) {
        let edge = sub(q, p);
        let normal = cross(&path.dir, &edge);
        let side = dot(p, &normal);
        // The distance of the line from that of the edge.
        let square = dot(&normal, &normal);
        if (&side * &side - &square * Real::from(margin * margin)).sign() <= 0 {
            return Err(());
        }
        *sign = side.sign();
    }
    if signs[0] != signs[1] || signs[1] != signs[2] {
        return Ok(None);
    }
    let normal = cross(&sub(&b, &a), &sub(&c, &a));
    let speed = dot(&normal, &path.dir);
    let rate = (&speed * &speed / dot(&normal, &normal)).sqrt().to_f64();
    Ok(Some((dot(&normal, &a) / &speed, rate)))
}

/// The same rays against exact arithmetic: as many crossings where none is within rounding of an
/// edge, and each t within its bound.
fn counts<S: Float>(count: u32) {
    let (mut random, eps) = (Random::new(3), S::EPSILON.to_f64());
    let (mut worst, mut compared, mut met) = (0.0_f64, 0, 0);
    let per = 40;
    for n in 0..count.div_ceil(per) {
        let (figure, size, center) = closed::<S>(&mut random, n);
        let is_closed = n % 3 > 0;
        let builder: Builder<S> = scene_of::<S>(&figure, is_closed);
        let scene = builder.scene().expect("a legal scene");
        let (mesh, points) = (mesh_of(&scene), scene.parts().tables.points);
        let corners: Vec<[Point; 3]> = figure
            .triangles
            .iter()
            .map(|triangle| triangle.map(|index| point::<S>(points[index as usize])))
            .collect();
        assert_eq!(mesh.triangles as usize, corners.len());
        for _ in 0..per {
            let reach = random.decades(0.0, 5.0);
            let origin = along(center, size * reach, random.direction());
            let target = along(center, size, random.ball());
            let way = along(target, -1.0, origin);
            let speed = random.decades(-3.0, 3.0);
            let dir = vector::<S>(way.map(|x| x * speed));
            let ray = Ray { origin: vector::<S>(origin), dir };
            let path = Path::of(&ray);
            let span = size + figures_reach(center);
            let exact: Result<Vec<_>, ()> =
                corners.iter().map(|corners| exact(&path, corners, 16.0 * eps * span)).collect();
            let Ok(exact) = exact else { continue };
            let mut expected: Vec<_> = exact.into_iter().flatten().collect();
            expected.retain(|(t, _)| t.sign() > 0);
            expected.sort_by(|a, b| a.0.partial_cmp(&b.0).expect("numbers"));
            let (_, list) = spans(&scene, 0, ray);
            compared += 1;
            let thin = expected.windows(2).any(|pair| {
                let gap = (&pair[1].0 - &pair[0].0).to_f64();
                gap <= 4.0 * ulp::<S>(pair[1].0.to_f64())
            });
            assert!(thin || list.len() == expected.len(), "{list:?} {expected:?}");
            if list.len() != expected.len() {
                continue;
            }
            let speed = array::<S>(ray.dir).iter().map(|x| x * x).sum::<f64>().sqrt();
            for (boundary, (t, rate)) in list.iter().zip(&expected) {
                let error = (Real::of(boundary.t) - t).abs().to_f64();
                // Rounded at the end; and what is off beside the plane, or along the ray.
                let bound = ulp::<S>(t.to_f64()) + 4.0 * eps * span * (1.0 / rate + 1.0 / speed);
                worst = worst.max(error / bound);
                met += 1;
            }
        }
    }
    println!("{}: {compared} rays, {met} hits, t error {worst:.2} of its bound", S::NAME);
    assert!(compared > count * 3 / 4 && met > count, "{compared} {met}");
    assert!(worst <= 1.0, "{worst}");
}

fn figures_reach(center: [f64; 3]) -> f64 {
    center.iter().fold(0.0, |reach, x| x.abs().max(reach))
}

#[test]
fn hits_are_where_exact_arithmetic_has_them() {
    counts::<f32>(rays(1_200, 0.01));
    counts::<f64>(rays(400, 0.005));
}

/// The triangle that a ray is said to enter faces it, and that where it leaves looks away.
#[test]
fn faces_face_the_ray() {
    let (mut random, mut met) = (Random::new(5), 0);
    let figure = figures::ball(3);
    let builder = scene_of::<f64>(&figure, true);
    let scene = builder.scene().expect("a legal scene");
    for _ in 0..500 {
        let origin = random.direction().map(|x| 5.0 * x);
        let ray = ray::<f64>(origin, random.ball());
        for boundary in spans(&scene, 0, ray).1 {
            let hit = nostray::Hit { object: 0, boundary };
            let contact = scene.contact(ray, &hit).expect("a hit of this scene");
            let cosine = Vector::dot(contact.normal, ray.dir);
            assert_eq!(cosine < 0.0, boundary.passage == Passage::Enter);
            let corners = figure.corners(boundary.face as usize).map(vector::<f64>);
            let height = Vector::dot(contact.normal, contact.position - corners[0]);
            assert!(height.abs() < 1e-12, "{height}");
            met += 1;
        }
    }
    assert!(met > 600);
}

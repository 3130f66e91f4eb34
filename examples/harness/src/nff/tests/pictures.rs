//! Scenes in the manner of the Standard Procedural Databases, against slow twins.

use std::fmt::Write;

use nostray::glam::DVec3;
use nostray::{Pixel, Projection};

use super::{draw, read};
use crate::nff::NffScene;
use crate::triangulate::triangulate;

const SIDE: u32 = 64;
const SKY: [f64; 3] = [0.5, 0.25, 0.125];
/// Where the views below stand.
const EYE: DVec3 = DVec3::new(1.3, -6.0, 3.1);

/// A view of the origin that no edge of the scenes below lies along, and a surface that is never the sky.
fn view() -> String {
    format!(
        "b {} {} {} v from {} {} {} at 0 0 0 up 0 0 1 angle 40\nl 3 -9 8 f 1 0 1 1 0 1 0 0\n",
        SKY[0], SKY[1], SKY[2], EYE.x, EYE.y, EYE.z
    )
}

/// The unit direction through the middle of a pixel, as the format defines the view.
fn direction(x: u32, y: u32) -> DVec3 {
    let forward = (-EYE).normalize();
    let right = forward.cross(DVec3::Z).normalize();
    let up = right.cross(forward);
    let half = (20_f64).to_radians().tan();
    let share = |index: u32| (f64::from(index) + 0.5) / f64::from(SIDE) * 2.0 - 1.0;
    forward + right * (half * share(x)) - up * (half * share(y))
}

fn is_sky(pixel: &Pixel<f64>) -> bool {
    pixel.color.to_array() == SKY
}

/// The line of sight to a point does not end in the sky.
fn is_seen(scene: &NffScene<f64>, point: DVec3) -> bool {
    let mut scene = scene.clone();
    scene.builder.camera.look_at = point;
    !is_sky(&draw(&scene, 1, 1)[0])
}

/// How often a closed outline turns around a point: the sum of the signed angles.
fn winding(outline: &[[f64; 2]], [x, y]: [f64; 2]) -> i32 {
    let ends = outline.iter().zip(outline.iter().cycle().skip(1));
    let angle: f64 = ends
        .map(|(a, b)| {
            let (a, b) = ([a[0] - x, a[1] - y], [b[0] - x, b[1] - y]);
            (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1])
        })
        .sum();
    (angle / std::f64::consts::TAU).round() as i32
}

/// The ray through a pixel meets a plane polygon: its plane, then the winding number there.
fn meets(polygon: &[DVec3], dir: DVec3) -> bool {
    let (a, b, c) = (polygon[0], polygon[1], polygon[2]);
    let normal = (b - a).cross(c - b).normalize();
    let u = (b - a).normalize();
    let v = normal.cross(u);
    let flat = |p: DVec3| [(p - a).dot(u), (p - a).dot(v)];
    let t = (a - EYE).dot(normal) / dir.dot(normal);
    let outline: Vec<_> = polygon.iter().map(|&p| flat(p)).collect();
    t > 0.0 && winding(&outline, flat(EYE + dir * t)) != 0
}

fn write_polygon(text: &mut String, vertices: &[DVec3]) {
    writeln!(text, "p {}", vertices.len()).expect("text grows");
    for v in vertices {
        writeln!(text, "{} {} {}", v.x, v.y, v.z).expect("text grows");
    }
}

/// The polygons as a file, drawn and compared with the twin in every pixel. Gives the scene
/// and the share of the picture that they cover.
fn compare(polygons: &[Vec<DVec3>]) -> (NffScene<f64>, f64) {
    let mut text = view();
    for polygon in polygons {
        write_polygon(&mut text, polygon);
    }
    let scene = read(&text);
    let mut covered = 0;
    for pixel in draw(&scene, SIDE, SIDE) {
        let dir = direction(pixel.x, pixel.y);
        let expected = polygons.iter().any(|polygon| meets(polygon, dir));
        assert_eq!(!is_sky(&pixel), expected, "column {}, row {}", pixel.x, pixel.y);
        covered += u32::from(expected);
    }
    (scene, f64::from(covered) / f64::from(SIDE * SIDE))
}

fn object_count(scene: &NffScene<f64>) -> usize {
    scene.builder.scene().expect("legal").parts().objects.len()
}

/// The faces of a tetrahedron whose edges are halved again and again, as `tetra` does.
fn tetra(corners: [DVec3; 4], depth: u32, faces: &mut Vec<Vec<DVec3>>) {
    let [a, b, c, d] = corners;
    if depth == 0 {
        faces.extend([vec![a, b, c], vec![a, c, d], vec![a, d, b], vec![b, d, c]]);
        return;
    }
    for corner in corners {
        tetra(corners.map(|other| (other + corner) * 0.5), depth - 1, faces);
    }
}

#[test]
fn tetra_of_triangles() {
    let mut faces = Vec::new();
    let corner = |x, y, z| DVec3::new(x, y, z) * 1.7;
    let corners =
        [corner(1., 1., 1.), corner(-1., -1., 1.), corner(-1., 1., -1.), corner(1., -1., -1.)];
    tetra(corners, 3, &mut faces);
    let (scene, covered) = compare(&faces);
    assert_eq!(object_count(&scene), 256);
    assert!(covered > 0.1 && covered < 0.5, "{covered}");
}

/// A toothed outline: two vertices out, two in, for each tooth.
fn gear(teeth: u32, z: f64) -> Vec<DVec3> {
    let vertex = |i: u32| {
        let angle = (f64::from(i) + 0.3) * std::f64::consts::TAU / f64::from(4 * teeth);
        let radius = if i % 4 < 2 { 1.9 } else { 1.3 };
        DVec3::new(radius * angle.cos(), radius * angle.sin(), z)
    };
    (0..4 * teeth).map(vertex).collect()
}

#[test]
fn gear_of_concave_polygons() {
    let (lower, upper) = (gear(9, -0.2), gear(9, 0.3));
    let (scene, covered) = compare(std::slice::from_ref(&upper));
    assert_eq!(object_count(&scene), 1);
    assert!(covered > 0.1 && covered < 0.4, "{covered}");
    // The middle of a tooth is the gear, that of a notch is the sky.
    for i in 0..9 {
        let between = |a: usize| (upper[4 * i + a] + upper[(4 * i + a + 1) % 36]) * 0.5;
        for (point, tooth) in [(between(0) * 0.97, true), (between(2) * 1.15, false)] {
            assert_eq!(is_seen(&scene, point.with_z(0.3)), tooth, "tooth {i}");
        }
    }
    // With its flanks: as many quadrilaterals as vertices.
    let mut faces = vec![lower.clone(), upper.clone()];
    for i in 0..upper.len() {
        let next = (i + 1) % upper.len();
        faces.push(vec![lower[i], lower[next], upper[next], upper[i]]);
    }
    let (scene, solid) = compare(&faces);
    assert_eq!(object_count(&scene), 38);
    assert_eq!(scene.skipped, 0);
    assert!(solid > covered);
}

#[test]
fn bent_polygons_become_triangles() {
    // Seen straight from above in parallel, a polygon's height does not matter.
    for (teeth, bend) in [(3, 0.05), (7, 0.2), (12, 0.4)] {
        let flat = gear(teeth, 0.0);
        let lift = |(i, v): (usize, &DVec3)| v.with_z(bend * f64::from((i * i % 7) as u32));
        let bent: Vec<_> = flat.iter().enumerate().map(lift).collect();
        let outline: Vec<_> = flat.iter().map(|v| [v.x, v.y]).collect();
        for backwards in [false, true] {
            let vertices: Vec<_> =
                if backwards { bent.iter().rev().copied().collect() } else { bent.clone() };
            let mut text = view();
            write_polygon(&mut text, &vertices);
            let mut scene = read(&text);
            assert_eq!(object_count(&scene), vertices.len() - 2);
            assert_eq!(scene.skipped, 0);
            let camera = &mut scene.builder.camera;
            (camera.eye, camera.look_at, camera.up) = (DVec3::Z * 99.0, DVec3::ZERO, DVec3::Y);
            camera.projection = Projection::Orthographic { height: 4.0 };
            for pixel in draw(&scene, SIDE, SIDE) {
                let share = |i: u32| (f64::from(i) + 0.5) / f64::from(SIDE) * 4.0 - 2.0;
                let inside = winding(&outline, [share(pixel.x), -share(pixel.y)]) != 0;
                assert_eq!(!is_sky(&pixel), inside, "column {}, row {}", pixel.x, pixel.y);
            }
        }
    }
}

#[test]
fn triangles_tile_their_polygon() {
    let comb = |teeth: u32| -> Vec<[f64; 2]> {
        let tooth = |i: u32| {
            let x = f64::from(i);
            [[x, 0.0], [x + 0.25, 2.0], [x + 0.5, 0.0], [x + 0.75, 0.1]]
        };
        let last = [[f64::from(teeth), 0.0], [f64::from(teeth), -1.0], [0.0, -1.0]];
        (0..teeth).flat_map(tooth).chain(last).collect()
    };
    let spiral: Vec<[f64; 2]> = {
        let arm = |i: u32, width: f64| {
            let angle = f64::from(i) * 0.4;
            let radius = 0.3 + 0.1 * angle + width;
            [radius * angle.cos(), radius * angle.sin()]
        };
        (0..40).map(|i| arm(i, 0.3)).chain((0..40).rev().map(|i| arm(i, 0.0))).collect()
    };
    let staircase: Vec<[f64; 2]> = (0..20)
        .flat_map(|i| [[f64::from(i), f64::from(i)], [f64::from(i + 1), f64::from(i)]])
        .chain([[20.0, 20.0], [0.0, 20.0], [0.0, 10.0]])
        .collect();
    for outline in [comb(1), comb(8), spiral, staircase] {
        let vertices: Vec<_> = outline.iter().map(|&[x, y]| DVec3::new(x, y, 0.5)).collect();
        let triangles = triangulate(&vertices);
        assert_eq!(triangles.len(), outline.len() - 2);
        let mut state = 7_u64;
        let mut random = |low: f64, high: f64| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            low + (high - low) * (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut inside = 0;
        for _ in 0..2000 {
            let point = [random(-3.0, 21.0), random(-3.0, 21.0)];
            let point = if outline[0][1] == 0.0 && outline.len() != 43 {
                [point[0] * 0.4, point[1] * 0.1]
            } else {
                point
            };
            let holds = |corners: &[usize; 3]| winding(&corners.map(|i| outline[i]), point) != 0;
            let count = triangles.iter().filter(|corners| holds(corners)).count();
            let expected = usize::from(winding(&outline, point) != 0);
            assert_eq!(count, expected, "{point:?} of {} vertices", outline.len());
            inside += expected;
        }
        assert!(inside > 50, "{inside} points inside");
    }
    assert!(triangulate(&[DVec3::ZERO, DVec3::X, DVec3::X * 2.0]).is_empty());
    assert!(triangulate(&[]).is_empty());
}

/// Something stands on the line of sight to each of these points, and elsewhere is the sky.
fn all_seen(scene: &NffScene<f64>, points: &[DVec3]) {
    for &point in points {
        assert!(is_seen(scene, point), "nothing at {point}");
    }
    let picture = draw(scene, SIDE, SIDE);
    let sky = picture.iter().filter(|pixel| is_sky(pixel)).count();
    assert!(sky > picture.len() / 10, "only {sky} pixels of sky");
}

#[test]
fn rings_of_cylinders_and_spheres() {
    let mut text = view();
    let mut points = Vec::new();
    for (ring, tilt) in [(0, 0.0), (1, 0.9), (2, 2.1)] {
        writeln!(text, "f 0.{ring} 0 1 0.5 0.2 3.0827 0 0").expect("text grows");
        let corner = |i: u32| {
            let angle = f64::from(i) * std::f64::consts::TAU / 5.0;
            let (y, z) = (angle.sin() * f64::cos(tilt), angle.sin() * f64::sin(tilt));
            DVec3::new(angle.cos(), y, z) * 1.4
        };
        for i in 0..5 {
            let (a, b) = (corner(i), corner(i + 1));
            writeln!(text, "c {} {} {} 0.1 {} {} {} 0.1", a.x, a.y, a.z, b.x, b.y, b.z)
                .and_then(|()| writeln!(text, "s {} {} {} 0.1", a.x, a.y, a.z))
                .expect("text grows");
            points.extend([a, (a + b) * 0.5, a * 0.3 + b * 0.7]);
        }
    }
    let scene = read(&text);
    assert_eq!(object_count(&scene), 30);
    all_seen(&scene, &points);
}

#[test]
fn tree_of_cones() {
    fn branch(text: &mut String, points: &mut Vec<DVec3>, from: DVec3, along: DVec3, depth: u32) {
        let (to, radius) = (from + along, along.length() * 0.08);
        let apex = radius * if depth == 0 { 0.0 } else { 0.613 };
        writeln!(
            text,
            "c {} {} {} {radius} {} {} {} {apex}",
            from.x, from.y, from.z, to.x, to.y, to.z
        )
        .expect("text grows");
        points.push((from + to) * 0.5);
        if depth > 0 {
            for side in [-0.6, 0.7] {
                let turned = DVec3::new(along.z * side, -side * 0.4, 0.0);
                branch(text, points, to, (along + turned) * 0.62, depth - 1);
            }
        }
    }
    let (mut text, mut points) = (view(), Vec::new());
    branch(&mut text, &mut points, DVec3::new(0.0, 0.0, -1.6), DVec3::new(0.0, 0.0, 1.3), 4);
    let scene = read(&text);
    assert_eq!(object_count(&scene), 31);
    all_seen(&scene, &points);
}

#[test]
fn lattice_shells_and_jacks_of_round_solids() {
    // A lattice: spheres on a grid, joined by cylinders.
    let (mut text, mut points) = (view(), Vec::new());
    let grid = || (0..27).map(|i| [i % 3, i / 3 % 3, i / 9].map(|c: u32| f64::from(c) - 1.0));
    for [x, y, z] in grid() {
        writeln!(text, "s {x} {y} {z} 0.15").expect("text grows");
        points.push(DVec3::new(x, y, z));
        for (to_x, to_y, to_z) in [(x + 1.0, y, z), (x, y + 1.0, z), (x, y, z + 1.0)] {
            if to_x.max(to_y).max(to_z) <= 1.0 {
                let line = writeln!(text, "c {x} {y} {z} 0.05 {to_x} {to_y} {to_z} 0.05");
                line.expect("text grows");
                points.push(DVec3::new(x + to_x, y + to_y, z + to_z) * 0.5);
            }
        }
    }
    let scene = read(&text);
    assert_eq!(object_count(&scene), 27 + 54);
    all_seen(&scene, &points);

    // Shells: glass spheres in one another.
    let mut text = view() + "f 1 1 1 0.2 0.1 50 0.6 1.4\n";
    for shell in 1..=5 {
        writeln!(text, "s 0 0 0 {}", f64::from(shell) * 0.3).expect("text grows");
    }
    let scene = read(&text);
    assert_eq!(object_count(&scene), 5);
    all_seen(&scene, &[DVec3::ZERO, DVec3::X]);

    // Jacks: three crossed cylinders with round ends.
    let (mut text, mut points) = (view(), Vec::new());
    for axis in [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| axis * 1.4) {
        for (x, y, z) in [axis, -axis].map(|end| (end.x, end.y, end.z)) {
            writeln!(text, "s {x} {y} {z} 0.2").expect("text grows");
        }
        let [x, y, z] = axis.to_array();
        writeln!(text, "c {x} {y} {z} 0.2 {} {} {} 0.2", -x, -y, -z).expect("text grows");
        points.extend([axis, axis * 0.5, axis * -0.5, -axis]);
    }
    let scene = read(&text);
    assert_eq!(object_count(&scene), 9);
    all_seen(&scene, &points);
}

#[test]
fn mount_of_triangles_has_no_cracks() {
    // A rough height field that fills the picture: nowhere does the sky show through.
    let height = |i: u32, j: u32| f64::from(i * 7 + j * 13 + i * j * 5 + i * i * 3).sin() * 0.3;
    let point = |i: u32, j: u32| DVec3::new(f64::from(i) - 8.0, f64::from(j) - 8.0, height(i, j));
    let mut faces = Vec::new();
    for (i, j) in (0..16).flat_map(|i| (0..16).map(move |j| (i, j))) {
        let [a, b, c, d] = [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)];
        faces.extend([vec![a, b, c], vec![c, d, a]]);
    }
    let mut text = view();
    for face in &faces {
        write_polygon(&mut text, face);
    }
    text += "f 1 1 1 0.1 0.1 101.148 0.9 1.5\ns 0 0 1 0.4\ns 1 0 1.2 0.4\n";
    let mut scene = read(&text);
    assert_eq!(object_count(&scene), 514);
    scene.builder.camera.eye = DVec3::new(0.01, 0.02, 15.0);
    let picture = draw(&scene, SIDE, SIDE);
    assert_eq!(picture.iter().filter(|pixel| is_sky(pixel)).count(), 0);
}

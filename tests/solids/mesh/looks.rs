//! What a mesh looks like: smooth normals, texture coordinates, and the same on both sides of an edge.

use nostray::glam::Vec3;
use nostray::{
    Affine, Axis, Corners, Form, Hit, Q16, Q32, Real as _, Scalar, Scene, Tables, Triangle,
    Triangles, Vector,
};

use super::figures::{self, Figure, builder, mesh_of, ray, spans, vector};
use crate::oracle::{Random, along, length};

/// A scene of a ball with its own normals, and coordinates that are those of its points.
fn ball<S: Scalar>(place: &Affine<S>) -> (super::figures::Builder<S>, Figure) {
    let figure = figures::ball(2);
    let values: Vec<S::Vec3> = figure.points.iter().map(|&p| vector::<S>(p)).collect();
    let uvs: Vec<[S; 2]> = figure.points.iter().map(|p| [p[0], p[1]].map(S::from_f64)).collect();
    let points = Corners { values: &values, triangles: &figure.triangles };
    let uvs = Corners { values: &uvs[..], triangles: &figure.triangles };
    let form = Triangles { points, normals: Some(points), uvs: Some(uvs), closed: true };
    let mut builder = builder::<S>();
    builder.leaf(Form::Mesh(form), place, 0).expect("a legal mesh");
    (builder, figure)
}

/// What is seen of the mesh along a ray: the shading normal, the coordinates, and the contact.
fn seen<S: Scalar>(
    scene: &Scene<'_, S>,
    ray: nostray::Ray<S>,
) -> Option<([f64; 3], [f64; 2], [f64; 3])> {
    let boundary = *spans(scene, 0, ray).1.first()?;
    let contact = scene.contact(ray, &Hit { object: 0, boundary })?;
    let (mesh, tables) = (nostray::Shape::Mesh(mesh_of(scene)), &scene.parts().tables);
    let normal = mesh.shading_normal(contact.local, boundary.face, tables)?;
    let uv = mesh.uv(contact.local, boundary.face, tables).map(|x| x.to_f64());
    let [normal, position] =
        [normal, S::widen_vec(contact.position)].map(|v| v.to_array().map(|x| x.to_f64()));
    Some((normal.map(|x| x / length(normal)), uv, position))
}

fn smooth<S: Scalar>(near: f64) {
    let turn = Affine::scale(vector::<S>([2.0, -1.0, 1.0]));
    let turn = turn.then(&Affine::rotate(Axis::Y, S::from_i32(90)));
    let (builder, _) = ball::<S>(&turn);
    let scene = builder.scene().expect("a legal scene");
    let (plain, figure) = ball::<S>(&Affine::identity());
    let plain = plain.scene().expect("a legal scene");
    let (mut random, mut met) = (Random::new(3), 0);
    for _ in 0..300 {
        // The ball's normals are its points.
        let origin = random.direction().map(|x| 5.0 * x);
        let target = if met % 2 == 0 { random.ball() } else { figure.on_edge(&mut random) };
        let Some((normal, uv, position)) = seen(&plain, ray::<S>(origin, target)) else {
            continue;
        };
        let size = length(position);
        for i in 0..3 {
            assert!((normal[i] - position[i] / size).abs() < 0.02, "{normal:?} {position:?}");
        }
        assert!((uv[0] - position[0]).abs() < near && (uv[1] - position[1]).abs() < near);
        met += 1;
        // In the squeezed one, those of an ellipsoid: x²/1 + y²/1 + z²/4 after the turn.
        let place = |p: [f64; 3]| [p[2], -p[1], -2.0 * p[0]];
        let Some((normal, uv, position)) = seen(&scene, ray::<S>(place(origin), place(target)))
        else {
            continue;
        };
        let gradient = [position[0], position[1], position[2] / 4.0];
        let size = length(gradient);
        for i in 0..3 {
            assert!((normal[i] - gradient[i] / size).abs() < 0.04, "{normal:?} {gradient:?}");
        }
        assert!((uv[0] + position[2] / 2.0).abs() < near && (uv[1] + position[1]).abs() < near);
    }
    assert!(met > 100);
}

#[test]
fn normals_and_coordinates_go_along() {
    smooth::<f32>(1e-5);
    smooth::<f64>(1e-12);
    smooth::<Q16>(1e-3);
    smooth::<Q32>(1e-7);
}

/// On both sides of an edge the same, so that no edge of a smooth mesh shows.
#[test]
fn edges_do_not_show() {
    let (builder, figure) = ball::<f64>(&Affine::identity());
    let scene = builder.scene().expect("a legal scene");
    let mut random = Random::new(4);
    for _ in 0..300 {
        let point = figure.on_edge(&mut random);
        let origin = point.map(|x| 3.0 * x);
        let aside = random.direction().map(|x| 1e-9 * x);
        let views = [-1.0, 1.0].map(|side| ray::<f64>(origin, along(point, side, aside)));
        let [Some(one), Some(other)] = views.map(|ray| seen(&scene, ray)) else {
            panic!("both meet the ball")
        };
        assert!((0..3).all(|i| (one.0[i] - other.0[i]).abs() < 1e-7), "{one:?} {other:?}");
        assert!((0..2).all(|i| (one.1[i] - other.1[i]).abs() < 1e-7), "{one:?} {other:?}");
    }
}

/// At its corners a smooth triangle has the normals and the coordinates of the corners, whatever its size.
#[test]
fn a_smooth_triangle_has_those_of_its_corners() {
    for size in [1.0, 1e-12, 1e12_f32] {
        let corners = [[0.0, 0.0, 0.0], [size, 0.0, 0.0], [0.0, size, 0.0]].map(Vec3::from_array);
        let points: Vec<Vec3> = corners.into_iter().chain([Vec3::X, Vec3::Y, Vec3::Z]).collect();
        let shape = nostray::Shape::<f32>::Triangle(Triangle { corners: [0, 1, 2], normals: 3 });
        let tables = Tables { points: &points, ..Tables::EMPTY };
        let seen = |p: Vec3| (shape.shading_normal(p, 0, &tables), shape.uv(p, 0, &tables));
        assert_eq!(seen(corners[0]), (Some(Vec3::X), [0.0, 0.0]));
        assert_eq!(seen(corners[1]), (Some(Vec3::Y), [1.0, 0.0]));
        assert_eq!(seen(corners[2]), (Some(Vec3::Z), [0.0, 1.0]));
        let (normal, uv) = seen((corners[1] + corners[2]) * 0.5);
        assert_eq!((normal, uv), (Some((Vec3::Y + Vec3::Z) * 0.5), [0.5, 0.5]));
    }
}

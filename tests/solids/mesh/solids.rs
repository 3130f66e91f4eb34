//! A closed mesh is a solid like the shape that it is a mesh of.

use nostray::{
    Affine, Axis, Depth, Form, Light, Material, Operator, Paint, Passage, Projection, Q16, Q32,
    Ray, Render, Rgb, Scalar, SceneError, Vector,
};

use super::figures::{self, Builder, Made, builder, ray, spans, vector};
use crate::oracle::Random;

fn unit_box<S: Scalar>() -> Form<'static, S> {
    Form::Box { min: S::Vec3::splat(-S::ONE), max: S::Vec3::splat(S::ONE) }
}

/// The same solid twice: with a box, and with a mesh of its faces.
fn twice<S: Scalar>(
    mut plant: impl FnMut(&mut Builder<S>, Form<'_, S>) -> Result<(), SceneError>,
) -> Builder<S> {
    let mut builder = builder::<S>();
    plant(&mut builder, unit_box()).expect("a legal solid");
    let cube = Made::<S>::new(&figures::cube(4));
    plant(&mut builder, cube.form(true)).expect("a legal solid");
    builder
}

/// The boundaries of both are the same within `near`.
fn compare<S: Scalar>(builder: &Builder<S>, near: f64, least: u32) {
    let scene = builder.scene().expect("a legal scene");
    let (mut random, mut met) = (Random::new(9), 0);
    for _ in 0..400 {
        let origin = random.cube().map(|x| x * 4.0);
        let ray = ray::<S>(origin, random.cube().map(|x| 1.5 * x));
        let [one, other] = [0, 1].map(|object| spans(&scene, object, ray));
        let told = |list: &(bool, Vec<nostray::Boundary<S>>)| {
            let passages = list.1.iter().map(|b| (b.passage, b.inverted));
            (list.0, passages.collect::<Vec<_>>())
        };
        assert_eq!(told(&one), told(&other), "{one:?} {other:?}");
        for (a, b) in one.1.iter().zip(&other.1) {
            let gap = (a.t.to_f64() - b.t.to_f64()).abs();
            assert!(gap <= near, "{a:?} {b:?}");
            met += 1;
        }
    }
    assert!(met > least, "{met}");
}

fn solids<S: Scalar>(near: f64) {
    let turn = Affine::rotate(Axis::Y, S::from_i32(30));
    let turn = turn.then(&Affine::translate(vector::<S>([0.25, 0.5, -0.125])));
    let ball = || Form::Sphere { center: vector::<S>([0.5, 0.75, 0.5]), radius: S::ONE };
    compare(&twice::<S>(|builder, form| builder.leaf(form, &turn, 0)), near, 200);
    // Operators in both orders, and a mirror.
    for operator in [Operator::Union, Operator::Intersection, Operator::Difference, Operator::Xor] {
        for first in [true, false] {
            let mirror = Affine::scale(vector::<S>([-1.0, 1.0, 0.5]));
            let place = if first { turn } else { mirror };
            let solid = twice::<S>(|builder, form| {
                builder.open(operator)?;
                if first {
                    builder.leaf(form, &place, 0)?;
                }
                builder.leaf(ball(), &Affine::identity(), 0)?;
                if !first {
                    builder.leaf(form, &place, 0)?;
                }
                builder.close(0)
            });
            compare(&solid, near, 100);
        }
    }
}

#[test]
fn a_mesh_of_a_box_is_a_box() {
    solids::<f32>(1e-5);
    solids::<f64>(1e-13);
    solids::<Q16>(1e-3);
    solids::<Q32>(1e-7);
}

/// What a box and its mesh do not have in common is nothing, seen from far or near.
fn nothing<S: Scalar>() {
    let mut builder = builder::<S>();
    let cube = Made::<S>::new(&figures::cube(3));
    for (operator, boxed) in [
        (Operator::Xor, [true, false]),
        (Operator::Difference, [true, false]),
        (Operator::Difference, [false, true]),
        (Operator::Difference, [false, false]),
    ] {
        builder.open(operator).expect("room");
        for boxed in boxed {
            let form = if boxed { unit_box() } else { cube.form(true) };
            builder.leaf(form, &Affine::identity(), 0).expect("a legal solid");
        }
        builder.close(0).expect("a legal solid");
    }
    let scene = builder.scene().expect("a legal scene");
    let mut random = Random::new(10);
    for _ in 0..300 {
        let origin = random.direction().map(|x| 5.0 * x);
        // Away from edges, where rounding decides what is met.
        let axis = random.below(3);
        let mut target = random.cube().map(|x| 0.95 * x);
        target[axis] = origin[axis].signum();
        if origin[axis].abs() < 2.0 {
            continue;
        }
        let mut ray = ray::<S>(origin, target);
        for object in 0..4 {
            let (inside, list) = spans(&scene, object, ray);
            let first = list.first().filter(|b| b.t.to_f64() < 4.0);
            assert!(!inside && first.is_none(), "{object}: {list:?}");
        }
        // Backwards there is nothing at all.
        ray.dir = -ray.dir;
        assert!((0..4).all(|object| spans(&scene, object, ray).1.is_empty()));
    }
}

#[test]
fn a_box_less_its_mesh_is_nothing() {
    nothing::<f32>();
    nothing::<f64>();
    nothing::<Q16>();
    nothing::<Q32>();
}

/// A mesh within a transparent one, and both in a glass box, with light from above: pictures of the scene with boxes
/// and with meshes of them.
fn picture<S: Scalar>(meshes: bool) -> Vec<[f64; 3]> {
    let mut builder = builder::<S>();
    let glass = Material {
        color: Paint::Solid(Rgb::WHITE),
        diffuse: S::ZERO,
        transmit: S::from_f64(0.9),
        reflect: S::from_f64(0.1),
        ior: S::from_f64(1.5),
        absorb: Rgb::new(S::ONE, S::from_f64(0.2), S::from_f64(0.2)),
        ..Material::PLAIN
    };
    let glass = builder.material(glass).expect("room");
    let mirror = Material { reflect: S::HALF, ..Material::matte(Rgb::WHITE) };
    let mirror = builder.material(mirror).expect("room");
    let at = vector::<S>([3.0, 8.0, 5.0]);
    let attenuation = nostray::Attenuation::NONE;
    builder.light(Light::Point { at, color: Rgb::WHITE, attenuation }).expect("room");
    builder.ambient = Rgb::WHITE.map(|v| v * S::from_f64(0.1));
    builder.camera.eye = vector::<S>([2.0, 3.0, 9.0]);
    builder.camera.projection = Projection::Pinhole { fov: S::from_i32(35) };
    let cube = Made::<S>::new(&figures::cube(3));
    let mut plant = |factor: [f64; 3], degrees: i32, center: [f64; 3], material| {
        let place = Affine::scale(vector::<S>(factor))
            .then(&Affine::rotate(Axis::Y, S::from_i32(degrees)))
            .then(&Affine::translate(vector::<S>(center)));
        let form = if meshes { cube.form(true) } else { unit_box() };
        builder.leaf(form, &place, material).expect("a legal solid");
    };
    plant([5.0, 0.5, 5.0], 0, [0.0, -2.0, 0.0], mirror);
    plant([1.0, 1.0, 1.0], 20, [0.5, 0.0, 0.0], glass);
    // Its walls go through those of the glass, which do not show inside it.
    plant([0.8, 0.5, 1.4], 50, [-0.5, 0.2, 0.3], glass);
    plant([0.3, 0.3, 0.3], 70, [0.4, -0.2, 0.2], 0);
    let scene = builder.scene().expect("a legal scene");
    let render: Render<'_, S> =
        Render::new(&scene, 64, 48, Depth::fixed(8)).expect("a legal picture");
    render.map(|pixel| pixel.color.to_array().map(S::to_f64)).collect()
}

fn pictures<S: Scalar>(near: f64, share: f64) {
    let (boxes, meshes) = (picture::<S>(false), picture::<S>(true));
    let differs = |(a, b): &(&[f64; 3], &[f64; 3])| (0..3).any(|i| (a[i] - b[i]).abs() > near);
    let different = boxes.iter().zip(&meshes).filter(differs).count();
    println!("{}: {different} of {} pixels differ by more than {near}", S::NAME, boxes.len());
    assert!(different as f64 <= share * boxes.len() as f64);
    let levels: std::collections::BTreeSet<u64> = boxes.iter().map(|c| c[0].to_bits()).collect();
    assert!(levels.len() > 500, "there is something to see");
}

#[test]
fn glass_and_shadows_do_not_tell_a_mesh_from_a_box() {
    pictures::<f32>(1e-3, 0.01);
    pictures::<f64>(1e-6, 0.002);
    pictures::<Q16>(0.02, 0.05);
}

/// The teeth of a comb from the side, alone and cut off by a plane: no crossing is lost.
#[test]
fn a_ray_may_meet_a_mesh_many_times() {
    let heights: Vec<f64> = (0..64).flat_map(|_| (0..200).map(|i| f64::from(i % 2))).collect();
    let mut builder = builder::<f64>();
    let form = nostray::Heights {
        min: [0.0, 0.0],
        max: [199.0, 1.0],
        columns: 200,
        heights: &heights,
        base: Some(-1.0),
        smooth: false,
    };
    builder.leaf(Form::HeightField(form), &Affine::identity(), 0).expect("a legal field");
    builder.open(Operator::Intersection).expect("room");
    builder.leaf(Form::HeightField(form), &Affine::identity(), 0).expect("a legal field");
    let half = Form::Plane { normal: vector::<f64>([1.0, 0.0, 0.0]), offset: 99.25 };
    builder.leaf(half, &Affine::identity(), 0).expect("a legal half");
    builder.close(0).expect("a legal solid");
    let scene = builder.scene().expect("a legal scene");
    let along =
        Ray { origin: vector::<f64>([-5.0, 0.5, 0.5]), dir: vector::<f64>([1.0, 0.0, 0.0]) };
    let (inside, list) = spans(&scene, 0, along);
    assert!(!inside && list.len() == 199 + 1, "{}", list.len());
    let ends = list.chunks(2).map(|pair| (pair[0].passage, pair[1].passage));
    assert!(ends.into_iter().all(|ends| ends == (Passage::Enter, Passage::Leave)));
    let (_, list) = spans(&scene, 1, along);
    assert_eq!(list.len(), 100);
    assert_eq!(list.last().map(|last| last.t), Some(104.25));
}

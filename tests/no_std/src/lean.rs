//! A picture of a ball over a floor, for a program that holds nothing else.

use nostray::glam::Vec3;
use nostray::{
    Attenuation, Background, Camera, Depth, Leaf, Light, Material, Node, Object, Paint, Parts,
    Plane, Render, Rgb, Scene, SceneError, Shape, Sphere, needs,
};

use crate::digest::Hash;

const BALL: Shape<f32> = Shape::Sphere(Sphere { center: Vec3::ZERO, radius: 1.0 });
const FLOOR: Shape<f32> = Shape::Plane(Plane { normal: Vec3::Y, offset: -1.0 });

const fn leaf(shape: Shape<f32>, material: u16) -> Node<f32> {
    Node::Leaf(Leaf { shape, material, placement: None })
}

const fn painted(r: f32, g: f32, b: f32) -> Material<f32> {
    Material { color: Paint::Solid(Rgb::new(r, g, b)), ..Material::PLAIN }
}

static PARTS: Parts<'static, f32> = Parts {
    nodes: &[leaf(FLOOR, 0), leaf(BALL, 1)],
    objects: &[Object::new(0, 1, 0), Object::new(1, 1, 1)],
    materials: &[painted(0.5, 0.6, 0.4), Material { reflect: 0.4, ..painted(0.8, 0.3, 0.1) }],
    lights: &[Light::Point {
        at: Vec3::new(-3.0, 5.0, 4.0),
        color: Rgb::WHITE,
        attenuation: Attenuation::NONE,
    }],
    background: Background::Constant(Rgb::new(0.2, 0.3, 0.5)),
    ambient: Rgb::new(0.1, 0.1, 0.1),
    ..Parts::seen_by(Camera::pinhole(Vec3::new(0.0, 1.0, 5.0), Vec3::ZERO, Vec3::Y, 40.0))
};

/// What the scene asks for.
pub(crate) const NEEDS: u64 = PARTS.needs() & !needs::GLASS;

/// The digest of the picture, traced by what is made for certain needs.
pub(crate) fn digest<const FOR: u64>() -> Result<u64, SceneError> {
    let scene = Scene::limited::<FOR>(PARTS)?;
    let render: Render<'_, f32, 5, 2, (), FOR> = Render::new(&scene, 24, 18, Depth::fixed(4))?;
    let mut hash = Hash::new();
    for pixel in render {
        hash.add(pixel.color);
    }
    Ok(hash.value())
}

//! The scene: tables of constants, which the linker puts into flash. Lengths are in hundredths.

use nostray::glam::Vec3;
use nostray::*;

const fn cents(n: i16) -> f32 {
    n as f32 / 100.0
}

const fn at(x: i16, y: i16, z: i16) -> Vec3 {
    Vec3::new(cents(x), cents(y), cents(z))
}

const fn grey(share: i16) -> Rgb<f32> {
    Rgb::new(cents(share), cents(share), cents(share))
}

const fn leaf(shape: Shape<f32>, material: u16) -> Node<f32> {
    Node::Leaf(Leaf { shape, material, placement: None })
}

const fn ball(center: Vec3, radius: i16, material: u16) -> Node<f32> {
    leaf(Shape::Sphere(Sphere { center, radius: cents(radius) }), material)
}

static NODES: [Node<f32>; 9] = [
    leaf(Shape::Plane(Plane { normal: Vec3::Y, offset: cents(0) }), 0),
    ball(at(-190, 100, -20), 100, 1),
    // A die without pips: a box with rounded corners and a bite.
    Node::Operator { operator: Operator::Difference, size: 5 },
    Node::Operator { operator: Operator::Intersection, size: 3 },
    leaf(Shape::Box(Cuboid { min: at(-55, 0, -75), max: at(95, 150, 75) }), 2),
    ball(at(20, 75, 0), 100, 2),
    ball(at(70, 125, 60), 62, 3),
    leaf(
        Shape::Cone(Cone {
            center: at(215, 90, -40),
            half_height: cents(90),
            base_radius: cents(80),
            top_radius: cents(0),
        }),
        2,
    ),
    ball(at(150, 30, 120), 30, 1),
];

const OBJECTS: &[Object<f32>] = &[
    Object::new(0, 1, 0),
    Object::new(1, 1, 1),
    Object::new(2, 5, 2),
    Object::new(7, 1, 2),
    Object::new(8, 1, 1),
];

/// What the solids need on any ray, checked when this is compiled.
const _: () = match scene::structure(&NODES, OBJECTS, MATERIALS.len(), 0) {
    Ok(needs) => assert!(needs.boundaries <= 16, "the picture has room for 16 boundaries"),
    Err(_) => panic!("the scene is put together wrongly"),
};

const fn glossy(color: Paint<f32>, reflect: i16) -> Material<f32> {
    Material {
        color,
        diffuse: cents(80 - reflect / 2),
        specular: cents(50),
        shininess: cents(2400),
        reflect: cents(reflect),
        ..Material::PLAIN
    }
}

const MATERIALS: &[Material<f32>] = &[
    glossy(Paint::Texture(0), 10),
    glossy(Paint::Solid(grey(90)), 75),
    glossy(Paint::Solid(grey(70)), 0),
    glossy(Paint::Solid(grey(30)), 20),
];

const TEXTURES: &[Texture<f32>] = &[Texture::new(Pattern::Checker, Ramp::new(0, 2))];

const STOPS: &[Stop<f32>] = &[Stop::color(cents(0), grey(80)), Stop::color(cents(100), grey(12))];

const LIGHTS: &[Light<f32>] = &[
    Light::Point { at: at(-400, 700, 600), color: grey(80), attenuation: Attenuation::NONE },
    Light::Point { at: at(600, 400, 500), color: grey(25), attenuation: Attenuation::NONE },
];

pub(crate) const PARTS: Parts<'static, f32> = Parts {
    nodes: &NODES,
    objects: OBJECTS,
    materials: MATERIALS,
    textures: TEXTURES,
    stops: STOPS,
    lights: LIGHTS,
    background: Background::Gradient { bottom: grey(40), top: grey(3) },
    ambient: grey(10),
    ..Parts::seen_by(Camera::pinhole(at(20, 230, 700), at(20, 75, 0), at(0, 100, 0), cents(2300)))
};

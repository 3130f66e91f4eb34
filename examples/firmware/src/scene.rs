//! The scene: tables of constants, which the linker puts into flash. Lengths are in hundredths.

use nostray::fixed_point::{Triple, Unit16};
use nostray::*;

type Point = Triple<Q16>;

/// `n`/100 to the nearest step.
const fn cents(n: i64) -> Q16 {
    let half = if n < 0 { -50 } else { 50 };
    Q16::from_bits((((n << 16) + half) / 100) as i32)
}

const fn at(x: i64, y: i64, z: i64) -> Point {
    Triple::new(cents(x), cents(y), cents(z))
}

const fn grey(share: i64) -> Rgb<Q16> {
    Rgb::new(cents(share), cents(share), cents(share))
}

const fn leaf(shape: Shape<Q16>, material: u16) -> Node<Q16> {
    Node::Leaf(Leaf { shape, material, placement: None })
}

const fn ball(center: Point, radius: i64, material: u16) -> Node<Q16> {
    leaf(Shape::Sphere(Sphere { center, radius: cents(radius) }), material)
}

const UP: Triple<Unit16> =
    Triple::new(Unit16::from_bits(0), Unit16::from_bits(1 << 30), Unit16::from_bits(0));

static NODES: [Node<Q16>; 9] = [
    leaf(Shape::Plane(Plane { normal: UP, offset: cents(0) }), 0),
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

const OBJECTS: &[Object<Q16>] = &[
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

const fn glossy(color: Paint<Q16>, reflect: i64) -> Material<Q16> {
    Material {
        color,
        diffuse: cents(80 - reflect / 2),
        specular: cents(50),
        shininess: cents(2400),
        reflect: cents(reflect),
        ..Material::PLAIN
    }
}

const MATERIALS: &[Material<Q16>] = &[
    glossy(Paint::Texture(0), 10),
    glossy(Paint::Solid(grey(90)), 75),
    glossy(Paint::Solid(grey(70)), 0),
    glossy(Paint::Solid(grey(30)), 20),
];

const TEXTURES: &[Texture<Q16>] = &[Texture::new(Pattern::Checker, Ramp::new(0, 2))];

const STOPS: &[Stop<Q16>] = &[Stop::color(cents(0), grey(80)), Stop::color(cents(100), grey(12))];

const LIGHTS: &[Light<Q16>] = &[
    Light::Point { at: at(-400, 700, 600), color: grey(80), attenuation: Attenuation::NONE },
    Light::Point { at: at(600, 400, 500), color: grey(25), attenuation: Attenuation::NONE },
];

pub(crate) const PARTS: Parts<'static, Q16> = Parts {
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

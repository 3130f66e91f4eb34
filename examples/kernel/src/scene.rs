//! The scene, as tables of constants for each format: a mirror ball, a hollowed block and a
//! column on a checkered floor.

macro_rules! scene {
    ($module:ident, $number:ident, $unit:ident, $bits:ident, $long:ident, $fraction:literal, $behind:literal) => {
        pub(crate) mod $module {
            use nostray::fixed_point::{Triple, $unit};
            use nostray::*;

            type Number = $number;
            type Point = Triple<Number>;

            /// `n`/100 to the nearest step.
            const fn cents(n: $long) -> Number {
                let half = if n < 0 { -50 } else { 50 };
                Number::from_bits((((n << $fraction) + half) / 100) as $bits)
            }

            const fn at(x: $long, y: $long, z: $long) -> Point {
                Triple::new(cents(x), cents(y), cents(z))
            }

            const fn rgb(r: $long, g: $long, b: $long) -> Rgb<Number> {
                Rgb::new(cents(r), cents(g), cents(b))
            }

            const fn leaf(shape: Shape<Number>, material: u16) -> Node<Number> {
                Node::Leaf(Leaf { shape, material, placement: None })
            }

            const UP: Triple<$unit> = Triple::new(
                $unit::from_bits(0),
                $unit::from_bits(1 << $behind),
                $unit::from_bits(0),
            );

            const NODES: &[Node<Number>] = &[
                leaf(Shape::Plane(Plane { normal: UP, offset: cents(0) }), 0),
                leaf(Shape::Sphere(Sphere { center: at(-120, 100, 0), radius: cents(100) }), 1),
                Node::Operator { operator: Operator::Difference, size: 4 },
                leaf(Shape::Box(Cuboid { min: at(30, 0, -60), max: at(170, 140, 80) }), 2),
                leaf(Shape::Sphere(Sphere { center: at(100, 70, 10), radius: cents(88) }), 3),
                leaf(
                    Shape::Cylinder(Cylinder {
                        center: at(100, 140, 10),
                        half_height: cents(40),
                        radius: cents(45),
                    }),
                    3,
                ),
                leaf(
                    Shape::Cone(Cone {
                        center: at(100, 60, 10),
                        half_height: cents(60),
                        base_radius: cents(40),
                        top_radius: cents(0),
                    }),
                    4,
                ),
            ];

            const OBJECTS: &[Object<Number>] = &[
                Object::new(0, 1, 0),
                Object::new(1, 1, 1),
                Object::new(2, 4, 2),
                Object::new(6, 1, 4),
            ];

            const fn glossy(color: Paint<Number>, reflect: $long) -> Material<Number> {
                Material {
                    color,
                    diffuse: cents(75 - reflect / 2),
                    specular: cents(40),
                    shininess: cents(2400),
                    reflect: cents(reflect),
                    ..Material::PLAIN
                }
            }

            const MATERIALS: &[Material<Number>] = &[
                glossy(Paint::Texture(0), 12),
                glossy(Paint::Solid(rgb(95, 96, 100)), 80),
                glossy(Paint::Solid(rgb(85, 18, 10)), 0),
                glossy(Paint::Solid(rgb(95, 75, 30)), 0),
                glossy(Paint::Solid(rgb(20, 45, 85)), 10),
            ];

            const TEXTURES: &[Texture<Number>] = &[Texture {
                size: [cents(80); 3],
                ..Texture::new(Pattern::Checker, Ramp::new(0, 2))
            }];

            const STOPS: &[Stop<Number>] =
                &[Stop::color(cents(0), rgb(85, 82, 75)), Stop::color(cents(100), rgb(12, 14, 18))];

            const LIGHTS: &[Light<Number>] = &[
                Light::Point {
                    at: at(-400, 600, 500),
                    color: rgb(80, 78, 72),
                    attenuation: Attenuation::NONE,
                },
                Light::Point {
                    at: at(500, 300, 400),
                    color: rgb(22, 24, 30),
                    attenuation: Attenuation::NONE,
                },
            ];

            pub(crate) const PARTS: Parts<'static, Number> = Parts {
                nodes: NODES,
                objects: OBJECTS,
                materials: MATERIALS,
                textures: TEXTURES,
                stops: STOPS,
                lights: LIGHTS,
                background: Background::Gradient { bottom: rgb(60, 62, 66), top: rgb(16, 30, 62) },
                ambient: rgb(12, 13, 16),
                ..Parts::seen_by(Camera::pinhole(
                    at(60, 240, 620),
                    at(0, 70, 0),
                    at(0, 100, 0),
                    cents(3600),
                ))
            };
        }
    };
}

scene!(q16, Q16, Unit16, i32, i64, 16, 30);
scene!(q32, Q32, Unit32, i64, i128, 32, 62);

//! Light against formulas: scenes so simple that the radiance of a pixel is known.

#![allow(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    clippy::disallowed_methods,
    reason = "a test may fail loudly, and its expectations come from the platform's functions"
)]

use nostray::glam::{DVec3, Vec3};
use nostray::*;

type Builder<S> = SceneBuilder<S, Fixed<8, 16, 8, 16>>;

/// The one pixel of a picture that looks from `eye` along `toward`.
fn look<S: Scalar>(
    builder: &mut Builder<S>,
    eye: [f64; 3],
    toward: [f64; 3],
    depth_max: u16,
) -> [f64; 3] {
    let vec = |v: [f64; 3]| S::Vec3::from_array(v.map(S::from_f64));
    let up = if toward[1].abs() > 0.9 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
    builder.camera = Camera {
        eye: vec(eye),
        look_at: vec(eye) + vec(toward),
        up: vec(up),
        projection: Projection::Orthographic { height: S::ONE },
    };
    let scene = builder.scene().unwrap();
    let mut render: Render<S, 65, 64> = Render::new(&scene, 1, 1, Depth::fixed(depth_max)).unwrap();
    render.next().unwrap().color.to_array().map(S::to_f64)
}

fn near(found: [f64; 3], expected: [f64; 3], tolerance: f64) {
    for (f, e) in found.iter().zip(expected) {
        assert!((f - e).abs() <= tolerance * (1.0 + e.abs()), "{found:?}, expected {expected:?}");
    }
}

fn rgb<S: Scalar>(r: f64, g: f64, b: f64) -> Rgb<S> {
    Rgb::new(S::from_f64(r), S::from_f64(g), S::from_f64(b))
}

fn glass<S: Scalar>(ior: f64) -> Material<S> {
    Material {
        diffuse: S::ZERO,
        ambient: S::ZERO,
        transmit: S::ONE,
        ior: S::from_f64(ior),
        ..Material::matte(Rgb::WHITE)
    }
}

fn plane(y: f64) -> Form<'static, f64> {
    Form::Plane { normal: DVec3::Y, offset: y }
}

fn slab(low: f64, high: f64) -> Form<'static, f64> {
    Form::Box { min: DVec3::new(-50.0, low, -50.0), max: DVec3::new(50.0, high, 50.0) }
}

fn here() -> Affine<f64> {
    Affine::identity()
}

/// ambient + kd·N·L + ks·(R·V)ⁿ on a sphere, seen in parallel projection where the normal is known.
#[test]
fn lit_sphere_follows_the_local_model() {
    fn check<S: Scalar>(tolerance: f64) {
        let mut builder = Builder::<S>::new();
        builder.ambient = rgb(0.1, 0.2, 0.3);
        let material = Material {
            diffuse: S::from_f64(0.6),
            specular: S::from_f64(0.5),
            shininess: S::from_f64(20.0),
            ..Material::matte(rgb(0.9, 0.5, 0.2))
        };
        let index = builder.material(material).unwrap();
        let light = [0.48, 0.6, 0.64];
        let toward = S::Vec3::from_array(light.map(|v| S::from_f64(-v)));
        builder
            .light(Light::Directional {
                toward: S::steer(S::widen_vec(toward)).0,
                color: rgb(1.0, 0.8, 0.7),
            })
            .unwrap();
        let (center, radius) = (S::Vec3::ZERO, S::from_f64(2.0));
        builder.leaf(Form::Sphere { center, radius }, &Affine::identity(), index).unwrap();
        for (x, y) in [(0.0, 0.0), (0.5, 0.25), (-1.0, 0.5), (1.0, 1.0), (1.25, -0.75)] {
            let (nx, ny) = (x / 2.0, y / 2.0);
            let nz = f64::sqrt(1.0 - nx * nx - ny * ny);
            let facing = f64::max(0.0, nx * light[0] + ny * light[1] + nz * light[2]);
            // R = 2(N·L)N − L, and V is +z.
            let mirrored = if facing > 0.0 { 2.0 * facing * nz - light[2] } else { 0.0 };
            let lobe = 0.5 * mirrored.max(0.0).powi(20);
            let expected = std::array::from_fn(|i| {
                let (color, lamp) = ([0.9, 0.5, 0.2][i], [1.0, 0.8, 0.7][i]);
                [0.1, 0.2, 0.3][i] * color + lamp * (0.6 * color * facing + lobe)
            });
            near(look(&mut builder, [x, y, 10.0], [0.0, 0.0, -1.0], 0), expected, tolerance);
        }
    }
    check::<f64>(1e-12);
    check::<f32>(2e-5);
}

#[test]
fn blinn_takes_the_half_vector_and_metal_its_colour() {
    let mut builder = Builder::<f64>::new();
    let material = Material {
        diffuse: 0.0,
        ambient: 0.0,
        specular: 1.0,
        shininess: 8.5,
        highlight: Highlight::Blinn,
        metallic: true,
        ..Material::matte(rgb(0.9, 0.6, 0.3))
    };
    let index = builder.material(material).unwrap();
    let toward = DVec3::new(-0.6, -0.8, 0.0);
    builder.light(Light::Directional { toward, color: Rgb::WHITE }).unwrap();
    builder.leaf(plane(0.0), &here(), index).unwrap();
    let half = DVec3::new(0.6, 1.8, 0.0);
    let lobe = (half.y / (0.36 + 1.8 * 1.8_f64).sqrt()).powf(8.5);
    let found = look(&mut builder, [0.0, 5.0, 0.0], [0.0, -1.0, 0.0], 0);
    near(found, [0.9 * lobe, 0.6 * lobe, 0.3 * lobe], 1e-12);
}

#[test]
fn spot_light_weakens_with_distance_and_angle() {
    let mut builder = Builder::<f64>::new();
    let white = Material { ambient: 0.0, diffuse: 1.0, ..Material::matte(Rgb::WHITE) };
    let index = builder.material(white).unwrap();
    builder.leaf(plane(0.0), &here(), index).unwrap();
    let attenuation = Attenuation { constant: 0.5, linear: 0.25, quadratic: 0.125 };
    let cone = Spotlight { axis: -DVec3::Y, cos_inner: 0.9, cos_outer: 0.6 };
    let at = DVec3::new(0.0, 3.0, 0.0);
    builder.light(Light::Spot { at, cone, color: Rgb::WHITE, attenuation }).unwrap();
    for x in [0.0, 1.0, 2.0, 3.0, 3.9, 4.1] {
        let distance = f64::hypot(x, 3.0);
        let cosine = 3.0 / distance;
        let share = ((cosine - 0.6) / 0.3).clamp(0.0, 1.0);
        let smooth = share * share * (3.0 - 2.0 * share);
        let value = cosine * smooth / (0.5 + 0.25 * distance + 0.125 * distance * distance);
        let found = look(&mut builder, [x, 5.0, 0.0], [0.0, -1.0, 0.0], 0);
        near(found, [value; 3], 1e-12);
    }
}

/// A closed box of mirrors seen from inside: every bounce adds the same light times the weight.
#[test]
fn mirror_box_is_a_geometric_series() {
    let mut builder = Builder::<f64>::new();
    builder.ambient = rgb(0.25, 0.5, 1.0);
    let material = Material { diffuse: 0.0, reflect: 0.5, ..Material::matte(Rgb::WHITE) };
    let index = builder.material(material).unwrap();
    let (min, max) = (DVec3::splat(-1.0), DVec3::splat(1.0));
    builder.leaf(Form::Box { min, max }, &here(), index).unwrap();
    for depth_max in [0, 1, 2, 5, 20] {
        let sum: f64 = (0..=i32::from(depth_max)).map(|n| 0.5_f64.powi(n)).sum();
        let found = look(&mut builder, [0.1, 0.2, -0.3], [0.3, 0.5, 0.8], depth_max);
        near(found, [0.25 * sum, 0.5 * sum, sum], 1e-12);
    }
}

/// Light goes on parallel behind a plate of glass, moved by d·(tan θ − tan θ′).
#[test]
fn plate_moves_light_by_snells_law() {
    let (ior, thickness) = (1.5_f64, 2.0);
    let mut builder = Builder::<f64>::new();
    builder.ambient = Rgb::WHITE;
    let clear = builder.material(glass(ior)).unwrap();
    let (sine, cosine) = (0.6_f64, 0.8);
    let inner = sine / ior;
    let through = inner / (1.0 - inner * inner).sqrt();
    // From x = 0 on the upper face at y = 2 down to the floor at y = −1.
    let landing = thickness * through + sine / cosine;
    let stops = [Stop::color(0.0, Rgb::WHITE), Stop::color(1.0, Rgb::BLACK)];
    let ramp = builder.ramp(&stops, Blend::Linear).unwrap();
    let checker = Texture { size: [landing, 10.0, 10.0], ..Texture::new(Pattern::Checker, ramp) };
    let texture = builder.texture(checker).unwrap();
    let color = Paint::Texture(texture);
    let floor = Material { diffuse: 0.0, color, ..Material::matte(Rgb::WHITE) };
    let floor = builder.material(floor).unwrap();
    builder.leaf(slab(0.0, thickness), &here(), clear).unwrap();
    builder.leaf(plane(-1.0), &here(), floor).unwrap();
    let mut see = |aside: f64| {
        let eye = [aside - 4.0 * sine / cosine, thickness + 4.0, 0.5];
        look(&mut builder, eye, [sine, -cosine, 0.0], 4)[0]
    };
    // The cell changes exactly where the refracted ray lands; y = −1 is in the odd cell.
    let (before, after) = (see(-1e-9), see(1e-9));
    assert_eq!((before, after), (0.0, 1.0), "the ray lands elsewhere than at {landing}");
}

/// Fresnel's equations and Schlick's approximation on a half-space that swallows what enters.
#[test]
fn fresnel_weights_are_those_of_the_formulas() {
    let ior = 1.5_f64;
    for fresnel in [Fresnel::Exact, Fresnel::Schlick] {
        let mut builder = Builder::<f64>::new();
        builder.background = Background::Constant(Rgb::WHITE);
        let material = Material { fresnel, absorb: rgb(9e3, 9e3, 9e3), ..glass(ior) };
        let index = builder.material(material).unwrap();
        builder.leaf(plane(0.0), &here(), index).unwrap();
        for degrees in [0.0_f64, 20.0, 45.0, 60.0, 80.0, 89.0] {
            let (sine, cosine) = degrees.to_radians().sin_cos();
            let inner = (1.0 - (sine / ior).powi(2)).sqrt();
            let reflectance = if fresnel == Fresnel::Exact {
                let s = (cosine - ior * inner) / (cosine + ior * inner);
                let p = (inner - ior * cosine) / (inner + ior * cosine);
                (s * s + p * p) / 2.0
            } else {
                let zero = ((ior - 1.0) / (ior + 1.0)).powi(2);
                zero + (1.0 - zero) * (1.0 - cosine).powi(5)
            };
            let found = look(&mut builder, [0.0, 5.0, 0.0], [sine, -cosine, 0.0], 3);
            near(found, [reflectance; 3], 1e-11);
        }
    }
}

/// Beyond the critical angle everything is mirrored, also without Fresnel's equations.
#[test]
fn total_internal_reflection_keeps_all_light() {
    let mut builder = Builder::<f64>::new();
    builder.background = Background::Constant(Rgb::WHITE);
    let water = builder.material(glass(1.5)).unwrap();
    builder.leaf(slab(-4.0, 0.0), &here(), water).unwrap();
    let mut up = |degrees: f64| {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        look(&mut builder, [0.0, -2.0, 0.0], [sine, cosine, 0.0], 6)
    };
    // The critical angle is 41.81°: beyond it the ray stays in the plate until it is cut.
    near(up(41.0), [1.0; 3], 1e-12);
    near(up(42.0), [0.0; 3], 0.0);
}

#[test]
fn absorption_follows_beers_law_and_a_hole_is_air() {
    let absorb: Rgb<f64> = rgb(0.1, 0.5, 2.0);
    let material = Material { absorb, transmit: 0.9, ..glass(1.5) };
    let expect = |length: f64, surfaces: i32| {
        absorb.to_array().map(|a| 0.9_f64.powi(surfaces) * (-a * length).exp())
    };
    let ball = |radius| Form::Sphere { center: DVec3::ZERO, radius };
    let from = |builder: &mut Builder<f64>, z: f64| {
        builder.background = Background::Constant(Rgb::WHITE);
        look(builder, [0.0, 0.0, z], [0.0, 0.0, -1.0], 8)
    };

    let mut solid = Builder::<f64>::new();
    let index = solid.material(material).unwrap();
    solid.leaf(ball(2.0), &here(), index).unwrap();
    near(from(&mut solid, 10.0), expect(4.0, 2), 1e-12);

    let mut hollow = Builder::<f64>::new();
    let index = hollow.material(material).unwrap();
    hollow.open(Operator::Difference).unwrap();
    hollow.leaf(ball(2.0), &here(), index).unwrap();
    hollow.leaf(ball(1.5), &here(), index).unwrap();
    hollow.close(index).unwrap();
    near(from(&mut hollow, 10.0), expect(1.0, 4), 1e-12);

    // The same with a ball of air in it: where objects overlap the later one rules.
    let mut bubble = Builder::<f64>::new();
    let index = bubble.material(material).unwrap();
    let air = bubble.material(Material { transmit: 0.9, ..glass(1.0) }).unwrap();
    bubble.leaf(ball(2.0), &here(), index).unwrap();
    bubble.leaf(ball(1.5), &here(), air).unwrap();
    near(from(&mut bubble, 10.0), expect(1.0, 4), 1e-12);

    // A ball of lower rank does not show, neither from outside nor from within.
    let mut hidden = Builder::<f64>::new();
    let dark = hidden.material(Material { absorb: rgb(9.0, 9.0, 9.0), ..glass(2.0) }).unwrap();
    let index = hidden.material(material).unwrap();
    hidden.leaf(ball(1.5), &here(), dark).unwrap();
    hidden.leaf(ball(2.0), &here(), index).unwrap();
    near(from(&mut hidden, 10.0), expect(4.0, 2), 1e-12);
    near(from(&mut hidden, 1.0), expect(3.0, 1), 1e-12);
}

/// What a shadow ray meets: nothing, something opaque, glass, an open sheet.
#[test]
fn transparent_occluders_filter_light() {
    let absorb: Rgb<f64> = rgb(0.2, 0.4, 0.8);
    let lit = |occluder: Option<(Form<'_, f64>, Material<f64>)>, light: Light<f64>| {
        let mut builder = Builder::<f64>::new();
        let white = Material { ambient: 0.0, diffuse: 1.0, ..Material::matte(Rgb::WHITE) };
        let floor = builder.material(white).unwrap();
        builder.leaf(plane(0.0), &here(), floor).unwrap();
        builder.light(light).unwrap();
        if let Some((form, material)) = occluder {
            let index = builder.material(material).unwrap();
            builder.leaf(form, &here(), index).unwrap();
        }
        look(&mut builder, [0.0, 0.5, 0.0], [0.0, -1.0, 0.0], 0)
    };
    let sun = Light::Directional { toward: DVec3::new(0.6, -0.8, 0.0), color: Rgb::WHITE };
    let lamp = |y: f64| Light::Point {
        at: DVec3::new(-0.75 * y, y, 0.0),
        color: Rgb::WHITE,
        attenuation: Attenuation::NONE,
    };
    let plate = slab(1.0, 2.0);
    let clear = Material { absorb, transmit: 0.9, ..glass(1.5) };
    let filtered = absorb.to_array().map(|a| 0.8 * 0.81 * (-a * 1.25).exp());

    near(lit(None, sun), [0.8; 3], 1e-12);
    near(lit(Some((plate, Material::matte(Rgb::WHITE))), sun), [0.0; 3], 0.0);
    near(lit(Some((plate, clear)), sun), filtered, 1e-12);
    near(lit(Some((plate, clear)), lamp(3.0)), filtered, 1e-12);
    // A lamp inside the plate: one surface, half the length.
    let inside = absorb.to_array().map(|a| 0.8 * 0.9 * (-a * 0.625).exp());
    near(lit(Some((plate, clear)), lamp(1.5)), inside, 1e-12);
    // A lamp below it, and a sheet without thickness.
    near(lit(Some((plate, clear)), lamp(0.9)), [0.8; 3], 1e-12);
    let corners = [[-9.0, 1.0, -9.0], [9.0, 1.0, -9.0], [0.0, 1.0, 18.0]].map(DVec3::from_array);
    near(lit(Some((Form::Triangle { corners, normals: None }, clear)), sun), [0.72; 3], 1e-12);
}

#[test]
fn light_behind_an_open_surface_does_not_shine_through() {
    let mut builder = Builder::<f32>::new();
    let white = Material { ambient: 0.0, ..Material::matte(Rgb::WHITE) };
    let index = builder.material(white).unwrap();
    let corners =
        [Vec3::new(-9.0, 0.0, -9.0), Vec3::new(9.0, 0.0, -9.0), Vec3::new(0.0, 0.0, 18.0)];
    builder.leaf(Form::Triangle { corners, normals: None }, &Affine::identity(), index).unwrap();
    builder.light(Light::Directional { toward: -Vec3::Y, color: Rgb::WHITE }).unwrap();
    near(look(&mut builder, [0.0, 3.0, 0.0], [0.0, -1.0, 0.0], 0), [0.7; 3], 1e-6);
    near(look(&mut builder, [0.0, -3.0, 0.0], [0.0, 1.0, 0.0], 0), [0.0; 3], 0.0);
}

/// Solids of lower rank within glass do not show, not by one bit, even where two of them have
/// the same surface: once rounding sent a ray from one to the other and back without end.
#[test]
fn hidden_surfaces_in_one_place_are_passed_in_bounded_steps() {
    let picture = |size: f32, hidden: &[f32]| {
        let mut builder = Builder::<f32>::new();
        let clear = Material { transmit: 0.9, ior: 1.5, ..Material::matte(Rgb::WHITE) };
        let index = builder.material(clear).unwrap();
        let center = Vec3::new(0.7, -1.1, 0.3) * size;
        for aside in hidden {
            let center = center + Vec3::Y * (aside * size);
            let ball = Form::Sphere { center, radius: size };
            builder.leaf(ball, &Affine::identity(), index).unwrap();
        }
        let around = Form::Sphere { center, radius: 3.0 * size };
        builder.leaf(around, &Affine::identity(), index).unwrap();
        builder.camera.eye = center + Vec3::new(1.3, 0.4, 1.9) * size;
        builder.camera.look_at = center;
        builder.background = Background::Constant(Rgb::WHITE);
        let scene = builder.scene().unwrap();
        let mut render: Render<f32> = Render::new(&scene, 16, 16, Depth::fixed(4)).unwrap();
        let (mut pixels, mut steps) = (Vec::new(), 0_u32);
        loop {
            match render.step() {
                Step::Traced => {}
                Step::Pixel(pixel) => pixels.push(pixel),
                Step::Done => break,
            }
            steps += 1;
            assert!(steps < 20_000, "the picture does not end");
        }
        pixels
    };
    for size in [1.0, 1e3, 1e7, 1e14] {
        for hidden in [[0.0, 0.0], [0.0, 1e-7], [0.0, 3e-7], [0.0, 0.5]] {
            assert_eq!(picture(size, &hidden), picture(size, &[]), "{hidden:?} at {size}");
        }
    }
}

//! What textures drive beside colours: the numbers of a material and its normals, and each of them only where
//! it shows.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    reason = "that is how a test fails"
)]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

use crate::oracle::Random;
use nostray::glam::DVec3;
use nostray::stats::Event;
use nostray::*;

type Builder = SceneBuilder<f64, Fixed<8, 16, 32, 32>>;

const ALL: [Parameter; 6] = [
    Parameter::Ambient,
    Parameter::Diffuse,
    Parameter::Specular,
    Parameter::Shininess,
    Parameter::Reflect,
    Parameter::Transmit,
];

/// A texture that is as bright everywhere.
fn even(builder: &mut Builder, brightness: f64) -> u16 {
    let stops = [Stop::color(0.0, Rgb::new(brightness, brightness, brightness))];
    let ramp = builder.ramp(&stops, Blend::Linear).unwrap();
    builder.texture(Texture::new(Pattern::Gradient, ramp)).unwrap()
}

/// The one pixel that looks down on a floor at y = 0 from (0, 4, 3), and how many textures were evaluated.
fn pixel(builder: &mut Builder, material: Material<f64>) -> (Rgb<f64>, u64) {
    builder.camera.eye = DVec3::new(0.0, 4.0, 3.0);
    let material = builder.material(material).unwrap();
    let floor = Form::Plane { normal: DVec3::Y, offset: 0.0 };
    builder.leaf(floor, &Affine::identity(), material).unwrap();
    let scene = builder.scene().unwrap();
    let render =
        Render::<f64, 4, 8, Stats>::with_tally(&scene, 1, 1, Depth::fixed(3), Stats::default());
    let mut render = render.unwrap();
    let pixel = render.next().unwrap();
    (pixel.color, render.tally().of(Event::Texture))
}

/// A scene with a lamp above the floor (or below it), the colour and every number of its material driven by a
/// texture each.
fn driven(lamp: f64, change: impl Fn(&mut Material<f64>)) -> (Rgb<f64>, u64) {
    let mut builder = Builder::new();
    builder.ambient = Rgb::WHITE;
    let at = DVec3::new(0.8, lamp, -3.0);
    let attenuation = Attenuation::NONE;
    builder.light(Light::Point { at, color: Rgb::WHITE, attenuation }).unwrap();
    let channels = ALL.map(|of| {
        let texture = even(&mut builder, 0.5);
        Channel::Share { of, texture, low: 0.0, high: 1.0 }
    });
    let channels = builder.channels(&channels).unwrap();
    let color = Paint::Texture(even(&mut builder, 0.5));
    let mut material = Material { color, channels, ..Material::PLAIN };
    material.ior = 1.0;
    change(&mut material);
    pixel(&mut builder, material)
}

#[test]
fn only_what_shows_is_evaluated() {
    let nothing = Material { ambient: 0.0, diffuse: 0.0, ..Material::PLAIN };
    let Material { ambient, diffuse, .. } = nothing;
    let with = |lamp: f64, change: &dyn Fn(&mut Material<f64>)| {
        let (_, count) = driven(lamp, |material| {
            (material.ambient, material.diffuse) = (ambient, diffuse);
            change(material);
        });
        count
    };
    assert_eq!(with(4.0, &|_| ()), 0, "every number is 0");
    assert_eq!(with(4.0, &|m| m.ambient = 0.5), 2, "the ambient share and the colour");
    assert_eq!(with(4.0, &|m| m.diffuse = 0.5), 2, "the diffuse share and the colour");
    assert_eq!(with(-4.0, &|m| m.diffuse = 0.5), 0, "no lamp shines on it");
    assert_eq!(with(4.0, &|m| (m.ambient, m.diffuse) = (0.5, 0.5)), 3, "the colour only once");
    assert_eq!(with(4.0, &|m| m.specular = 0.5), 2, "the strength and the exponent");
    assert_eq!(with(-4.0, &|m| m.specular = 0.5), 0);
    let metal = |m: &mut Material<f64>| (m.specular, m.metallic) = (0.5, true);
    assert_eq!(with(4.0, &metal), 3, "a metal's highlight has the colour");
    assert_eq!(with(4.0, &|m| m.reflect = 0.5), 1);
    assert_eq!(with(4.0, &|m| (m.reflect, m.metallic) = (0.5, true)), 2);
    // The ray that goes through leaves the half-space nowhere.
    assert_eq!(with(4.0, &|m| m.transmit = 0.5), 1);
}

#[test]
fn a_channel_is_a_share_of_its_number() {
    // Half of each number is half of each light.
    for change in [
        |m: &mut Material<f64>| (m.ambient, m.diffuse) = (0.8, 0.0),
        |m: &mut Material<f64>| (m.ambient, m.diffuse) = (0.0, 0.9),
    ] {
        let (driven_light, _) = driven(4.0, change);
        let (plain, _) = driven(4.0, |material| {
            change(material);
            material.channels = Channels::NONE;
        });
        assert!(plain.r > 0.0 && (driven_light.r - plain.r * 0.5).abs() <= 1e-15);
    }
    // The exponent: a highlight whose cosine is c is c^n wide.
    let shiny = |shininess: f64, driven_by: bool| {
        let (light, _) = driven(4.0, |material| {
            (material.ambient, material.diffuse, material.specular) = (0.0, 0.0, 1.0);
            material.shininess = shininess;
            if !driven_by {
                material.channels = Channels::NONE;
            }
        });
        light.r
    };
    // The strength is halved too.
    assert!((shiny(40.0, true) - shiny(20.0, false) * 0.5).abs() <= 1e-12);
    assert!(shiny(20.0, false) > shiny(40.0, false));
}

#[test]
fn channels_of_one_number_are_multiplied_and_mapped() {
    let mut builder = Builder::new();
    builder.ambient = Rgb::WHITE;
    let (quarter, white) = (even(&mut builder, 0.25), even(&mut builder, 1.0));
    let of = Parameter::Ambient;
    let channels = [
        Channel::Share { of, texture: quarter, low: 1.0, high: 0.2 },
        Channel::Share { of, texture: white, low: 0.0, high: 0.5 },
        Channel::Share { of: Parameter::Diffuse, texture: white, low: 0.0, high: 0.0 },
    ];
    let channels = builder.channels(&channels).unwrap();
    let (light, _) = pixel(&mut builder, Material { channels, ..Material::PLAIN });
    assert!((light.r - 0.8 * 0.5).abs() <= 1e-15, "{light:?}");
}

/// A lamp, a pane of glass between it and the floor, and a texture on the transmission of the pane.
#[test]
fn light_through_a_pane_has_the_texture_of_the_pane() {
    let lit = |brightness: f64| {
        let mut builder = Builder::new();
        let at = DVec3::new(0.0, 8.0, 0.0);
        let attenuation = Attenuation::NONE;
        builder.light(Light::Point { at, color: Rgb::WHITE, attenuation }).unwrap();
        let texture = even(&mut builder, brightness);
        let share = Channel::Share { of: Parameter::Transmit, texture, low: 0.0, high: 1.0 };
        let channels = builder.channels(&[share]).unwrap();
        let pane = Material { diffuse: 0.0, transmit: 1.0, channels, ..Material::PLAIN };
        let pane = builder.material(pane).unwrap();
        let vertices = [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]];
        let vertices = vertices.map(|[x, z]| DVec3::new(x, 6.0, z));
        builder.leaf(Form::Polygon { vertices: &vertices }, &Affine::identity(), pane).unwrap();
        pixel(&mut builder, Material { ambient: 0.0, ..Material::PLAIN }).0.r
    };
    let (clear, half, dark) = (lit(1.0), lit(0.5), lit(0.0));
    assert!(clear > 0.5 && (half - clear * 0.5).abs() <= 1e-15 && dark == 0.0);
}

/// The light of a lamp at right angles to a floor with a relief, from place to place.
fn relief_light(texture: Texture<f64>, depth: f64, step: f64, p: [f64; 2]) -> f64 {
    let mut builder = Builder::new();
    let toward = DVec3::new(-0.6, -0.8, 0.0);
    builder.light(Light::Directional { toward, color: Rgb::WHITE }).unwrap();
    let texture = builder.texture(texture).unwrap();
    let channels = builder.channels(&[Channel::Relief { texture, depth, step }]).unwrap();
    builder.camera.look_at = DVec3::new(p[0], 0.0, p[1]);
    pixel(&mut builder, Material { ambient: 0.0, channels, ..Material::PLAIN }).0.r
}

#[test]
fn a_slope_that_faces_the_lamp_is_lighter() {
    // x from 0 to 1: rises along x; the lamp is at the side of +x.
    let ramp = Texture::new(Pattern::Gradient, Ramp::GREY);
    let light = |depth: f64| relief_light(ramp, depth, 0.01, [0.5, 0.0]);
    let (flat, rising, falling) = (light(0.0), light(-0.5), light(0.5));
    assert!((flat - 0.8).abs() <= 1e-12);
    // The normal of a rise of s is (−s, 1, 0) over its length.
    let expected = |s: f64| (0.6 * -s + 0.8) / f64::sqrt(1.0 + s * s);
    assert!((rising - expected(-0.5)).abs() <= 1e-9, "{rising}");
    assert!((falling - expected(0.5)).abs() <= 1e-9, "{falling}");
}

#[test]
fn slopes_by_formula_are_slopes_by_difference() {
    let mut random = Random::new(31);
    let grey = [Stop::color(0.0, Rgb::BLACK), Stop::color(1.0, Rgb::WHITE)];
    for pattern in [Pattern::Noise, Pattern::Turbulence, Pattern::Dents, Pattern::Wrinkles] {
        let mut tilted = 0;
        for _ in 0..40 {
            let [x, _, z] = random.cube();
            let p = [x * 5.0, z * 5.0];
            let formula = Texture {
                octaves: Octaves::new(2),
                size: [0.7, 0.9, 1.3],
                ..Texture::new(pattern, Ramp::GREY)
            };
            let by_formula = relief_light(formula, 0.3, 1e-4, p);
            // The same levels, of which the tracer does not know that they are noise alone.
            let mut builder = Builder::new();
            let toward = DVec3::new(-0.6, -0.8, 0.0);
            builder.light(Light::Directional { toward, color: Rgb::WHITE }).unwrap();
            let ramp = builder.ramp(&grey, Blend::Linear).unwrap();
            let texture = builder.texture(Texture { ramp, ..formula }).unwrap();
            let relief = Channel::Relief { texture, depth: 0.3, step: 1e-4 };
            let channels = builder.channels(&[relief]).unwrap();
            builder.camera.look_at = DVec3::new(p[0], 0.0, p[1]);
            let material = Material { ambient: 0.0, channels, ..Material::PLAIN };
            let (compared, count) = pixel(&mut builder, material);
            assert_eq!(count, 4, "four heights are compared");
            let gap = (by_formula - compared.r).abs();
            assert!(gap <= 2e-4, "{pattern:?} at {p:?}: {by_formula} {compared:?}");
            tilted += u32::from((by_formula - 0.8).abs() > 0.01);
        }
        assert!(tilted > 5, "{pattern:?} tilts {tilted} normals");
    }
}

#[test]
fn a_relief_is_only_worked_out_where_light_asks_for_it() {
    let count = |change: &dyn Fn(&mut Material<f64>)| {
        let mut builder = Builder::new();
        builder.ambient = Rgb::WHITE;
        let texture = builder.texture(Texture::new(Pattern::Leopard, Ramp::GREY)).unwrap();
        let relief = Channel::Relief { texture, depth: 0.1, step: 0.01 };
        let channels = builder.channels(&[relief]).unwrap();
        let mut material = Material { diffuse: 0.0, channels, ..Material::PLAIN };
        change(&mut material);
        pixel(&mut builder, material).1
    };
    assert_eq!(count(&|_| ()), 0);
    assert_eq!(count(&|m| m.diffuse = 1.0), 4);
    assert_eq!(count(&|m| m.reflect = 1.0), 4);
    assert_eq!(count(&|m| m.transmit = 0.5), 4);
}

#[test]
fn a_relief_seen_from_behind_is_turned_over() {
    // From within a half-space that fills y ≤ 0, with the lamp below: what rises outside is a hollow inside.
    let light = |depth: f64| {
        let mut builder = Builder::new();
        let toward = DVec3::new(0.6, 0.8, 0.0);
        builder.light(Light::Directional { toward, color: Rgb::WHITE }).unwrap();
        let texture = builder.texture(Texture::new(Pattern::Gradient, Ramp::GREY)).unwrap();
        let relief = Channel::Relief { texture, depth, step: 0.01 };
        let channels = builder.channels(&[relief]).unwrap();
        let material = Material { ambient: 0.0, channels, ..Material::PLAIN };
        let material = builder.material(material).unwrap();
        let floor = Form::Plane { normal: DVec3::Y, offset: 0.0 };
        builder.leaf(floor, &Affine::identity(), material).unwrap();
        builder.camera.eye = DVec3::new(0.5, -4.0, 0.1);
        builder.camera.look_at = DVec3::new(0.5, 0.0, 0.0);
        let scene = builder.scene().unwrap();
        let mut render = Render::<f64>::new(&scene, 1, 1, Depth::fixed(2)).unwrap();
        render.next().unwrap().color.r
    };
    // Toward the lamp is (−0.6, −0.8, 0); the inner normal of a rise of s is (s, −1, 0) over its length.
    let expected = |s: f64| (-0.6 * s + 0.8) / f64::sqrt(1.0 + s * s);
    for s in [0.0, 0.3, -0.3] {
        assert!((light(s) - expected(s)).abs() <= 1e-9, "{s}: {}", light(s));
    }
}

//! Patterns and mappings: no input without a colour, seams and poles, the same picture in every format, and
//! nothing evaluated that does not show.
//!
//! `cargo test --test pictures textures -- --nocapture` prints how near the formats come to each other.
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
use nostray::texture::NESTING_MAX;
use nostray::*;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

type Builder<S> = SceneBuilder<S, Fixed<8, 16, 64, 64, 0, 64>>;

/// A small image of each format.
const IMAGES: [(Format, u16, u16, &[u8]); 4] = [
    (Format::Rgb8, 2, 2, &[255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255]),
    (Format::Grey8, 3, 2, &[0, 128, 255, 64, 32, 16]),
    (Format::Rgb565, 2, 1, &[0xf8, 0x00, 0x07, 0xe0]),
    (Format::Mono1, 10, 2, &[0b1010_1010, 0b0100_0000, 0b1111_0000, 0b1000_0000]),
];

fn patterns<S: Scalar>() -> Vec<Pattern<S>> {
    let (tenth, three) = (S::from_ratio(1, 10), S::from_i32(3));
    let mut all = vec![
        Pattern::Checker,
        Pattern::Stripes,
        Pattern::Brick { mortar: tenth },
        Pattern::Hexagons { gap: tenth },
        Pattern::Gradient,
        Pattern::Radial,
        Pattern::Onion,
        Pattern::Wood { wobble: S::HALF },
        Pattern::Marble { strength: three },
        Pattern::Granite,
        Pattern::Agate { strength: three },
        Pattern::Leopard,
        Pattern::Spots { radius: S::HALF },
        Pattern::Cells,
        Pattern::Crackle,
        Pattern::Noise,
        Pattern::Turbulence,
        Pattern::Waves,
        Pattern::Ripples,
        Pattern::Dents,
        Pattern::Wrinkles,
    ];
    for image in 0..IMAGES.len() as u16 {
        for filter in [Filter::Nearest, Filter::Bilinear] {
            all.push(Pattern::Image { image, filter });
        }
    }
    all
}

fn mappings<S: Scalar>() -> [Mapping<S>; 7] {
    [
        Mapping::Solid,
        Mapping::Uv,
        Mapping::Planar,
        Mapping::Spherical,
        Mapping::Cylindrical,
        Mapping::Cubic,
        Mapping::Toroidal { major: S::TWO },
    ]
}

fn color<S: Scalar>(r: f64, g: f64, b: f64) -> Rgb<S> {
    Rgb::new(S::from_f64(r), S::from_f64(g), S::from_f64(b))
}

/// A scene of one texture for each pattern, in the order of [`patterns`], on three stops where it takes any.
fn gallery<S: Scalar>(change: impl Fn(&mut Texture<S>)) -> Builder<S> {
    let mut builder = Builder::new();
    for (format, width, height, bytes) in IMAGES {
        let image = Image { first: 0, width, height, format, transfer: Transfer::Srgb };
        builder.image(image, bytes).unwrap();
    }
    let stops = [
        Stop::color(S::ZERO, color(1.0, 0.1, 0.0)),
        Stop::color(S::HALF, color(0.0, 0.8, 0.3)),
        Stop::color(S::ONE, color(0.2, 0.0, 0.9)),
    ];
    let ramp = builder.ramp(&stops, Blend::Linear).unwrap();
    for pattern in patterns::<S>() {
        let is_image = matches!(pattern, Pattern::Image { .. });
        let mut texture = Texture::new(pattern, if is_image { Ramp::GREY } else { ramp });
        texture.octaves = Octaves::new(4);
        texture.seed = 3;
        change(&mut texture);
        builder.texture(texture).unwrap();
    }
    builder
}

fn vector<S: Scalar>([x, y, z]: [f64; 3]) -> S::Vec3 {
    S::Vec3::new(S::from_f64(x), S::from_f64(y), S::from_f64(z))
}

fn see<S: Scalar>(scene: &Scene<'_, S>, texture: u16, p: [f64; 3]) -> texture::Seen<S> {
    scene.see(Paint::Texture(texture), &Spot::free(vector::<S>(p)))
}

/// Any number that a format has.
fn any_number<S: Scalar>() -> impl Strategy<Value = S> {
    prop_oneof![
        any::<f64>().prop_map(S::from_f64),
        (-1e4..1e4).prop_map(S::from_f64),
        (-40_000_i32..40_000).prop_map(S::from_i32),
        Just(S::FAR),
        Just(-S::FAR),
        // Not a number, where there is such a thing.
        Just(S::FAR + -S::FAR),
        Just(S::TINY),
        Just(-S::ZERO),
    ]
}

fn any_place<S: Scalar>() -> impl Strategy<Value = [S; 3]> {
    [any_number::<S>(), any_number::<S>(), any_number::<S>()]
}

fn colours_anywhere<S: Scalar>(p: [S; 3], size: f64, warp: f64, wrap: Wrap, seed: u32) {
    for mapping in mappings::<S>() {
        let builder = gallery::<S>(|texture| {
            *texture = Texture { mapping, seed, wrap: [wrap; 2], ..*texture };
            texture.size = [S::from_f64(size), S::ONE, S::from_f64(1.0 / size)];
            texture.warp = S::from_f64(warp);
        });
        let scene = builder.scene().unwrap();
        let spot = Spot::free(S::Vec3::from_array(p));
        for texture in 0..scene.parts().textures.len() as u16 {
            let seen = scene.see(Paint::Texture(texture), &spot);
            let pattern = scene.parts().textures[usize::from(texture)].pattern;
            let [r, g, b] = seen.color.to_array();
            for part in [r, g, b] {
                let legal = part >= S::ZERO && part <= S::ONE + S::from_ratio(1, 1000);
                assert!(legal, "{pattern:?} {mapping:?} at {p:?}: {seen:?}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, rng_seed: RngSeed::Fixed(2), ..ProptestConfig::default() })]

    #[test]
    fn every_place_has_a_colour(
        single in any_place::<f32>(),
        double in any_place::<f64>(),
        coarse in any_place::<Q16>(),
        fine in any_place::<Q32>(),
        size in 0.01..100.0,
        warp in -3.0..3.0,
        wrap in prop::sample::select(vec![Wrap::Endless, Wrap::Repeat, Wrap::Mirror, Wrap::Clamp]),
        seed: u32,
    ) {
        colours_anywhere::<f32>(single, size, warp, wrap, seed);
        colours_anywhere::<f64>(double, size, warp, wrap, seed);
        colours_anywhere::<Q16>(coarse, size, warp, wrap, seed);
        colours_anywhere::<Q32>(fine, size, warp, wrap, seed);
    }
}

/// The mean difference of the colours of two formats, and the share of places that differ clearly.
fn gaps<S: Scalar>() -> Vec<(f64, f64)> {
    let (ours, theirs) = (gallery::<S>(|_| ()), gallery::<f64>(|_| ()));
    let (ours, theirs) = (ours.scene().unwrap(), theirs.scene().unwrap());
    let count = theirs.parts().textures.len() as u16;
    (0..count)
        .map(|texture| {
            let mut random = Random::new(21);
            let (mut sum, mut jumps) = (0.0, 0.0);
            for _ in 0..2000 {
                // What all formats hold exactly.
                let p = random.cube().map(|v| (v * 20.0 * 1024.0).floor() / 1024.0);
                let (a, b) = (see(&ours, texture, p).color, see(&theirs, texture, p).color);
                let gap = (0..3)
                    .map(|n| (a.to_array()[n].to_f64() - b.to_array()[n]).abs())
                    .fold(0.0, f64::max);
                if gap > 0.05 {
                    jumps += 1.0;
                } else {
                    sum += gap;
                }
            }
            (sum / 2000.0, jumps / 2000.0)
        })
        .collect()
}

fn near_double<S: Scalar>(mean_max: f64, jumps_max: f64) {
    for ((mean, jumps), pattern) in gaps::<S>().into_iter().zip(patterns::<f64>()) {
        println!("{} {pattern:?}: mean {mean:.1e}, jumps {jumps}", S::NAME);
        assert!(mean <= mean_max, "{} {pattern:?}: {mean:e}", S::NAME);
        assert!(jumps <= jumps_max, "{} {pattern:?}: {jumps} jump", S::NAME);
    }
}

#[test]
fn every_format_draws_the_same_patterns() {
    near_double::<f32>(4e-6, 0.0);
    near_double::<Q16>(6e-4, 0.001);
    near_double::<Q32>(1e-8, 0.0);
}

/// The coordinates on both sides of the seam of a mapping about the y axis.
fn seam<S: Scalar>(mapping: Mapping<S>) {
    let mut random = Random::new(22);
    for _ in 0..500 {
        let [x, y, _] = random.cube();
        let x = -x.abs() - 0.01;
        let at = |z: S| {
            let p = S::Vec3::new(S::from_f64(x), S::from_f64(y), z);
            mapping.coordinates(p, &Spot::free(p)).to_array()
        };
        let sides = [at(S::EPSILON), at(-S::EPSILON), at(S::ZERO), at(-S::ZERO)];
        for [u, _, w] in sides {
            assert!(u >= S::ZERO && u < S::ONE && w == S::ZERO, "{mapping:?}: u is {u}");
            let fold = u.min(S::ONE - u);
            assert!(fold <= S::EPSILON_ROOT, "{mapping:?}: {u} is not at the seam");
        }
        // v does not know of the seam.
        let [first, second, ..] = sides;
        assert!((first[1] - second[1]).abs() <= S::EPSILON * S::from_i32(8));
    }
}

fn seams<S: Scalar>() {
    seam::<S>(Mapping::Spherical);
    seam::<S>(Mapping::Cylindrical);
    seam::<S>(Mapping::Toroidal { major: S::HALF });
    for mapping in mappings::<S>() {
        // Poles, the centre, edges and corners.
        for x in [-1, 0, 1] {
            for y in [-1, 0, 1] {
                for z in [-1, 0, 1] {
                    let p = S::Vec3::new(S::from_i32(x), S::from_i32(y), S::from_i32(z));
                    let found = mapping.coordinates(p, &Spot::free(p));
                    assert!(found.is_finite() && found.max_abs() <= S::ONE, "{mapping:?} {p:?}");
                }
            }
        }
    }
    let latitude = |y: i32| {
        let p = S::Vec3::new(S::ZERO, S::from_i32(y), S::ZERO);
        Vector::y(Mapping::<S>::Spherical.coordinates(p, &Spot::free(p)))
    };
    assert_eq!([latitude(1), latitude(0)], [S::ONE, S::HALF]);
    assert!(latitude(-1) <= S::EPSILON && latitude(-3) <= S::EPSILON);
}

#[test]
fn u_joins_at_the_seam_and_poles_are_finite() {
    seams::<f32>();
    seams::<f64>();
    seams::<Q16>();
    seams::<Q32>();
}

#[test]
fn a_repeated_pattern_has_no_seam_on_a_ball() {
    for pattern in [Pattern::Checker, Pattern::Image { image: 1, filter: Filter::Bilinear }] {
        let builder = gallery::<f64>(|texture| {
            texture.pattern = pattern;
            if matches!(pattern, Pattern::Image { .. }) {
                texture.ramp = Ramp::GREY;
            } else {
                texture.ramp.count = 2;
            }
            texture.mapping = Mapping::Spherical;
            texture.size = [0.125, 0.25, 1.0];
            texture.wrap = [Wrap::Endless, Wrap::Clamp];
        });
        let scene = builder.scene().unwrap();
        for n in 0..200 {
            let y = f64::from(n) / 100.0 - 0.995;
            let side = |z: f64| see(&scene, 0, [-1.0, y, z]).color;
            let gap = (side(1e-12).r - side(-1e-12).r).abs();
            if pattern == Pattern::Checker {
                // An even number of cells around: the seam is one of their edges.
                assert_eq!(gap, 0.9 - 0.1 + 0.2, "at {y}");
            } else {
                assert!(gap <= 1e-8, "at {y}: {gap}");
            }
        }
    }
}

#[test]
fn own_coordinates_and_frames_are_followed() {
    let mut builder = gallery::<f64>(|_| ());
    let moved = Affine::translate(glam::DVec3::new(0.25, 0.0, 0.0));
    let turned = Affine::rotate(Axis::Z, 90.0);
    let frame = builder.placement(&turned.then(&moved)).unwrap();
    let gradient = Texture {
        frame: Some(frame),
        mapping: Mapping::Planar,
        ..Texture::new(Pattern::Gradient, Ramp::GREY)
    };
    let index = builder.texture(gradient).unwrap();
    let shape = Texture { space: Space::Shape, ..Texture::new(Pattern::Gradient, Ramp::GREY) };
    let own = builder.texture(shape).unwrap();
    let uv = builder.texture(Texture { mapping: Mapping::Uv, ..shape }).unwrap_or(0);
    let scene = builder.scene();
    // A mapping to a surface's own coordinates begins with neither space.
    assert!(matches!(scene, Err(SceneError::OutOfRange { field: "place", .. })));
    let _ = uv;
    let mut builder = gallery::<f64>(|_| ());
    let frame = builder.placement(&turned.then(&moved)).unwrap();
    builder.texture(Texture { frame: Some(frame), ..gradient }).unwrap();
    builder.texture(shape).unwrap();
    let scene = builder.scene().unwrap();
    // x of the pattern is y of the surface, from the moved origin.
    for y in [0.1, 0.4, 0.9] {
        assert!((see(&scene, index, [7.0, y, 3.0]).color.r - y).abs() <= 1e-12);
    }
    let local = glam::DVec3::new(0.625, 0.0, 0.0);
    let spot = Spot { position: glam::DVec3::ZERO, local, on: None };
    assert_eq!(scene.see(Paint::Texture(own), &spot).color.r, 0.625);
}

#[test]
fn a_signature_changes_at_edges_and_not_in_between() {
    let mut builder = Builder::<f64>::new();
    let stops = [Stop::color(0.0, Rgb::WHITE), Stop::color(1.0, Rgb::BLACK)];
    let two = builder.ramp(&stops, Blend::Linear).unwrap();
    let step = Ramp { blend: Blend::Step, ..two };
    let inner = builder.texture(Texture { size: [0.25; 3], ..Texture::new(Pattern::Checker, two) });
    let nested =
        [Stop::color(0.0, Rgb::WHITE), Stop { at: 1.0, paint: Paint::Texture(inner.unwrap()) }];
    let nested = builder.ramp(&nested, Blend::Linear).unwrap();
    let checker = builder.texture(Texture::new(Pattern::Checker, nested)).unwrap();
    let smooth = builder.texture(Texture::new(Pattern::Noise, two)).unwrap();
    let onion = builder.texture(Texture::new(Pattern::Onion, two)).unwrap();
    let stepped = builder.texture(Texture::new(Pattern::Gradient, step)).unwrap();
    let scene = builder.scene().unwrap();
    let sign = |texture, x: f64| see(&scene, texture, [x, 0.1, 0.1]).signature;
    assert_eq!(sign(checker, 0.1), sign(checker, 0.9), "white has no cells");
    assert_ne!(sign(checker, 0.9), sign(checker, 1.1));
    assert_ne!(sign(checker, 1.1), sign(checker, 1.3), "the cells of the inner checker");
    assert_eq!(sign(checker, 1.05), sign(checker, 1.2));
    for n in 0..100 {
        let x = f64::from(n) * 0.1;
        assert_eq!(sign(smooth, x), sign(smooth, 0.0), "what fades has no edge");
    }
    assert_ne!(sign(onion, 0.97), sign(onion, 1.03), "shells begin anew");
    assert_eq!(sign(onion, 0.2), sign(onion, 0.9));
    assert_ne!(sign(stepped, 0.9), sign(stepped, 1.1), "a step of a ramp");
    assert_eq!(scene.see(Paint::Solid(Rgb::WHITE), &Spot::free(glam::DVec3::ZERO)).signature, 0);
}

#[test]
fn ramps_mix_textures_by_their_weights() {
    let mut builder = Builder::<f64>::new();
    // Each a gradient from the one before to white: at x the share of the first is (1 − x)ⁿ.
    let mut below = Paint::Solid(Rgb::BLACK);
    for _ in 0..NESTING_MAX {
        let stops = [Stop { at: 0.0, paint: below }, Stop::color(1.0, Rgb::WHITE)];
        let ramp = builder.ramp(&stops, Blend::Linear).unwrap();
        below = Paint::Texture(builder.texture(Texture::new(Pattern::Gradient, ramp)).unwrap());
    }
    {
        let scene = builder.scene().unwrap();
        for x in [0.0, 0.125, 0.5, 0.75, 1.0] {
            let found = see(&scene, NESTING_MAX as u16 - 1, [x, 0.0, 0.0]).color.r;
            let expected = 1.0 - f64::powi(1.0 - x, NESTING_MAX as i32);
            assert!((found - expected).abs() <= 1e-12, "{x}: {found}");
        }
    }
    let stops = [Stop { at: 0.0, paint: below }, Stop::color(1.0, Rgb::WHITE)];
    let ramp = builder.ramp(&stops, Blend::Linear).unwrap();
    builder.texture(Texture::new(Pattern::Gradient, ramp)).unwrap();
    let at = Item::Texture(NESTING_MAX as u32);
    assert_eq!(builder.scene().err(), Some(SceneError::TooDeep { at, limit: NESTING_MAX as u32 }));
}

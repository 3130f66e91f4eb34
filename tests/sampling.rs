//! Several samples a pixel: the same in any order, one of them the plain picture, their mean without bias;
//! lenses, lights with an extent and rough mirrors, and that nobody pays who does not ask.

#![allow(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    clippy::panic,
    reason = "a test may fail loudly"
)]

use nostray::camera::Lens;
use nostray::*;

type Picture<'a, S, P = render::Centre, T = ()> = Render<'a, S, 7, 32, T, P>;
type Builder<S> = SceneBuilder<S, Fixed<8, 16, 8, 16>>;

fn v<S: Scalar>(x: f64, y: f64, z: f64) -> S::Vec3 {
    S::Vec3::from_array([x, y, z].map(S::from_f64))
}

fn rgb<S: Scalar>(r: f64, g: f64, b: f64) -> Rgb<S> {
    let [r, g, b] = [r, g, b].map(S::from_f64);
    Rgb::new(r, g, b)
}

fn white<S: Scalar>(amount: f64) -> Rgb<S> {
    rgb(amount, amount, amount)
}

/// A ball of glass and a rough mirror on a mirror floor, under lights of every extent.
fn studio<S: Scalar>(lens: bool) -> Builder<S> {
    let f = S::from_f64;
    let mut scene = Builder::new();
    let (fov, aperture, focus) = (f(40.0), f(0.2), f(5.0));
    scene.camera.eye = v::<S>(0.5, 2.0, 5.0);
    scene.camera.look_at = v::<S>(0.0, 0.5, 0.0);
    scene.camera.projection = if lens {
        Projection::ThinLens { fov, aperture, focus }
    } else {
        Projection::Pinhole { fov }
    };
    scene.background = Background::Gradient { bottom: white(0.2), top: rgb(0.2, 0.4, 0.9) };
    scene.ambient = white(0.1);
    let dull = Material::matte(rgb(0.8, 0.5, 0.3));
    let floor = scene.material(Material { reflect: f(0.3), ..dull }).unwrap();
    let (reflect, roughness) = (f(0.8), f(0.3));
    let rough = scene.material(Material { reflect, roughness, ..dull }).unwrap();
    let (transmit, ior) = (f(0.9), f(1.5));
    let clear = Material { transmit, ior, diffuse: f(0.1), ..dull };
    let glass = scene.material(clear).unwrap();
    let here = Affine::identity();
    let ground = Form::Plane { normal: v::<S>(0.0, 1.0, 0.0), offset: S::ZERO };
    scene.leaf(ground, &here, floor).unwrap();
    for (x, material) in [(-0.9, rough), (0.9, glass)] {
        let (center, radius) = (v::<S>(x, 0.8, 0.0), f(0.8));
        scene.leaf(Form::Sphere { center, radius }, &here, material).unwrap();
    }
    let emitters = [
        Emitter::Rectangle {
            center: v::<S>(-2.0, 4.0, 2.0),
            edges: [v::<S>(1.0, 0.0, 0.0), v::<S>(0.0, 0.0, 1.0)],
        },
        Emitter::Disc {
            center: v::<S>(3.0, 3.0, 1.0),
            normal: S::toward(v::<S>(-3.0, -3.0, -1.0)).0,
            radius: f(0.5),
        },
        Emitter::Sphere { center: v::<S>(0.0, 4.0, -3.0), radius: f(0.6) },
    ];
    for emitter in emitters {
        let (color, attenuation) = (white(0.4), Attenuation::NONE);
        scene.light(Light::Area { emitter, color, attenuation }).unwrap();
    }
    scene
}

const SIZE: [u32; 2] = [16, 12];

fn bits<S: Scalar>(pixel: &Pixel<S>) -> Vec<u8> {
    let numbers = pixel.color.to_array().into_iter().chain([pixel.spent]);
    let bytes = numbers.flat_map(|number| number.to_le_bytes().as_ref().to_vec());
    [pixel.x, pixel.y].iter().flat_map(|n| n.to_le_bytes()).chain(bytes).collect()
}

fn plain<'a, S: Scalar>(scene: &Scene<'a, S>) -> Picture<'a, S> {
    Picture::new(scene, SIZE[0], SIZE[1], Depth::fixed(4)).unwrap()
}

fn sampled<'a, S: Scalar>(
    scene: &Scene<'a, S>,
    sampler: Sampler,
) -> Picture<'a, S, render::Sampled<S>> {
    plain(scene).sampled(sampler).unwrap()
}

/// All pixels of a picture in the order of rows, rendered from the last to the first.
fn backwards<S: Scalar>(scene: &Scene<'_, S>, sampler: Sampler) -> Vec<Vec<u8>> {
    let mut picture = sampled(scene, sampler);
    let places = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)));
    let mut pixels: Vec<_> = places
        .rev()
        .map(|(x, y)| {
            picture.seek(x, y);
            bits(&picture.next().unwrap())
        })
        .collect();
    pixels.reverse();
    pixels
}

#[test]
fn order_and_tiles_do_not_matter() {
    fn check<S: Scalar>() {
        let builder = studio::<S>(true);
        let scene = builder.scene().unwrap();
        for spread in Spread::ALL {
            let sampler = Sampler { spread, filter: PixelFilter::Tent, samples: 5, seed: 8 };
            let whole: Vec<_> = sampled(&scene, sampler).map(|pixel| bits(&pixel)).collect();
            assert_eq!(whole.len(), (SIZE[0] * SIZE[1]) as usize);
            assert!(backwards(&scene, sampler) == whole, "{} {spread:?}", S::NAME);
            let mut tiled = 0;
            for (columns, rows) in [(0..5, 0..12), (5..16, 0..7), (5..16, 7..30)] {
                for pixel in sampled(&scene, sampler).only_tile(columns, rows) {
                    assert!(whole[(pixel.y * SIZE[0] + pixel.x) as usize] == bits(&pixel));
                    tiled += 1;
                }
            }
            assert_eq!(tiled, whole.len());
        }
        let other = Sampler { seed: 9, ..Sampler::new(5) };
        assert!(backwards(&scene, other) != backwards(&scene, Sampler::new(5)), "the seed counts");
    }
    check::<f32>();
    check::<f64>();
    check::<Q16>();
    check::<Q32>();
}

#[test]
fn one_sample_is_the_plain_picture() {
    fn check<S: Scalar>() {
        let builder = studio::<S>(true);
        let scene = builder.scene().unwrap();
        let one = Sampler { filter: PixelFilter::Tent, seed: 3, ..Sampler::new(1) };
        let expected: Vec<_> = plain(&scene).map(|pixel| bits(&pixel)).collect();
        let found: Vec<_> = sampled(&scene, one).map(|pixel| bits(&pixel)).collect();
        assert!(found == expected, "{}", S::NAME);
    }
    check::<f32>();
    check::<f64>();
    check::<Q16>();
    check::<Q32>();
}

/// A lens of no effect: what is in focus is the same for each of its points, and it is met within it.
#[test]
fn rays_through_the_lens_meet_in_the_plane_in_focus() {
    let (fov, aperture, focus) = (50.0, 0.5, 4.0);
    let camera = Camera::<f64> {
        eye: v::<f64>(1.0, 2.0, 3.0),
        look_at: v::<f64>(4.0, 2.5, -2.0),
        up: v::<f64>(0.1, 1.0, 0.0),
        projection: Projection::ThinLens { fov, aperture, focus },
    };
    let pinhole = Camera { projection: Projection::Pinhole { fov }, ..camera };
    let axis = Vector::normalize(camera.look_at - camera.eye);
    // One pixel of the middle of a lens, and its other points by a picture of what is behind.
    let (lens, hole) = (Lens::new(&camera, 30, 20), Lens::new(&pinhole, 30, 20));
    for (x, y) in [(0, 0), (17, 4), (29, 19)] {
        let (through, straight) = (lens.ray(x, y, [0.3, 0.8]), hole.ray(x, y, [0.3, 0.8]));
        assert_eq!(through.origin, straight.origin);
        assert!((through.dir - straight.dir).max_abs() <= 1e-15);
        assert!(Vector::dot(through.dir, axis) > 0.0);
    }
}

/// The mean of the one pixel of a picture that looks along −z, with as many samples as there can be.
fn mean(builder: &Builder<f64>) -> Rgb<f64> {
    let scene = builder.scene().unwrap();
    let picture = Picture::<f64>::new(&scene, 1, 1, Depth::fixed(4)).unwrap();
    let mut picture = picture.sampled(Sampler::new(256)).unwrap();
    picture.next().unwrap().color
}

/// Looks along −z from a place, through an angle so small that all rays are nearly the same.
fn looking(eye: [f64; 3], at: [f64; 3]) -> Builder<f64> {
    let mut builder = Builder::new();
    builder.camera = Camera::pinhole(
        v::<f64>(eye[0], eye[1], eye[2]),
        v::<f64>(at[0], at[1], at[2]),
        v::<f64>(0.0, 1.0, 0.0),
        1e-4,
    );
    builder
}

/// A bright half-plane before a black background, out of focus by a known amount: the edge becomes the
/// share of a disc on one side of a chord.
#[test]
fn out_of_focus_a_point_becomes_a_disc() {
    for offset in [-0.3, 0.0, 0.1, 0.2, 0.45] {
        let mut scene = looking([0.0, 0.0, 0.0], [0.0, 0.0, -1.0]);
        let (fov, aperture, focus) = (1e-4, 0.5, 2.0);
        scene.camera.projection = Projection::ThinLens { fov, aperture, focus };
        scene.ambient = white(1.0);
        let glow = Material { diffuse: 0.0, ..Material::matte(white(1.0)) };
        let glow = scene.material(glow).unwrap();
        // At twice the distance in focus the disc of confusion is as large as the lens.
        let (min, max) = (v::<f64>(0.5 * offset, -9.0, -4.1), v::<f64>(9.0, 9.0, -4.0));
        scene.leaf(Form::Box { min, max }, &Affine::identity(), glow).unwrap();
        let h: f64 = 0.5 * offset / 0.25;
        let share = (libm::acos(h) - h * libm::sqrt(1.0 - h * h)) / core::f64::consts::PI;
        let found = mean(&scene).r;
        assert!((found - share).abs() <= 0.012, "{found} for {share} at {offset}");
    }
}

/// Half of a square light is hidden by the edge of a wall: the shadow has the width that geometry gives.
#[test]
fn shadows_of_a_rectangle_have_their_penumbra() {
    for p in [-1.5, -0.9, -0.5, 0.0, 0.3, 0.8, 1.5] {
        let mut scene = looking([p, 0.5, 2.0], [p, 0.0, 0.0]);
        let floor = scene.material(Material::matte(white(1.0))).unwrap();
        let here = Affine::identity();
        let ground = Form::Plane { normal: v::<f64>(0.0, 1.0, 0.0), offset: 0.0 };
        scene.leaf(ground, &here, floor).unwrap();
        let (min, max) = (v::<f64>(-40.0, 2.0, -40.0), v::<f64>(0.0, 2.1, 40.0));
        scene.leaf(Form::Box { min, max }, &here, floor).unwrap();
        let edges = [v::<f64>(2.0, 0.0, 0.0), v::<f64>(0.0, 0.0, 2.0)];
        let emitter = Emitter::Rectangle { center: v::<f64>(0.0, 4.2, 0.0), edges };
        let (color, attenuation) = (white(1.0), Attenuation::NONE);
        scene.light(Light::Area { emitter, color, attenuation }).unwrap();
        // What each point of a fine grid on the light gives where the wall does not hide it: the ray
        // passes its lower and its upper edge.
        let side = 200;
        let mut sum = 0.0;
        for i in 0..side * side {
            let cell = |i: i32| (f64::from(i) + 0.5) / f64::from(side) * 2.0 - 1.0;
            let (x, z) = (cell(i % side), cell(i / side));
            let at = |height: f64| p + (x - p) * height / 4.2;
            if at(2.0) > 0.0 && at(2.1) > 0.0 {
                sum += 0.7 * 4.2 / libm::sqrt((x - p) * (x - p) + 4.2 * 4.2 + z * z);
            }
        }
        let (expected, found) = (sum / f64::from(side * side), mean(&scene).g);
        assert!((found - expected).abs() <= 0.006, "{found} for {expected} at {p}");
    }
}

/// Discs and balls of the same radius look the same to what they face, and a small ball is a point.
#[test]
fn shadows_of_discs_and_balls_are_those_of_their_outline() {
    let lit = |light: Light<f64>| {
        let mut scene = looking([0.2, 0.5, 2.0], [0.2, 0.0, 0.0]);
        let floor = scene.material(Material::matte(white(1.0))).unwrap();
        let here = Affine::identity();
        let ground = Form::Plane { normal: v::<f64>(0.0, 1.0, 0.0), offset: 0.0 };
        scene.leaf(ground, &here, floor).unwrap();
        let (min, max) = (v::<f64>(-40.0, 2.0, -40.0), v::<f64>(0.0, 2.1, 40.0));
        scene.leaf(Form::Box { min, max }, &here, floor).unwrap();
        scene.light(light).unwrap();
        mean(&scene).g
    };
    let (color, attenuation) = (white(1.0), Attenuation::NONE);
    let center = v::<f64>(0.2, 4.0, 0.0);
    let area = |emitter| lit(Light::Area { emitter, color, attenuation });
    let disc = area(Emitter::Disc { center, normal: v::<f64>(0.0, -1.0, 0.0), radius: 1.0 });
    let ball = area(Emitter::Sphere { center, radius: 1.0 });
    assert!((disc - ball).abs() <= 0.004, "{disc} and {ball}");
    // The edge is seen at −0.2 on the light: a little more than half of it shines.
    assert!((0.6..0.63).contains(&(disc / 0.7)), "{disc}");
    let point = lit(Light::Point { at: center, color, attenuation });
    let small = area(Emitter::Sphere { center, radius: 1e-6 });
    assert!((point - small).abs() <= 1e-6 && point > 0.69, "{point} and {small}");
}

/// A rough mirror gathers light from a disc around the mirrored direction.
#[test]
fn rough_mirrors_blur_what_they_show() {
    for (roughness, offset) in [(0.0, 0.1), (0.25, 0.0), (0.25, 0.1), (0.5, -0.2)] {
        let mut scene = looking([0.0, 0.0, 2.0], [0.0, 0.0, 0.0]);
        let (diffuse, ambient, reflect) = (0.0, 0.0, 1.0);
        let black = Material { diffuse, ambient, ..Material::matte(white(1.0)) };
        let mirror = scene.material(Material { reflect, roughness, ..black }).unwrap();
        let glow = scene.material(Material { ambient: 1.0, ..black }).unwrap();
        scene.ambient = white(1.0);
        let here = Affine::identity();
        let wall = Form::Plane { normal: v::<f64>(0.0, 0.0, 1.0), offset: 0.0 };
        scene.leaf(wall, &here, mirror).unwrap();
        let (min, max) = (v::<f64>(4.0 * offset, -40.0, 4.0), v::<f64>(40.0, 40.0, 5.0));
        scene.leaf(Form::Box { min, max }, &here, glow).unwrap();
        let expected = if roughness == 0.0 {
            f64::from(offset < 0.0)
        } else {
            let h: f64 = offset / roughness;
            (libm::acos(h) - h * libm::sqrt(1.0 - h * h)) / core::f64::consts::PI
        };
        let found = mean(&scene).b;
        assert!((found - expected).abs() <= 0.012, "{found} for {expected}: {roughness} {offset}");
    }
}

/// At a grazing angle no mirrored ray of a rough surface goes into it, so none is lost.
#[test]
fn rough_mirrors_keep_their_light_at_grazing_angles() {
    let mut scene = looking([0.0, 0.02, 2.0], [0.0, 0.0, 0.0]);
    let (diffuse, ambient, reflect, roughness) = (0.0, 0.0, 1.0, 0.6);
    let black = Material { diffuse, ambient, ..Material::matte(white(1.0)) };
    let mirror = scene.material(Material { reflect, roughness, ..black }).unwrap();
    let ground = Form::Plane { normal: v::<f64>(0.0, 1.0, 0.0), offset: 0.0 };
    scene.leaf(ground, &Affine::identity(), mirror).unwrap();
    scene.background = Background::Constant(white(0.5));
    let found = mean(&scene);
    assert!((found.r - 0.5).abs() <= 1e-12, "{found:?}");
}

/// Half of a pixel covered at any angle gives half the light: no spread and no filter has a bias.
#[test]
fn the_mean_of_many_pixels_is_that_of_the_picture() {
    let mut scene = Builder::<f64>::new();
    scene.camera.eye = v::<f64>(0.0, 0.0, 5.0);
    scene.camera.look_at = v::<f64>(0.0, 0.0, 0.0);
    scene.camera.projection = Projection::Orthographic { height: 2.0 };
    scene.ambient = white(1.0);
    let glow = Material { diffuse: 0.0, ..Material::matte(white(1.0)) };
    let glow = scene.material(glow).unwrap();
    let center = v::<f64>(0.0, 0.0, 0.0);
    scene.leaf(Form::Sphere { center, radius: 0.75 }, &Affine::identity(), glow).unwrap();
    let scene = scene.scene().unwrap();
    let area = core::f64::consts::PI * 0.75 * 0.75 / 4.0;
    for spread in Spread::ALL {
        for filter in [PixelFilter::Box, PixelFilter::Tent] {
            for samples in [2, 5, 16] {
                let sampler = Sampler { spread, filter, samples, seed: 1 };
                let picture = Picture::<f64>::new(&scene, 48, 48, Depth::fixed(0)).unwrap();
                let picture = picture.sampled(sampler).unwrap();
                let mean = picture.map(|pixel| pixel.color.r).sum::<f64>() / (48.0 * 48.0);
                assert!((mean - area).abs() <= 0.003, "{sampler:?}: {mean} for {area}");
            }
        }
    }
}

/// The budget of bounded error holds for each sample, and a pixel's certificate is the mean.
#[test]
fn certificates_hold_for_the_mean_of_samples() {
    let builder = studio::<f64>(true);
    let scene = builder.scene().unwrap();
    let with = |error_max: f64| -> Vec<Pixel<f64>> {
        let depth = Depth { error_max, ..Depth::fixed(6) };
        let picture = Picture::<f64>::new(&scene, SIZE[0], SIZE[1], depth).unwrap();
        picture.sampled(Sampler::new(9)).unwrap().collect()
    };
    let mut spent = 0.0;
    for (cut, whole) in with(0.1).iter().zip(with(0.0)) {
        for (a, b) in cut.color.to_array().into_iter().zip(whole.color.to_array()) {
            assert!((a - b).abs() <= cut.spent + 1e-12);
        }
        assert!(cut.spent <= 0.1 + 1e-12 && whole.spent == 0.0);
        spent = Number::max(spent, cut.spent);
    }
    assert!(spent > 0.0, "something is cut");
}

#[test]
fn illegal_samples_lenses_lights_and_mirrors_are_refused() {
    let builder = studio::<f32>(false);
    let scene = builder.scene().unwrap();
    for samples in [0, 257, u16::MAX] {
        let refused = plain(&scene).sampled(Sampler::new(samples)).err();
        let allowed = "between 1 and 256";
        let at = Item::Sampling;
        assert_eq!(refused, Some(SceneError::OutOfRange { at, field: "samples", allowed }));
    }
    let field = |change: &dyn Fn(&mut Builder<f32>) -> Result<(), SceneError>| {
        let mut builder = studio::<f32>(false);
        match change(&mut builder).and_then(|()| builder.scene().map(|_| ())).unwrap_err() {
            SceneError::NotFinite { field, .. }
            | SceneError::NotPositive { field, .. }
            | SceneError::TooLarge { field, .. }
            | SceneError::OutOfRange { field, .. }
            | SceneError::Empty { field, .. } => field,
            other => panic!("{other}"),
        }
    };
    for (aperture, focus, expected) in [
        (f32::NAN, 1.0, "aperture"),
        (0.0, 1.0, "aperture"),
        (0.1, f32::INFINITY, "focus"),
        (0.1, -1.0, "focus"),
        (0.1, 1e30, "focus"),
    ] {
        let found = field(&|builder| {
            let fov = 40.0;
            builder.camera.projection = Projection::ThinLens { fov, aperture, focus };
            Ok(())
        });
        assert_eq!(found, expected);
    }
    for roughness in [f32::NAN, -0.1, 1.1] {
        let rough = Material { roughness, ..Material::PLAIN };
        assert_eq!(field(&|builder| builder.material(rough).map(|_| ())), "roughness");
    }
    let (center, far) = (v::<f32>(0.0, 4.0, 0.0), v::<f32>(0.0, 1e30, 0.0));
    let [x, long] = [v::<f32>(1.0, 0.0, 0.0), v::<f32>(2.0, 0.0, 0.0)];
    let up = v::<f32>(0.0, 1.0, 0.0);
    for (emitter, expected) in [
        (Emitter::Rectangle { center, edges: [x, long] }, "edges"),
        (Emitter::Rectangle { center, edges: [x, up * 0.0] }, "edges"),
        (Emitter::Rectangle { center: far, edges: [x, up] }, "center"),
        (Emitter::Disc { center, normal: long, radius: 1.0 }, "normal"),
        (Emitter::Disc { center, normal: up, radius: 0.0 }, "radius"),
        (Emitter::Sphere { center, radius: f32::NAN }, "radius"),
        (Emitter::Sphere { center, radius: 1e30 }, "radius"),
        (Emitter::Sphere { center: far, radius: 1.0 }, "center"),
    ] {
        let (color, attenuation) = (white(1.0), Attenuation::NONE);
        let light = Light::Area { emitter, color, attenuation };
        assert_eq!(field(&|builder| builder.light(light).map(|_| ())), expected);
    }
}

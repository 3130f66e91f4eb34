//! Depth control: what each rule cuts, what a cut may cost, and that a picture can be paused.

#![allow(clippy::unwrap_used, reason = "a test may fail loudly")]

use nostray::*;

type Picture<'a, S, T = ()> = Render<'a, S, 17, 64, T>;

fn v<S: Scalar>(x: f64, y: f64, z: f64) -> S::Vec3 {
    S::Vec3::from_array([x, y, z].map(S::from_f64))
}

/// Mirrors that face each other, glass before them, and a mirror on the ground.
fn hall<S: Scalar>() -> SceneBuilder<S> {
    let f = S::from_f64;
    let mut scene = SceneBuilder::new();
    scene.camera.eye = v::<S>(0.5, 1.5, 5.0);
    scene.camera.look_at = v::<S>(0.0, 0.8, 0.0);
    scene.background = Background::Constant(Rgb::new(f(0.3), f(0.5), f(0.8)));
    scene.ambient = Rgb::new(f(0.2), f(0.2), f(0.2));
    let dull = Material::matte(Rgb::new(f(0.8), f(0.3), f(0.2)));
    let mirror = Material { reflect: f(0.7), diffuse: f(0.2), specular: f(0.5), ..dull };
    let glass = Material {
        transmit: f(0.8),
        reflect: f(0.1),
        diffuse: f(0.05),
        ior: f(1.5),
        fresnel: Fresnel::Exact,
        absorb: Rgb::new(f(0.3), f(0.1), f(0.05)),
        ..dull
    };
    let [mirror, glass] = [mirror, glass].map(|material| scene.material(material).unwrap());
    let here = Affine::identity();
    let ground = Form::Plane { normal: v::<S>(0.0, 1.0, 0.0), offset: S::ZERO };
    scene.leaf(ground, &here, mirror).unwrap();
    for z in [-3.0, 7.0] {
        let (min, max) = (v::<S>(-4.0, 0.0, z), v::<S>(4.0, 4.0, z + 0.5));
        scene.leaf(Form::Box { min, max }, &here, mirror).unwrap();
    }
    for (x, radius) in [(-1.2, 0.8), (0.9, 0.6)] {
        let center = v::<S>(x, radius, 0.0);
        scene.leaf(Form::Sphere { center, radius: f(radius) }, &here, glass).unwrap();
    }
    scene.open(Operator::Difference).unwrap();
    let (min, max) = (v::<S>(-0.5, 1.2, -1.0), v::<S>(0.5, 2.0, -0.2));
    scene.leaf(Form::Box { min, max }, &here, glass).unwrap();
    let center = v::<S>(0.0, 1.6, -0.6);
    scene.leaf(Form::Sphere { center, radius: f(0.45) }, &here, glass).unwrap();
    scene.close(glass).unwrap();
    let attenuation = Attenuation::NONE;
    let (at, color) = (v::<S>(3.0, 3.5, 3.0), Rgb::new(f(0.9), f(0.9), f(0.9)));
    scene.light(Light::Point { at, color, attenuation }).unwrap();
    scene
}

fn pixels<S: Scalar>(scene: &Scene<'_, S>, depth: Depth<S>) -> (Vec<Pixel<S>>, Stats) {
    let mut render: Picture<'_, S, Stats> =
        Picture::with_tally(scene, 40, 30, depth, Stats::default()).unwrap();
    let pixels = render.by_ref().collect();
    (pixels, *render.tally())
}

fn difference<S: Scalar>(a: Rgb<S>, b: Rgb<S>) -> f64 {
    let pairs = a.to_array().into_iter().zip(b.to_array());
    pairs.fold(0.0, |most, (a, b)| Number::max(most, (a.to_f64() - b.to_f64()).abs()))
}

/// The certificate: no pixel is farther from the uncut one than what was spent, and nothing
/// spends more than it was given.
#[test]
fn bounded_error_keeps_every_pixel_within_its_budget() {
    fn check<S: Scalar>(rounding: f64) {
        let builder = hall::<S>();
        let scene = builder.scene().unwrap();
        let (whole, all) = pixels(&scene, Depth::fixed(12));
        assert!(whole.iter().all(|pixel| pixel.spent == S::ZERO));
        for error in [1.0 / 255.0, 0.02, 0.2, 2.0] {
            let depth = Depth { error_max: S::from_f64(error), ..Depth::fixed(12) };
            let (cut, stats) = pixels(&scene, depth);
            assert!(stats.of(Event::BudgetCut) > 0, "{error} cuts nothing");
            let rays = |s: &Stats| s.of(Event::ReflectedRay) + s.of(Event::RefractedRay);
            assert!(rays(&stats) < rays(&all));
            for (cut, whole) in cut.iter().zip(&whole) {
                let (off, spent) = (difference(cut.color, whole.color), cut.spent.to_f64());
                assert!(off <= spent + rounding, "{off} at ({}, {}), spent {spent}", cut.x, cut.y);
                assert!(spent <= error * (1.0 + 1e-6), "{spent} of {error}");
            }
        }
    }
    check::<f32>(1e-5);
    check::<f64>(1e-13);
}

/// Dynamic control cuts what its rule names, and tells what that may cost.
#[test]
fn least_weight_cuts_and_tells_the_cost() {
    let builder = hall::<f64>();
    let scene = builder.scene().unwrap();
    let (whole, _) = pixels(&scene, Depth::fixed(12));
    let (cut, stats) = pixels(&scene, Depth { weight_min: 0.05, ..Depth::fixed(12) });
    assert!(stats.of(Event::WeightCut) > 100);
    assert_eq!(stats.of(Event::BudgetCut), 0);
    for (cut, whole) in cut.iter().zip(&whole) {
        assert!(difference(cut.color, whole.color) <= cut.spent + 1e-13);
    }
    let (same, stats) = pixels(&scene, Depth { weight_min: 1e-12, ..Depth::fixed(12) });
    assert_eq!(stats.of(Event::WeightCut), 0);
    assert_eq!(same, whole);
}

#[test]
fn greatest_depth_counts_mirrors_and_refractions() {
    let builder = hall::<f32>();
    let scene = builder.scene().unwrap();
    let (_, stats) = pixels(&scene, Depth::fixed(0));
    assert_eq!(stats.of(Event::ReflectedRay) + stats.of(Event::RefractedRay), 0);
    assert!(stats.of(Event::DepthCut) > 0);
    let mut rays = 0;
    for depth_max in [1, 2, 4, 8] {
        let (_, stats) = pixels(&scene, Depth::fixed(depth_max));
        let now = stats.of(Event::ReflectedRay) + stats.of(Event::RefractedRay);
        assert!(now > rays, "depth {depth_max} adds no ray");
        rays = now;
    }
}

/// The bits of everything that a picture gives.
fn bits<S: Scalar>(pixels: impl Iterator<Item = Pixel<S>>) -> Vec<u8> {
    let mut bits = Vec::new();
    for Pixel { x, y, color, spent } in pixels {
        bits.extend([x, y].iter().flat_map(|n| n.to_le_bytes()));
        for number in color.to_array().into_iter().chain([spent]) {
            bits.extend_from_slice(number.to_le_bytes().as_ref());
        }
    }
    bits
}

/// A picture that is stored after any number of steps, and taken up again by the copy, is the same.
#[test]
fn paused_pictures_go_on_with_the_same_bits() {
    let builder = hall::<f32>();
    let scene = builder.scene().unwrap();
    let depth = Depth { error_max: 0.01, ..Depth::fixed(9) };
    let mut whole: Picture<'_, f32> = Picture::new(&scene, 24, 18, depth).unwrap();
    let expected = bits(whole.by_ref());
    assert_eq!(whole.step(), Step::Done, "a finished picture stays finished");
    let mut paused: Picture<'_, f32> = Picture::new(&scene, 24, 18, depth).unwrap();
    let (mut found, mut steps) = (Vec::new(), 0_u32);
    loop {
        // A copy goes on in place of the original after 1, 2, 3, … steps.
        if steps.is_multiple_of(7) {
            paused = paused.clone();
        }
        steps += 1;
        match paused.step() {
            Step::Traced => {}
            Step::Pixel(pixel) => found.push(pixel),
            Step::Done => break,
        }
        if steps == 1000 {
            let rest = bits(found.iter().copied().chain(paused.clone()));
            assert!(rest == expected, "the copy after {steps} steps differs");
        }
    }
    assert!(steps > 2000, "the picture should take many steps, not {steps}");
    assert!(bits(found.into_iter()) == expected);
}

#[test]
fn rows_by_themselves_are_those_of_the_whole() {
    let builder = hall::<f64>();
    let scene = builder.scene().unwrap();
    let whole = || Picture::<f64>::new(&scene, 20, 15, Depth::fixed(6)).unwrap();
    let expected = bits(whole());
    for cuts in [vec![0, 15], vec![0, 1, 15], vec![0, 7, 8, 14, 15], (0..=15).collect()] {
        let mut found = Vec::new();
        for pair in cuts.windows(2) {
            if let &[from, to] = pair {
                let part = whole().only_rows(from..to);
                assert_eq!(
                    part.size_hint(),
                    (20 * (to - from) as usize, Some(20 * (to - from) as usize))
                );
                found.extend(bits(part));
            }
        }
        assert!(found == expected, "{cuts:?}");
    }
    assert_eq!(whole().only_rows(15..99).next(), None);
}

#[test]
fn what_does_not_fit_is_refused_before_the_first_ray() {
    let builder = hall::<f32>();
    let scene = builder.scene().unwrap();
    let refused = Render::<f32, 9, 64>::new(&scene, 4, 4, Depth::fixed(9)).err();
    assert_eq!(refused, Some(SceneError::StackTooSmall { depth_max: 9, limit: 9 }));
    assert!(Render::<f32, 10, 64>::new(&scene, 4, 4, Depth::fixed(9)).is_ok());
    let needed = scene.limits().boundaries;
    let refused = Render::<f32, 9, 3>::new(&scene, 4, 4, Depth::fixed(8)).err();
    assert!(
        matches!(refused, Some(SceneError::SpanOverflow { needed: n, limit: 3, .. }) if n == needed)
    );
    for (width, height) in [(0, 4), (4, 0), ((1 << 24) + 1, 4)] {
        let refused = Render::<f32>::new(&scene, width, height, Depth::fixed(4)).err();
        assert_eq!(refused, Some(SceneError::PictureSize { width, height }));
    }
    for (weight_min, error_max, field) in
        [(f32::NAN, 0.0, "weight_min"), (0.0, f32::INFINITY, "error_max"), (0.0, -1.0, "error_max")]
    {
        let depth = Depth { weight_min, error_max, ..Depth::fixed(4) };
        let refused = Render::<f32>::new(&scene, 4, 4, depth).err();
        let names = |error| match error {
            SceneError::NotFinite { at: Item::Depth, field }
            | SceneError::OutOfRange { at: Item::Depth, field, .. } => Some(field),
            _ => None,
        };
        assert_eq!(refused.and_then(names), Some(field));
    }
}

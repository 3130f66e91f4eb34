//! Each pattern, mapping and image format in a picture of its own: on a floor, on a ball and through a block.

use nostray::{
    Affine, Axis, Blend, Channel, Filter, Fixed, Form, Format, Image, Mapping, Material, Octaves,
    Paint, Parameter, Pattern, Ramp, Rgb, Scalar, SceneBuilder, SceneError, Space, Stop, Texture,
    Transfer, Wrap,
};

use super::{rgb, shoot, sun, tenths};

/// Room for the solids that show a pattern, and for the patterns that it is made of.
type Builder<S> = SceneBuilder<S, Fixed<4, 8, 4, 8, 0, 12>>;

const SIZE: [u32; 2] = [12, 9];

pub(super) fn trace<S: Scalar>(
    shrink: u32,
    sink: &mut impl FnMut(Rgb<S>),
) -> Result<(), SceneError> {
    patterns(shrink, sink)?;
    mappings(shrink, sink)?;
    images(shrink, sink)?;
    picture(shrink, sink, nested)?;
    driven(shrink, sink)
}

/// One picture. A pattern has features of about half a unit; it gives the index of its texture.
#[inline(never)]
fn picture<S: Scalar>(
    shrink: u32,
    sink: &mut impl FnMut(Rgb<S>),
    pattern: impl FnOnce(&mut Builder<S>) -> Result<u16, SceneError>,
) -> Result<(), SceneError> {
    let mut builder = Builder::new();
    let texture = pattern(&mut builder)?;
    let color = Paint::Texture(texture);
    let shown = Material { color, specular: S::HALF, ..Material::matte(rgb(1, 1, 1)) };
    stage(&mut builder, shown)?;
    shoot(&builder.scene()?, SIZE, shrink, sink)
}

/// Light, a floor, a ball and a block.
#[inline(never)]
fn stage<S: Scalar>(scene: &mut Builder<S>, shown: Material<S>) -> Result<(), SceneError> {
    scene.ambient = rgb(2, 2, 2);
    scene.camera.eye = tenths::<S>(3, 14, 46);
    scene.light(sun())?;
    let shown = scene.material(shown)?;
    let here = Affine::identity();
    let normal = tenths::<S>(0, 10, 0);
    scene.leaf(Form::Plane { normal, offset: -S::ONE }, &here, shown)?;
    let ball = Form::Sphere { center: tenths::<S>(-10, 0, 0), radius: S::ONE };
    scene.leaf(ball, &here, shown)?;
    let block = Form::Box { min: tenths::<S>(-7, -10, -7), max: tenths::<S>(7, 6, 7) };
    let turned = Affine::rotate(Axis::Y, S::from_i32(35));
    scene.leaf(block, &turned.then(&Affine::translate(tenths::<S>(12, 0, 0))), shown)
}

/// Three colours, of which some patterns take two.
fn ramp<S: Scalar>(scene: &mut Builder<S>, count: usize, blend: Blend) -> Result<Ramp, SceneError> {
    let stops = [
        Stop::color(S::ZERO, rgb(9, 8, 6)),
        Stop::color(S::HALF, rgb(1, 3, 5)),
        Stop::color(S::ONE, rgb(8, 2, 1)),
    ];
    scene.ramp(stops.get(..count).unwrap_or(&stops), blend)
}

/// A pattern through space, aslant, with features of half a unit.
#[inline(never)]
fn solid<S: Scalar>(scene: &mut Builder<S>, pattern: Pattern<S>) -> Result<u16, SceneError> {
    let aslant = Affine::rotate(Axis::Z, S::from_i32(30));
    let placement = Some(scene.placement(&aslant)?);
    let ramp = ramp(scene, 3, Blend::Linear)?;
    let octaves = Octaves { count: 3, gain: S::from_ratio(6, 10) };
    let size = [S::HALF; 3];
    scene.texture(Texture { placement, octaves, size, seed: 5, ..Texture::new(pattern, ramp) })
}

/// All patterns but images, each on all three solids.
#[inline(never)]
fn patterns<S: Scalar>(shrink: u32, sink: &mut impl FnMut(Rgb<S>)) -> Result<(), SceneError> {
    let (tenth, three) = (S::from_ratio(1, 10), S::from_i32(3));
    let all = [
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
    for pattern in all {
        picture(shrink, sink, |scene| solid(scene, pattern))?;
    }
    Ok(())
}

/// Every way from a point to two coordinates, with bricks in them, turned and bent.
#[inline(never)]
fn mappings<S: Scalar>(shrink: u32, sink: &mut impl FnMut(Rgb<S>)) -> Result<(), SceneError> {
    for (mapping, wrap) in [
        (Mapping::Uv, Wrap::Endless),
        (Mapping::Planar, Wrap::Mirror),
        (Mapping::Spherical, Wrap::Repeat),
        (Mapping::Cylindrical, Wrap::Endless),
        (Mapping::Cubic, Wrap::Clamp),
        (Mapping::Toroidal { major: S::HALF }, Wrap::Endless),
    ] {
        picture(shrink, sink, |scene| {
            let turned = Affine::rotate(Axis::Z, S::from_i32(20));
            let frame = Some(scene.placement(&turned)?);
            let ramp = ramp(scene, 3, Blend::Step)?;
            let mortar = S::from_ratio(1, 5);
            let space = if mapping == Mapping::Uv { Space::Scene } else { Space::Shape };
            let size = [S::from_ratio(1, 4), S::from_ratio(1, 8), S::ONE];
            let warp = S::from_ratio(1, 4);
            let texture = Texture::new(Pattern::Brick { mortar }, ramp);
            let wrap = [wrap, Wrap::Endless];
            scene.texture(Texture { mapping, frame, space, size, warp, wrap, ..texture })
        })?;
    }
    Ok(())
}

/// The formats of images, each with a filter.
#[inline(never)]
fn images<S: Scalar>(shrink: u32, sink: &mut impl FnMut(Rgb<S>)) -> Result<(), SceneError> {
    const BYTES: [u8; 12] = [250, 30, 0, 20, 240, 60, 0, 80, 255, 200, 190, 180];
    let (srgb, linear) = (Transfer::Srgb, Transfer::Linear);
    for (format, width, height, transfer, filter) in [
        (Format::Rgb8, 2, 2, srgb, Filter::Bilinear),
        (Format::Grey8, 3, 4, linear, Filter::Bilinear),
        (Format::Rgb565, 3, 2, srgb, Filter::Nearest),
        (Format::Mono1, 12, 6, srgb, Filter::Nearest),
    ] {
        picture(shrink, sink, |scene| {
            let image = Image { first: 0, width, height, format, transfer };
            let image = scene.image(image, &BYTES)?;
            let texture = Texture::new(Pattern::Image { image, filter }, Ramp::GREY);
            let size = [S::HALF, S::HALF, S::ONE];
            scene.texture(Texture { mapping: Mapping::Uv, size, ..texture })
        })?;
    }
    Ok(())
}

/// Through space, aslant, with a finer one in its light cells.
fn nested<S: Scalar>(scene: &mut Builder<S>) -> Result<u16, SceneError> {
    let two = ramp(scene, 2, Blend::Linear)?;
    let fine = Texture { size: [S::from_ratio(1, 5); 3], ..Texture::new(Pattern::Checker, two) };
    let fine = Paint::Texture(scene.texture(fine)?);
    let stops = [Stop { at: S::ZERO, paint: fine }, Stop::color(S::ONE, rgb(1, 2, 3))];
    let ramp = scene.ramp(&stops, Blend::Smooth)?;
    scene.texture(Texture { size: [S::HALF; 3], ..Texture::new(Pattern::Noise, ramp) })
}

/// Numbers of the material and normals that textures drive.
#[inline(never)]
fn driven<S: Scalar>(shrink: u32, sink: &mut impl FnMut(Rgb<S>)) -> Result<(), SceneError> {
    let mut builder = Builder::new();
    let noise = Texture::new(Pattern::Noise, Ramp::GREY);
    let bumps = builder.texture(Texture { size: [S::from_ratio(1, 4); 3], ..noise })?;
    let spots = builder.texture(Texture::new(Pattern::Leopard, Ramp::GREY))?;
    let share = |of, texture| Channel::Share { of, texture, low: S::ZERO, high: S::ONE };
    let step = S::from_ratio(1, 50);
    let relief = |texture| Channel::Relief { texture, depth: S::from_ratio(1, 20), step };
    let channels = builder.channels(&[
        share(Parameter::Reflect, spots),
        share(Parameter::Specular, bumps),
        relief(bumps),
        relief(spots),
    ])?;
    let (reflect, specular) = (S::HALF, S::ONE);
    let shown = Material { reflect, specular, channels, ..Material::matte(rgb(4, 5, 7)) };
    stage(&mut builder, shown)?;
    shoot(&builder.scene()?, SIZE, shrink, sink)
}

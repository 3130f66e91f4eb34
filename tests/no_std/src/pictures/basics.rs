//! Every kind of light, surface and operator in one picture.

use nostray::{
    Affine, Attenuation, Axis, Blend, Fixed, Form, Fresnel, Light, Material, Operator, Paint,
    Pattern, Rgb, Scalar, SceneBuilder, SceneError, Spotlight, Stop, Texture,
};

use super::{rgb, shoot, tenths};

/// Room for these five objects and no more: this picture is for the smallest boards, too.
type Builder<S> = SceneBuilder<S, Fixed<5, 8, 3, 3>>;

const SIZE: [u32; 2] = [24, 18];

/// Traces the picture and hands over the light of each pixel, row by row.
#[inline(never)]
pub(crate) fn trace<S: Scalar>(
    shrink: u32,
    sink: &mut impl FnMut(Rgb<S>),
) -> Result<(), SceneError> {
    let mut builder = Builder::new();
    build::<S>(&mut builder)?;
    shoot(&builder.scene()?, SIZE, shrink, sink)
}

#[inline(never)]
fn build<S: Scalar>(scene: &mut Builder<S>) -> Result<(), SceneError> {
    scene.ambient = rgb(1, 1, 1);
    scene.camera.eye = tenths::<S>(0, 30, 70);
    let paints = [Stop::color(S::ZERO, rgb(9, 9, 8)), Stop::color(S::ONE, rgb(1, 2, 2))];
    let ramp = scene.ramp(&paints, Blend::Linear)?;
    let checker = scene.texture(Texture::new(Pattern::Checker, ramp))?;
    let floor = scene.material(Material {
        color: Paint::Texture(checker),
        reflect: S::from_ratio(1, 5),
        ..Material::matte(Rgb::WHITE)
    })?;
    let red = scene.material(Material { specular: S::HALF, ..Material::matte(rgb(9, 2, 1)) })?;
    let glass = scene.material(Material {
        diffuse: S::ZERO,
        transmit: S::ONE,
        ior: S::from_ratio(3, 2),
        fresnel: Fresnel::Exact,
        absorb: rgb(4, 1, 3),
        ..Material::matte(Rgb::WHITE)
    })?;
    light(scene)?;
    let here = Affine::identity();
    let normal = tenths::<S>(0, 10, 0);
    scene.leaf(Form::Plane { normal, offset: S::from_ratio(-11, 10) }, &here, floor)?;
    scene.leaf(Form::Sphere { center: tenths::<S>(14, 0, 8), radius: S::ONE }, &here, glass)?;
    scene.open(Operator::Difference)?;
    let turned = Affine::rotate(Axis::Y, S::from_i32(30));
    let cube = Form::Box { min: tenths::<S>(-10, -10, -10), max: tenths::<S>(10, 10, 10) };
    scene.leaf(cube, &turned.then(&Affine::translate(tenths::<S>(-10, 0, 0))), red)?;
    let (base, top) = (tenths::<S>(-10, -20, 0), tenths::<S>(-10, 20, 0));
    scene.leaf(Form::Cylinder { base, top, radius: S::HALF }, &here, glass)?;
    scene.leaf(Form::Sphere { center: tenths::<S>(-6, 8, 8), radius: S::HALF }, &here, floor)?;
    scene.close(red)?;
    let corners = [tenths::<S>(-30, -10, -20), tenths::<S>(30, -10, -20), tenths::<S>(0, 25, -25)];
    scene.leaf(Form::Triangle { corners, normals: None }, &here, red)?;
    let base_radius = S::from_ratio(6, 10);
    let (base, top) = (tenths::<S>(4, -11, -8), tenths::<S>(6, 9, -8));
    scene.leaf(Form::Cone { base, base_radius, top, top_radius: S::ZERO }, &here, floor)?;
    Ok(())
}

fn light<S: Scalar>(scene: &mut Builder<S>) -> Result<(), SceneError> {
    let attenuation =
        Attenuation { constant: S::ONE, linear: S::ZERO, quadratic: S::from_ratio(1, 50) };
    scene.light(Light::Point { at: tenths::<S>(-30, 50, 40), color: Rgb::WHITE, attenuation })?;
    let at = tenths::<S>(40, 60, 30);
    let cone = Spotlight {
        axis: S::toward(-at).0,
        cos_inner: S::from_ratio(98, 100),
        cos_outer: S::from_ratio(9, 10),
    };
    let attenuation = Attenuation::NONE;
    scene.light(Light::Spot { at, cone, color: rgb(8, 7, 5), attenuation })
}

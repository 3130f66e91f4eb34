//! Each pattern in a picture of its own: on a floor, on a ball and through a block.

use nostray::{
    Affine, Axis, Checker, Fixed, Form, Mapping, Material, Paint, Rgb, Scalar, SceneBuilder,
    SceneError, Texture, Vector,
};

use super::{rgb, shoot, sun, tenths};

/// Room for the solids that show a pattern, and for the patterns that it is made of.
type Builder<S> = SceneBuilder<S, Fixed<4, 8, 4, 4, 32>>;

const SIZE: [u32; 2] = [24, 18];

pub(super) fn trace<S: Scalar>(
    shrink: u32,
    sink: &mut impl FnMut(Rgb<S>),
) -> Result<(), SceneError> {
    picture(shrink, sink, checker)?;
    picture(shrink, sink, nested)
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
    stage(&mut builder, texture)?;
    shoot(&builder.scene()?, SIZE, shrink, sink)
}

/// Light, a floor, a ball and a block.
#[inline(never)]
fn stage<S: Scalar>(scene: &mut Builder<S>, texture: u16) -> Result<(), SceneError> {
    scene.ambient = rgb(2, 2, 2);
    scene.camera.eye = tenths::<S>(3, 14, 46);
    scene.light(sun())?;
    let color = Paint::Texture(texture);
    let shown = Material { color, specular: S::HALF, ..Material::matte(rgb(1, 1, 1)) };
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

/// Over the surface, in a fourteenth of a turn.
fn checker<S: Scalar>(scene: &mut Builder<S>) -> Result<u16, SceneError> {
    let paints = [Paint::Solid(rgb(9, 8, 6)), Paint::Solid(rgb(1, 3, 5))];
    let (size, mapping) = (S::Vec3::splat(S::from_ratio(1, 14)), Mapping::Uv);
    scene.texture(Texture::Checker(Checker { paints, size, mapping, placement: None }))
}

/// Through space, aslant, with a finer one in its light cells.
fn nested<S: Scalar>(scene: &mut Builder<S>) -> Result<u16, SceneError> {
    let aslant = Affine::rotate(Axis::Z, S::from_i32(30));
    let placement = Some(scene.placement(&aslant)?);
    let mapping = Mapping::Solid;
    let paints = [Paint::Solid(rgb(9, 3, 1)), Paint::Solid(rgb(9, 7, 2))];
    let size = tenths::<S>(2, 2, 2);
    let fine = scene.texture(Texture::Checker(Checker { paints, size, mapping, placement }))?;
    let paints = [Paint::Texture(fine), Paint::Solid(rgb(1, 2, 3))];
    let size = tenths::<S>(6, 6, 6);
    scene.texture(Texture::Checker(Checker { paints, size, mapping, placement }))
}

//! Small pictures with everything that can be seen in one; the same files are compiled for the
//! program that is linked into one in C, for the test that compares the two, and for the programs
//! of `tests/targets`.

mod basics;
mod solids;
mod textures;

use nostray::{Depth, Light, Render, Rgb, Scalar, Scene, SceneError, Vector};

#[allow(unused_imports, reason = "the smallest boards have room for no more than this one")]
pub(crate) use basics::trace as trace_basics;

/// Traces all pictures, one after the other, and hands over the light of each pixel, row by row.
/// Width and height are divided by `shrink`.
pub(crate) fn trace<S: Scalar>(
    shrink: u32,
    sink: &mut impl FnMut(Rgb<S>),
) -> Result<(), SceneError> {
    basics::trace(shrink, sink)?;
    solids::trace(shrink, sink)?;
    textures::trace(shrink, sink)
}

/// Traces one picture. The code for it exists once, whatever the scene.
#[inline(never)]
fn shoot<S: Scalar>(
    scene: &Scene<'_, S>,
    [width, height]: [u32; 2],
    shrink: u32,
    sink: &mut impl FnMut(Rgb<S>),
) -> Result<(), SceneError> {
    let (width, height) = (width / shrink.max(1), height / shrink.max(1));
    let render: Render<S, 7, 36> = Render::new(scene, width, height, Depth::fixed(6))?;
    for pixel in render {
        sink(pixel.color);
    }
    Ok(())
}

/// A point, in tenths.
fn tenths<S: Scalar>(x: i32, y: i32, z: i32) -> S::Vec3 {
    S::Vec3::new(S::from_ratio(x, 10), S::from_ratio(y, 10), S::from_ratio(z, 10))
}

/// A colour, in tenths.
fn rgb<S: Scalar>(r: i32, g: i32, b: i32) -> Rgb<S> {
    Rgb::new(S::from_ratio(r, 10), S::from_ratio(g, 10), S::from_ratio(b, 10))
}

/// Light from the left, behind the viewer, which ends at no distance.
fn sun<S: Scalar>() -> Light<S> {
    Light::Directional { toward: S::toward(tenths::<S>(3, -7, -5)).0, color: rgb(9, 9, 8) }
}

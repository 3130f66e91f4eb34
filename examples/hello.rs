//! The smallest complete program: a scene in flash, drawn as letters.

use nostray::glam::Vec3;
use nostray::*;

const RED: Rgb<f32> = Rgb::new(0.9, 0.2, 0.1);

fn main() -> Result<(), SceneError> {
    let mut scene = SceneBuilder::<f32>::new();
    let red = scene.material(Material::matte(RED))?;
    scene.light(Light::Directional { toward: Vec3::new(-0.6, -0.64, -0.48), color: Rgb::WHITE })?;
    scene.leaf(Form::Sphere { center: Vec3::ZERO, radius: 1.5 }, &Affine::identity(), red)?;
    let scene = scene.scene()?;
    let render: Render<f32> = Render::new(&scene, 64, 28, Depth::fixed(4))?;
    for pixel in render {
        let shade = (pixel.color.max_part() * 9.0) as usize;
        print!("{}", char::from(b" .:-=+*#%@"[shade.min(9)]));
        if pixel.x == 63 {
            println!();
        }
    }
    Ok(())
}

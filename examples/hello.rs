//! The smallest complete program: a scene in flash, drawn as letters.

use nostray::glam::Vec3;
use nostray::*;

const BALL: Shape<f32> = Shape::Sphere(Sphere { center: Vec3::ZERO, radius: 1.5 });

static PARTS: Parts<f32> = Parts {
    nodes: &[Node::Leaf(Leaf { shape: BALL, material: 0, placement: None })],
    objects: &[Object::new(0, 1, 0)],
    materials: &[Material { color: Paint::Solid(Rgb::new(0.9, 0.2, 0.1)), ..Material::PLAIN }],
    lights: &[Light::Directional { toward: Vec3::new(-0.6, -0.64, -0.48), color: Rgb::WHITE }],
    ..Parts::seen_by(Camera::pinhole(Vec3::new(0.0, 0.0, 5.0), Vec3::ZERO, Vec3::Y, 40.0))
};

fn main() -> Result<(), SceneError> {
    let scene = Scene::new(PARTS)?;
    let render: Render<f32> = Render::new(&scene, 36, 26, Depth::fixed(4))?;
    for pixel in render {
        // A letter is about twice as high as wide.
        let shade = (pixel.color.max_part() * 11.0) as usize;
        let letter = b" .:-=+*#%@".get(shade).map_or('@', |&letter| char::from(letter));
        print!("{letter}{letter}");
        if pixel.x == 35 {
            println!();
        }
    }
    Ok(())
}

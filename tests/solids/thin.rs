//! Solids at the edge of what a number format can tell apart.

#![allow(clippy::unwrap_used, reason = "a test may fail loudly")]

use nostray::glam::Vec3;
use nostray::*;

/// A solid so thin for its distance that both ends round to one t is the same alone and under
/// any operator; once it vanished in lists, but not where it stood alone.
#[test]
fn thin_solids_far_away_are_the_same_alone_and_combined() {
    let picture = |around: Option<Operator>, form: Form<'_, f32>| {
        let mut builder = SceneBuilder::<f32>::new();
        builder.camera.eye = Vec3::new(0.0, 0.0, -1000.0);
        builder.camera.projection = Projection::Pinhole { fov: 10.0 };
        builder.ambient = Rgb::WHITE;
        let red = builder.material(Material::matte(Rgb::new(1.0, 0.0, 0.0))).unwrap();
        let here = Affine::identity();
        let second = match around {
            Some(Operator::Intersection) => {
                Some(Form::Box { min: Vec3::splat(-900.0), max: Vec3::splat(900.0) })
            }
            Some(Operator::Union | Operator::Difference | Operator::Xor) => {
                Some(Form::Sphere { center: Vec3::new(300.0, 0.0, 0.0), radius: 1.0 })
            }
            _ => None,
        };
        if let Some(operator) = around {
            builder.open(operator).unwrap();
        }
        builder.leaf(form, &here, red).unwrap();
        if let Some(second) = second {
            builder.leaf(second, &here, red).unwrap();
        }
        if around.is_some() {
            builder.close(red).unwrap();
        }
        let scene = builder.scene().unwrap();
        let render: Render<f32> = Render::new(&scene, 64, 48, Depth::fixed(2)).unwrap();
        render.map(|pixel| pixel.color).collect::<Vec<_>>()
    };
    let (base, top) = (Vec3::new(-9.0, -40.0, 0.0), Vec3::new(9.0, 40.0, 0.0));
    for form in [
        Form::Box { min: Vec3::new(-50.0, -50.0, 0.0), max: Vec3::new(50.0, 50.0, 1e-5) },
        Form::Cylinder { base: Vec3::ZERO, top: Vec3::Z * 1e-5, radius: 50.0 },
        Form::Cone { base, base_radius: 30.0, top, top_radius: 1e-5 },
    ] {
        let alone = picture(None, form);
        let lit = alone.iter().filter(|color| color.r > 0.0).count();
        assert!(lit > 150, "{form:?}: {lit} pixels");
        for operator in
            [Operator::Union, Operator::Intersection, Operator::Difference, Operator::Xor]
        {
            assert_eq!(picture(Some(operator), form), alone, "{form:?} in {operator:?}");
        }
    }
}

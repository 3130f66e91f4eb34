//! A scene that is made for certain needs has the bits of one that is made for all, and asks for nothing else.
#![allow(clippy::expect_used, clippy::panic, reason = "that is how a test fails")]

use nostray::glam::DVec3;
use nostray::shape::program::{ADD, NUMBER, SQUARE, SUB, X, Y, Z};
use nostray::*;

type Builder = SceneBuilder<f64, Fixed<16, 8, 2, 32, 64, 0, 16>>;

/// What each of these scenes has beside its solid.
const STAGE: u64 = needs::PLANE | needs::TEXTURES | needs::MIRRORS | needs::GLASS;

const CORNERS: [DVec3; 4] = [
    DVec3::new(1.0, -1.0, 1.0),
    DVec3::new(-1.0, -1.0, 0.9),
    DVec3::new(0.0, -1.0, -1.1),
    DVec3::Y,
];
const TETRAHEDRON: Corners<'static, DVec3> =
    Corners { values: &CORNERS, triangles: &[[0, 3, 1], [1, 3, 2], [2, 3, 0], [0, 1, 2]] };

const ROWS: [u32; 16] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];

/// The control points of a patch over a square.
fn hill() -> [DVec3; 16] {
    ROWS.map(|index| {
        let (x, z) = (f64::from(index % 4) - 1.5, f64::from(index / 4) - 1.5);
        DVec3::new(x, 1.0 - 0.4 * (x * x + z * z), z) * 0.7
    })
}

/// A glassy and mirroring solid on a checkered floor.
fn stage(form: Form<'_, f64>, place: &Affine<f64>) -> Builder {
    let mut scene = Builder::new();
    scene.ambient = Rgb::new(0.2, 0.2, 0.3);
    scene.camera.eye = DVec3::new(1.2, 1.6, 4.2);
    let toward = DVec3::new(0.6, 0.64, 0.48);
    scene.light(Light::Directional { toward, color: Rgb::WHITE }).expect("a light");
    let stops = [Stop::color(0.0, Rgb::WHITE), Stop::color(1.0, Rgb::BLACK)];
    let ramp = scene.ramp(&stops, Blend::Linear).expect("a ramp");
    let checker = scene.texture(Texture::new(Pattern::Checker, ramp)).expect("a texture");
    let floor = Material { color: Paint::Texture(checker), ..Material::matte(Rgb::WHITE) };
    let floor = scene.material(floor).expect("a material");
    let glass = Material { reflect: 0.3, transmit: 0.5, ior: 1.3, ..Material::PLAIN };
    let glass = scene.material(Material { fresnel: Fresnel::Schlick, ..glass }).expect("glass");
    let ground = Form::Plane { normal: DVec3::Y, offset: -1.1 };
    scene.leaf(ground, &Affine::identity(), floor).expect("a floor");
    scene.leaf(form, place, glass).expect("a solid");
    scene
}

fn picture<const NEEDS: u64>(parts: Parts<'_, f64>) -> Result<Vec<Rgb<f64>>, SceneError> {
    let scene = Scene::limited::<NEEDS>(parts)?;
    let render: Render<'_, f64, 6, 36, (), NEEDS> = Render::new(&scene, 24, 18, Depth::fixed(5))?;
    Ok(render.map(|pixel| pixel.color).collect())
}

/// The same bits with what is needed and with everything; refused without the one.
fn compare<const NEEDS: u64, const WITHOUT: u64>(builder: &Builder) {
    let parts = *builder.scene().expect("a scene").parts();
    assert_eq!(parts.needs(), NEEDS, "needs {:x}", parts.needs());
    let all = picture::<{ needs::ALL }>(parts).expect("a picture");
    assert!(all.iter().any(|color| Some(color) != all.first()), "something to see");
    assert_eq!(picture::<NEEDS>(parts).expect("the same picture"), all);
    let refused = picture::<WITHOUT>(parts).expect_err("more than it is made for");
    assert!(matches!(refused, SceneError::NotNeeded { .. }), "{refused}");
    assert!(refused.to_string().contains("not among them"), "{refused}");
}

macro_rules! solids {
    ($($name:ident: $need:expr, $form:expr;)*) => {
        $(
        #[test]
        fn $name() {
            compare::<{ STAGE | $need }, { STAGE }>(&stage($form, &Affine::identity()));
        }
        )*
    };
}

solids! {
    spheres: needs::SPHERE, Form::Sphere { center: DVec3::ZERO, radius: 1.0 };
    boxes: needs::BOX, Form::Box { min: -DVec3::ONE, max: DVec3::ONE * 0.5 };
    cylinders: needs::CYLINDER, Form::Cylinder { base: -DVec3::Y, top: DVec3::Y, radius: 0.7 };
    cones: needs::CONE, Form::Cone {
        base: -DVec3::Y, base_radius: 1.0, top: DVec3::Y, top_radius: 0.2
    };
    tori: needs::TORUS, Form::Torus {
        center: DVec3::ZERO, axis: DVec3::Y, major: 0.8, minor: 0.3
    };
    lathes: needs::LATHE, Form::Lathe {
        center: DVec3::ZERO, profile: Profile::Linear(&[[0.0, -1.0], [0.9, 0.0], [0.0, 1.0]])
    };
    prisms: needs::PRISM, Form::Prism {
        vertices: &[[1.0, 0.0], [-1.0, 0.9], [-0.4, 0.0], [-1.0, -0.9]], height: 0.6
    };
    quadrics: needs::QUADRIC, Form::Quadric {
        center: DVec3::ZERO,
        squares: DVec3::new(1.0, 2.0, 1.0),
        products: DVec3::ZERO,
        linear: DVec3::ZERO,
        constant: -1.0,
    };
    triangles: needs::TRIANGLE, Form::Triangle {
        corners: [CORNERS[0], CORNERS[3], CORNERS[1]], normals: None
    };
    polygons: needs::POLYGON, Form::Polygon {
        vertices: &[DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y]
    };
    implicits: needs::IMPLICIT, Form::Implicit {
        min: DVec3::splat(-1.1),
        max: DVec3::splat(1.1),
        code: &[X, SQUARE, Y, SQUARE, ADD, Z, SQUARE, ADD, NUMBER, 0, SUB],
        numbers: &[1.0],
        spans: None,
    };
    meshes: needs::MESH, Form::Mesh(Triangles {
        points: TETRAHEDRON, normals: None, uvs: None, closed: true
    });
    blobs: needs::BLOB, Form::Blob {
        threshold: 0.5,
        components: &[
            Metaball { ends: [DVec3::ZERO; 2], radius: 1.0, strength: 1.0 },
            Metaball { ends: [DVec3::ZERO, DVec3::X], radius: 0.8, strength: 0.7 },
        ],
    };
    patches: needs::PATCHES, Form::Patches { points: &hill(), patches: &[ROWS] };
}

const BALL: Form<'static, f64> = Form::Sphere { center: DVec3::ZERO, radius: 1.0 };

#[test]
fn placements() {
    let place = Affine::scale(DVec3::new(1.0, 0.5, 1.2));
    const BALLS: u64 = STAGE | needs::SPHERE;
    compare::<{ BALLS | needs::PLACEMENTS }, BALLS>(&stage(BALL, &place));
}

/// The needs of a scene in which only a texture is placed were refused by the scene itself.
#[test]
fn a_placement_of_a_texture_is_a_need() {
    let scene = stage(BALL, &Affine::identity());
    let parts = *scene.scene().expect("a scene").parts();
    let placements = [Placement::new(&Affine::scale(DVec3::splat(2.0))).expect("a placement")];
    let textures = [Texture { placement: Some(0), ..*parts.textures.first().expect("a texture") }];
    let placed = Parts { placements: &placements, textures: &textures, ..parts };
    const BALLS: u64 = STAGE | needs::SPHERE | needs::PLACEMENTS;
    assert_eq!(placed.needs(), BALLS);
    let all = picture::<{ needs::ALL }>(placed).expect("a picture");
    assert_eq!(picture::<BALLS>(placed).expect("the same picture"), all);
    assert_ne!(picture::<BALLS>(parts).expect("another picture"), all);
}

#[test]
fn operators() {
    const BALLS: u64 = STAGE | needs::SPHERE;
    let mut scene = stage(BALL, &Affine::identity());
    scene.open(Operator::Difference).expect("an operator");
    for center in [DVec3::X, DVec3::new(1.5, 0.2, 0.1)] {
        let ball = Form::Sphere { center, radius: 0.6 };
        scene.leaf(ball, &Affine::identity(), 1).expect("a ball");
    }
    scene.close(1).expect("a solid");
    compare::<{ BALLS | needs::OPERATORS }, BALLS>(&scene);
}

/// A scene without textures, without mirrors and without glass is refused only what it has.
#[test]
fn what_materials_ask_for() {
    const FULL: u64 = STAGE | needs::SPHERE;
    let scene = stage(BALL, &Affine::identity());
    let parts = *scene.scene().expect("a scene").parts();
    let what = |refused: Result<Vec<Rgb<f64>>, SceneError>| match refused {
        Err(SceneError::NotNeeded { at, what }) => (at, what),
        other => panic!("{other:?}"),
    };
    let without_textures = picture::<{ FULL & !needs::TEXTURES }>(parts);
    assert_eq!(what(without_textures), (Item::Texture(0), "a texture"));
    let without_mirrors = picture::<{ FULL & !needs::MIRRORS }>(parts);
    assert_eq!(what(without_mirrors), (Item::Material(1), "a mirror"));
    let without_glass = picture::<{ FULL & !needs::GLASS }>(parts);
    assert_eq!(what(without_glass), (Item::Material(1), "glass"));
    // Of what it has not it need not be told.
    let plain = [Material::matte(Rgb::new(0.7, 0.4, 0.2)); 2];
    let matte = Parts { materials: &plain, textures: &[], stops: &[], ..parts };
    let least = picture::<{ needs::SPHERE | needs::PLANE }>(matte).expect("a picture");
    assert_eq!(least, picture::<{ needs::ALL }>(matte).expect("the same picture"));
    assert_eq!(matte.needs(), needs::SPHERE | needs::PLANE | needs::MIRRORS | needs::GLASS);
}

/// Mirrors without glass, and glass without mirrors.
#[test]
fn either_of_mirrors_and_glass() {
    const FULL: u64 = STAGE | needs::SPHERE;
    let scene = stage(BALL, &Affine::identity());
    let parts = *scene.scene().expect("a scene").parts();
    let floor = *parts.materials.first().expect("a floor");
    let mirrors = [floor, Material { reflect: 0.6, ..Material::PLAIN }];
    let mirrors = Parts { materials: &mirrors, ..parts };
    let all = picture::<{ needs::ALL }>(mirrors).expect("a picture");
    assert_eq!(picture::<{ FULL & !needs::GLASS }>(mirrors).expect("the same"), all);
    let glass = [floor, Material { transmit: 0.8, ior: 1.4, ..Material::PLAIN }];
    let glass = Parts { materials: &glass, ..parts };
    let all = picture::<{ needs::ALL }>(glass).expect("a picture");
    // Beyond the critical angle glass mirrors.
    let refused = picture::<{ FULL & !needs::MIRRORS }>(glass);
    assert_eq!(refused.expect("the same"), all);
}

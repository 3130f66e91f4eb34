//! Every kind of bad scene is refused, with the place, the field and the limit.
#![allow(
    clippy::expect_used,
    clippy::indexing_slicing,
    clippy::unwrap_used,
    reason = "tests may panic"
)]

use nostray::{glam::Vec3, solid::NESTING_MAX, *};

/// The tables of a scene, to be spoilt one thing at a time.
#[derive(Clone)]
struct Tables {
    nodes: Vec<Node<f32>>,
    objects: Vec<Object<f32>>,
    materials: Vec<Material<f32>>,
    textures: Vec<Texture<f32>>,
    stops: Vec<Stop<f32>>,
    lights: Vec<Light<f32>>,
    placements: Vec<Placement<f32>>,
    points: Vec<Vec3>,
    camera: Camera<f32>,
    background: Background<f32>,
    ambient: Rgb<f32>,
}

const GREY: Rgb<f32> = Rgb::new(0.5, 0.5, 0.5);

fn leaf(shape: Shape<f32>) -> Node<f32> {
    Node::Leaf(Leaf { shape, material: 0, placement: None })
}

fn ball() -> Node<f32> {
    leaf(Shape::Sphere(Sphere { center: Vec3::ZERO, radius: 1.0 }))
}

fn op(operator: Operator, size: u32) -> Node<f32> {
    Node::Operator { operator, size }
}

fn triangle() -> Node<f32> {
    leaf(Shape::Triangle(Triangle { corners: [0, 1, 2], normals: Triangle::FLAT }))
}

/// A texture of the stops with this index and the next.
fn checker(first: u16) -> Texture<f32> {
    Texture { placement: Some(0), ..Texture::new(Pattern::Checker, Ramp::new(first, 2)) }
}

fn stops(first: Paint<f32>, second: Paint<f32>) -> [Stop<f32>; 4] {
    let grey = Stop::color(1.0, GREY);
    [Stop { at: 0.0, paint: first }, grey, Stop { at: 0.0, paint: second }, grey]
}

impl Tables {
    /// Object 0: node 0, a ball. Object 1: nodes 1 to 4, (ball ∪ triangle) in a union.
    fn good() -> Self {
        let toward = Vec3::new(0.0, -1.0, 0.0);
        let spot = Spotlight { axis: toward, cos_inner: 0.9, cos_outer: 0.8 };
        let mut placed = Leaf {
            shape: Shape::Sphere(Sphere { center: Vec3::ZERO, radius: 0.5 }),
            material: 0,
            placement: None,
        };
        placed.placement = Some(0);
        Self {
            nodes: vec![ball(), op(Operator::Union, 4), ball(), triangle(), Node::Leaf(placed)],
            objects: vec![Object::new(0, 1, 0), Object::new(1, 4, 0)],
            materials: vec![Material::matte(GREY)],
            textures: vec![checker(0), checker(2)],
            stops: stops(Paint::Solid(GREY), Paint::Texture(0)).to_vec(),
            lights: vec![
                Light::Point { at: Vec3::ONE, color: GREY, attenuation: Attenuation::NONE },
                Light::Directional { toward, color: GREY },
                Light::Spot {
                    at: Vec3::ONE,
                    cone: spot,
                    color: GREY,
                    attenuation: Attenuation::NONE,
                },
            ],
            placements: vec![Placement::new(&Affine::translate(Vec3::X)).unwrap()],
            points: vec![Vec3::X, Vec3::Y, Vec3::Z, Vec3::new(1.0, 0.0, 1.0)],
            camera: Camera {
                eye: Vec3::new(0.0, 0.0, 5.0),
                look_at: Vec3::ZERO,
                up: Vec3::Y,
                projection: Projection::Pinhole { fov: 40.0 },
            },
            background: Background::Gradient { bottom: GREY, top: GREY },
            ambient: GREY,
        }
    }

    fn scene(&self) -> Result<Scene<'_, f32>, SceneError> {
        Scene::new(Parts {
            nodes: &self.nodes,
            objects: &self.objects,
            materials: &self.materials,
            textures: &self.textures,
            stops: &self.stops,
            lights: &self.lights,
            placements: &self.placements,
            tables: nostray::Tables { points: &self.points, ..nostray::Tables::EMPTY },
            background: self.background,
            ambient: self.ambient,
            ..Parts::seen_by(self.camera)
        })
    }
}

/// Why the good scene is refused after a change.
fn refused(spoil: impl FnOnce(&mut Tables)) -> SceneError {
    let mut tables = Tables::good();
    assert!(tables.scene().is_ok());
    spoil(&mut tables);
    tables.scene().expect_err("a bad scene was taken")
}

/// Why the good scene is refused with another shape as node 2.
fn refused_shape(shape: Shape<f32>) -> SceneError {
    refused(|t| t.nodes[2] = leaf(shape))
}

const NODE: Item = Item::Node(2);

#[test]
fn lengths_are_positive_and_finite() {
    let sphere = |radius: f32| refused_shape(Shape::Sphere(Sphere { center: Vec3::ZERO, radius }));
    let field = "radius";
    for radius in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        assert_eq!(sphere(radius), SceneError::NotFinite { at: NODE, field });
    }
    for radius in [0.0, -0.0, -1.0, 1e-30] {
        assert_eq!(sphere(radius), SceneError::NotPositive { at: NODE, field });
    }
    assert_eq!(sphere(1e30), SceneError::TooLarge { at: NODE, field });
    let cylinder = |half_height: f32, radius: f32| {
        refused_shape(Shape::Cylinder(Cylinder { center: Vec3::ZERO, half_height, radius }))
    };
    assert_eq!(cylinder(0.0, 1.0), SceneError::NotPositive { at: NODE, field: "half_height" });
    assert_eq!(cylinder(1.0, -1.0), SceneError::NotPositive { at: NODE, field });
    let cone = |half_height: f32, base_radius: f32, top_radius: f32| {
        let center = Vec3::ZERO;
        refused_shape(Shape::Cone(Cone { center, half_height, base_radius, top_radius }))
    };
    assert_eq!(cone(1.0, -1.0, 1.0), SceneError::NotPositive { at: NODE, field: "base_radius" });
    assert_eq!(cone(1.0, 1.0, f32::NAN), SceneError::NotFinite { at: NODE, field: "top_radius" });
    assert_eq!(cone(1.0, 0.0, 0.0), SceneError::Empty { at: NODE, field: "base_radius" });
}

#[test]
fn points_and_extents_are_legal() {
    let bent = Vec3::new(0.0, f32::NAN, 0.0);
    let sphere = |center: Vec3| refused_shape(Shape::Sphere(Sphere { center, radius: 1.0 }));
    assert_eq!(sphere(bent), SceneError::NotFinite { at: NODE, field: "center" });
    assert_eq!(sphere(Vec3::X * 1e20), SceneError::TooLarge { at: NODE, field: "center" });
    let cuboid = |min: Vec3, max: Vec3| refused_shape(Shape::Box(Cuboid { min, max }));
    assert_eq!(cuboid(bent, Vec3::ONE), SceneError::NotFinite { at: NODE, field: "min" });
    assert_eq!(cuboid(Vec3::ONE, Vec3::ZERO), SceneError::Inverted { at: NODE, field: "max" });
    let flat = Vec3::new(1.0, 0.0, 1.0);
    assert_eq!(cuboid(Vec3::ZERO, flat), SceneError::Empty { at: NODE, field: "max" });
    let plane = |normal: Vec3, offset: f32| refused_shape(Shape::Plane(Plane { normal, offset }));
    assert_eq!(plane(Vec3::ZERO, 0.0), SceneError::Empty { at: NODE, field: "normal" });
    assert_eq!(plane(Vec3::X, f32::NAN), SceneError::NotFinite { at: NODE, field: "offset" });
}

#[test]
fn placed_shapes_are_centred() {
    let error = refused(|t| {
        let shape = Shape::Sphere(Sphere { center: Vec3::X, radius: 1.0 });
        t.nodes[2] = Node::Leaf(Leaf { shape, material: 0, placement: Some(0) });
    });
    assert_eq!(error, SceneError::OffCentre { at: NODE, field: "center" });
    let error = refused(|t| {
        let shape = Shape::Plane(Plane { normal: Vec3::X, offset: 0.0 });
        t.nodes[2] = Node::Leaf(Leaf { shape, material: 0, placement: Some(0) });
    });
    assert_eq!(error, SceneError::Placed { at: NODE });
}

#[test]
fn open_surfaces_have_points_and_an_area() {
    let triangle = |corners: [u32; 3], normals: u32| {
        refused_shape(Shape::Triangle(Triangle { corners, normals }))
    };
    let beyond = |index| SceneError::IndexOutOfRange { at: NODE, table: "points", index, len: 4 };
    assert_eq!(triangle([0, 9, 2], Triangle::FLAT), beyond(9));
    assert_eq!(triangle([0, 1, 2], 2), beyond(4));
    let empty = |field| SceneError::Empty { at: NODE, field };
    assert_eq!(triangle([0, 1, 1], Triangle::FLAT), empty("corners"));
    let polygon = |first: u32, count: u32, normal: Vec3| {
        refused_shape(Shape::Polygon(Polygon { first, count, normal }))
    };
    let normal = Polygon::<f32>::newell(&[Vec3::X, Vec3::Y, Vec3::Z]);
    assert_eq!(polygon(2, 3, normal), beyond(4));
    assert_eq!(polygon(u32::MAX, 3, normal), beyond(u32::MAX));
    assert_eq!(polygon(0, 2, normal), empty("vertices"));
    let flaw = |field| SceneError::NotPlanar { at: NODE, field };
    assert_eq!(polygon(0, 3, Vec3::X), flaw("normal"));
    let bent = Polygon::<f32>::newell(&Tables::good().points);
    assert_eq!(polygon(0, 4, bent), flaw("vertices"));
    let error = refused(|t| t.points[1] = Vec3::splat(f32::NAN));
    assert_eq!(error, SceneError::NotFinite { at: Item::Node(3), field: "corners" });
}

#[test]
fn placements_are_sound() {
    let at = Item::Placement(0);
    let mut broken = Placement::new(&Affine::<f32>::identity()).unwrap();
    broken.to_local[0] = Vec3::ZERO;
    assert_eq!(refused(|t| t.placements[0] = broken), SceneError::SingularPlacement { at });
    broken.to_local[0] = Vec3::NAN;
    let field = "placement";
    assert_eq!(refused(|t| t.placements[0] = broken), SceneError::NotFinite { at, field });
    let far = Placement::new(&Affine::translate(Vec3::X * 1e16)).unwrap();
    let field = "anchor";
    assert_eq!(refused(|t| t.placements[0] = far), SceneError::TooLarge { at, field });
    let mut stretched = Placement::new(&Affine::scale(Vec3::splat(2.0))).unwrap();
    stretched.rigid = true;
    let error = refused(|t| t.placements[0] = stretched);
    assert!(matches!(error, SceneError::OutOfRange { at: Item::Placement(0), field: "rigid", .. }));
}

#[test]
fn indices_stay_within_their_tables() {
    let beyond = |at, table, index, len| SceneError::IndexOutOfRange { at, table, index, len };
    let with = |material, placement| {
        let shape = Shape::Sphere(Sphere { center: Vec3::ZERO, radius: 1.0 });
        refused(|t| t.nodes[2] = Node::Leaf(Leaf { shape, material, placement }))
    };
    assert_eq!(with(1, None), beyond(NODE, "materials", 1, 1));
    assert_eq!(with(0, Some(7)), beyond(NODE, "placements", 7, 1));
    let error = refused(|t| t.objects[1].material = 3);
    assert_eq!(error, beyond(Item::Object(1), "materials", 3, 1));
    let error = refused(|t| t.objects[1].count = 5);
    assert_eq!(error, beyond(Item::Object(1), "nodes", 6, 5));
    let error = refused(|t| t.objects[1].first = u32::MAX);
    assert_eq!(error, beyond(Item::Object(1), "nodes", u32::MAX, 5));
    let error = refused(|t| t.materials[0].color = Paint::Texture(2));
    assert_eq!(error, beyond(Item::Material(0), "textures", 2, 2));
    let error = refused(|t| t.stops[2].paint = Paint::Texture(2));
    assert_eq!(error, beyond(Item::Texture(1), "textures", 2, 2));
    let error = refused(|t| t.textures[1].placement = Some(1));
    assert_eq!(error, beyond(Item::Texture(1), "placements", 1, 1));
}

#[test]
fn textures_name_earlier_ones_and_have_a_size() {
    for names in [0, 1] {
        let error = refused(|t| t.stops[0].paint = Paint::Texture(names));
        let names = u32::from(names);
        assert_eq!(error, SceneError::TextureOrder { at: Item::Texture(0), names });
    }
    let sized = |size: [f32; 3]| refused(|t| t.textures[0].size = size);
    let (at, field) = (Item::Texture(0), "size");
    assert_eq!(sized([1.0, 0.0, 1.0]), SceneError::NotPositive { at, field });
    assert_eq!(sized([1.0, f32::NAN, 1.0]), SceneError::NotFinite { at, field });
}

/// Why the good scene is refused with other nodes as its second object.
fn refused_nodes(nodes: &[Node<f32>]) -> SceneError {
    refused(|t| {
        t.nodes.truncate(1);
        t.nodes.extend(nodes);
        t.objects[1].count = nodes.len() as u32;
    })
}

#[test]
fn operators_have_their_operands() {
    use Operator::{Complement, Difference, Union};
    let (one, two) = (Item::Node(1), Item::Node(2));
    let none = |at| SceneError::OperandUnderflow { at, operands: 0, least: 1 };
    assert_eq!(refused_nodes(&[op(Union, 1)]), none(one));
    assert_eq!(refused_nodes(&[op(Union, 3), op(Difference, 1), ball()]), none(two));
    let most = SceneError::OperandOverflow { at: one, most: 1 };
    assert_eq!(refused_nodes(&[op(Complement, 3), ball(), ball()]), most);
    let nested = [op(Union, 4), op(Complement, 3), ball(), ball()];
    assert_eq!(refused_nodes(&nested), SceneError::OperandOverflow { at: two, most: 1 });
    for size in [0, 4, u32::MAX] {
        let error = refused_nodes(&[op(Union, size), ball(), ball()]);
        assert_eq!(error, SceneError::OperatorSize { at: one, size });
    }
    let error = refused_nodes(&[op(Union, 4), ball(), op(Union, 3), ball(), ball()]);
    assert_eq!(error, SceneError::OperatorSize { at: Item::Node(3), size: 3 });
}

#[test]
fn an_object_is_one_tree() {
    let at = Item::Object(1);
    let error = refused_nodes(&[ball(), ball()]);
    assert_eq!(error, SceneError::StrayNodes { at, node: 2 });
    let error = refused_nodes(&[op(Operator::Union, 2), ball(), ball()]);
    assert_eq!(error, SceneError::StrayNodes { at, node: 3 });
    assert_eq!(refused_nodes(&[]), SceneError::StrayNodes { at, node: 1 });
}

#[test]
fn depth_and_boundaries_are_bounded() {
    let nested = |depth: u32| -> Vec<Node<f32>> {
        let operators = (0..depth).map(|outer| op(Operator::Xor, depth + 1 - outer));
        operators.chain([ball()]).collect()
    };
    let mut tables = Tables::good();
    tables.nodes = nested(NESTING_MAX as u32);
    tables.objects = vec![Object::new(0, tables.nodes.len() as u32, 0)];
    assert!(tables.scene().is_ok());
    let limit = NESTING_MAX as u32;
    let error = refused_nodes(&nested(limit + 1));
    assert_eq!(error, SceneError::TooDeep { at: Item::Node(1 + limit), limit });

    let many = |leaves: u32| -> Vec<Node<f32>> {
        let leaf = core::iter::repeat_n(ball(), leaves as usize);
        core::iter::once(op(Operator::Union, leaves + 1)).chain(leaf).collect()
    };
    let error = refused_nodes(&many(16_384));
    let (at, limit) = (Item::Object(1), u32::from(u16::MAX));
    assert_eq!(error, SceneError::SpanOverflow { at, needed: 65_536, limit });
    tables.nodes = many(16_383);
    tables.objects = vec![Object::new(0, 16_384, 0)];
    assert_eq!(tables.scene().unwrap().limits().boundaries, 65_532);
}

#[test]
fn open_surfaces_stand_only_in_unions() {
    for operator in [Operator::Intersection, Operator::Difference, Operator::Xor] {
        let at = Item::Node(3);
        let error = refused_nodes(&[op(operator, 3), ball(), triangle()]);
        assert_eq!(error, SceneError::OpenSurface { at, operator });
        let first = refused_nodes(&[op(operator, 3), triangle(), ball()]);
        assert_eq!(first, SceneError::OpenSurface { at: NODE, operator });
        // Also where the nearest operator is a union.
        let nested = [op(operator, 5), ball(), op(Operator::Union, 3), ball(), triangle()];
        let error = refused_nodes(&nested);
        assert_eq!(error, SceneError::OpenSurface { at: Item::Node(5), operator });
        let outer = [op(Operator::Union, 4), op(operator, 3), ball(), triangle()];
        let error = refused_nodes(&outer);
        assert_eq!(error, SceneError::OpenSurface { at: Item::Node(4), operator });
    }
    let operator = Operator::Complement;
    let error = refused_nodes(&[op(operator, 2), triangle()]);
    assert_eq!(error, SceneError::OpenSurface { at: NODE, operator });
}

#[test]
fn stated_bounds_hold_their_object() {
    let at = Item::Object(0);
    let bounds = |size: f32| Bounds { min: Vec3::splat(-size), max: Vec3::splat(size) };
    for size in [0.5, 1.0, f32::NAN] {
        let error = refused(|t| t.objects[0].bounds = Some(bounds(size)));
        assert_eq!(error, SceneError::BoundsTooSmall { at }, "{size}");
    }
    let mut tables = Tables::good();
    tables.objects[0].bounds = Some(bounds(1.001));
    assert!(tables.scene().is_ok());
}

#[test]
fn lights_and_surfaces_are_in_range() {
    let out = |error: SceneError, at: Item, field: &str| match error {
        SceneError::OutOfRange { at: place, field: name, .. } => (place, name) == (at, field),
        _ => false,
    };
    let material = |change: fn(&mut Material<f32>)| refused(|t| change(&mut t.materials[0]));
    let at = Item::Material(0);
    assert!(out(material(|m| m.diffuse = -0.1), at, "diffuse"));
    assert!(out(material(|m| m.reflect = 2e4), at, "reflect"));
    assert!(out(material(|m| m.ior = 0.0), at, "ior"));
    assert!(out(material(|m| m.shininess = -1.0), at, "shininess"));
    assert!(out(material(|m| m.absorb = Rgb::new(0.0, -1.0, 0.0)), at, "absorb"));
    assert!(out(material(|m| m.color = Paint::Solid(Rgb::new(-1.0, 0.0, 0.0))), at, "color"));
    let not = |at, field| SceneError::NotFinite { at, field };
    assert_eq!(material(|m| m.transmit = f32::NAN), not(at, "transmit"));
    assert_eq!(material(|m| m.ior = f32::INFINITY), not(at, "ior"));
    assert_eq!(material(|m| m.shininess = f32::NAN), not(at, "shininess"));

    let at = Item::Light(2);
    let spot = |cos_inner: f32, cos_outer: f32, axis: Vec3, constant: f32| {
        refused(|t| {
            let attenuation = Attenuation { constant, linear: 0.0, quadratic: 0.0 };
            let cone = Spotlight { axis, cos_inner, cos_outer };
            t.lights[2] = Light::Spot { at: Vec3::ONE, cone, color: GREY, attenuation };
        })
    };
    assert!(out(spot(0.8, 0.9, Vec3::X, 1.0), at, "cone"));
    assert!(out(spot(f32::NAN, 0.9, Vec3::X, 1.0), at, "cone"));
    assert!(out(spot(0.9, 0.8, Vec3::ONE, 1.0), at, "toward"));
    assert!(out(spot(0.9, 0.8, Vec3::X, 0.0), at, "attenuation"));
    let point = |position: Vec3, color: Rgb<f32>| {
        let attenuation = Attenuation::NONE;
        refused(|t| t.lights[0] = Light::Point { at: position, color, attenuation })
    };
    let at = Item::Light(0);
    assert_eq!(point(Vec3::NAN, GREY), not(at, "at"));
    assert_eq!(point(Vec3::X * 1e20, GREY), SceneError::TooLarge { at, field: "at" });
    assert!(out(point(Vec3::X, Rgb::new(0.0, 0.0, -1.0)), at, "color"));
    let toward = Vec3::ZERO;
    let error = refused(|t| t.lights[1] = Light::Directional { toward, color: GREY });
    assert!(out(error, Item::Light(1), "toward"));

    let dark = Rgb::new(-1.0, 0.0, 0.0);
    assert!(out(refused(|t| t.ambient = dark), Item::Ambient, "color"));
    let error = refused(|t| t.background = Background::Gradient { bottom: GREY, top: dark });
    assert!(out(error, Item::Background, "top"));
    let error = refused(|t| t.background = Background::Constant(Rgb::new(f32::NAN, 0.0, 0.0)));
    assert_eq!(error, not(Item::Background, "color"));
}

#[test]
fn the_camera_looks_somewhere() {
    let at = Item::Camera;
    let camera = |change: fn(&mut Camera<f32>)| refused(|t| change(&mut t.camera));
    let empty = |field| SceneError::Empty { at, field };
    assert_eq!(camera(|c| c.look_at = c.eye), empty("look_at"));
    assert_eq!(camera(|c| c.up = Vec3::Z * 3.0), empty("up"));
    assert_eq!(camera(|c| c.up = Vec3::ZERO), empty("up"));
    let field = "eye";
    assert_eq!(camera(|c| c.eye = Vec3::NAN), SceneError::NotFinite { at, field });
    assert_eq!(camera(|c| c.eye = Vec3::X * 1e20), SceneError::TooLarge { at, field });
    for fov in [0.0, -1.0, 180.0] {
        let error = refused(|t| t.camera.projection = Projection::Pinhole { fov });
        assert!(matches!(error, SceneError::OutOfRange { at: Item::Camera, field: "fov", .. }));
    }
    let error = refused(|t| t.camera.projection = Projection::Pinhole { fov: f32::NAN });
    assert_eq!(error, SceneError::NotFinite { at, field: "fov" });
}

#[test]
fn a_picture_needs_pixels_and_room() {
    let tables = Tables::good();
    let scene = tables.scene().unwrap();
    let size =
        |width, height| Render::<f32>::new(&scene, width, height, Depth::fixed(0)).err().unwrap();
    let (width, height) = (0, 8);
    assert_eq!(size(0, 8), SceneError::PictureSize { width, height });
    let (width, height) = (8, (1 << 24) + 1);
    assert_eq!(size(width, height), SceneError::PictureSize { width, height });
    let shallow: Result<Render<'_, f32, 3, 64>, _> = Render::new(&scene, 8, 8, Depth::fixed(3));
    let depth_max = 3;
    assert_eq!(shallow.err(), Some(SceneError::StackTooSmall { depth_max, limit: 3 }));
    let narrow: Result<Render<'_, f32, 1, 11>, _> = Render::new(&scene, 8, 8, Depth::fixed(0));
    let error = narrow.err().unwrap();
    assert!(matches!(error, SceneError::SpanOverflow { needed: 12, limit: 11, .. }), "{error}");
}

//! The builder takes back what it refuses, and no tables whatsoever make the tracer fail.
#![allow(clippy::indexing_slicing, clippy::unwrap_used, reason = "tests may panic")]

use nostray::glam::Vec3;
use nostray::solid::NESTING_MAX;
use nostray::*;

type Builder = SceneBuilder<f32, Fixed<2, 6, 1, 4>>;

const BALL: Form<'static, f32> = Form::Sphere { center: Vec3::ZERO, radius: 1.0 };
const SLAB: Form<'static, f32> = Form::Cylinder { base: Vec3::ZERO, top: Vec3::X, radius: 0.25 };

fn builder() -> Builder {
    let mut scene = Builder::new();
    scene.material(Material::matte(Rgb::WHITE)).unwrap();
    scene.leaf(BALL, &Affine::identity(), 0).unwrap();
    scene
}

/// Nothing but the first ball is in the tables, and the builder takes another object.
fn assert_intact(scene: &mut Builder) {
    {
        let parts = *scene.scene().unwrap().parts();
        assert_eq!((parts.nodes.len(), parts.objects.len()), (1, 1));
        assert_eq!((parts.placements.len(), parts.tables.points.len()), (0, 0));
    }
    scene.leaf(SLAB, &Affine::identity(), 0).unwrap();
    assert_eq!(scene.scene().unwrap().parts().objects.len(), 2);
}

#[test]
fn a_refused_leaf_takes_its_object_along() {
    let radius = -1.0;
    let identity = Affine::identity();
    let flat = Affine::scale(Vec3::new(1.0, 0.0, 1.0));
    let at = Item::Node(3);
    let corners = [Vec3::X, Vec3::Y, Vec3::Z];
    let cases: [(Form<'_, f32>, Affine<f32>, SceneError); 6] = [
        (
            Form::Cylinder { base: Vec3::ZERO, top: Vec3::ZERO, radius: 1.0 },
            identity,
            SceneError::Empty { at, field: "top" },
        ),
        (
            Form::Cylinder { base: Vec3::NAN, top: Vec3::ZERO, radius: 1.0 },
            identity,
            SceneError::NotFinite { at, field: "base" },
        ),
        (BALL, flat, SceneError::SingularPlacement { at }),
        (
            BALL,
            Affine::translate(Vec3::splat(f32::NAN)),
            SceneError::NotFinite { at, field: "placement" },
        ),
        (
            Form::Polygon { vertices: &[Vec3::ZERO; 5] },
            identity,
            SceneError::Full { table: "points", capacity: 4 },
        ),
        (
            Form::Triangle { corners, normals: Some(corners) },
            identity,
            SceneError::Full { table: "points", capacity: 4 },
        ),
    ];
    for (form, affine, error) in cases {
        let mut scene = builder();
        scene.open(Operator::Union).unwrap();
        scene.leaf(SLAB, &identity, 0).unwrap();
        assert_eq!(scene.leaf(form, &affine, 0), Err(error));
        assert_intact(&mut scene);
    }
    // What only the finished object shows.
    let mut scene = builder();
    let sphere = Form::Sphere { center: Vec3::ZERO, radius };
    let error = SceneError::NotPositive { at: Item::Node(1), field: "radius" };
    assert_eq!(scene.leaf(sphere, &identity, 0), Err(error));
    assert_intact(&mut scene);
}

#[test]
fn a_refused_operator_takes_its_object_along() {
    let identity = Affine::identity();
    let triangle = Form::Triangle { corners: [Vec3::X, Vec3::Y, Vec3::Z], normals: None };
    let mut scene = builder();
    scene.open(Operator::Difference).unwrap();
    scene.leaf(SLAB, &identity, 0).unwrap();
    scene.leaf(triangle, &identity, 0).unwrap();
    let operator = Operator::Difference;
    let error = SceneError::OpenSurface { at: Item::Node(3), operator };
    assert_eq!(scene.close(0), Err(error));
    assert_intact(&mut scene);

    let mut scene = builder();
    scene.open(Operator::Union).unwrap();
    let error = SceneError::OperandUnderflow { at: Item::Node(1), operands: 0, least: 1 };
    assert_eq!(scene.close(0), Err(error));
    assert_intact(&mut scene);

    let mut scene = builder();
    scene.open(Operator::Complement).unwrap();
    scene.leaf(SLAB, &identity, 0).unwrap();
    scene.leaf(SLAB, &identity, 0).unwrap();
    assert_eq!(scene.close(0), Err(SceneError::OperandOverflow { at: Item::Node(1), most: 1 }));
    assert_intact(&mut scene);

    let mut scene = builder();
    scene.open(Operator::Union).unwrap();
    scene.leaf(SLAB, &identity, 4).unwrap();
    let (at, table) = (Item::Node(2), "materials");
    let error = SceneError::IndexOutOfRange { at, table, index: 4, len: 1 };
    assert_eq!(scene.close(0), Err(error));
    assert_intact(&mut scene);
}

#[test]
fn full_tables_say_so() {
    let identity = Affine::identity();
    let full = |table, capacity| SceneError::Full { table, capacity };
    let mut scene = builder();
    let material = Material::matte(Rgb::WHITE);
    assert_eq!(scene.material(material), Err(full("materials", 1)));
    for _ in 0..5 {
        scene.open(Operator::Union).unwrap();
    }
    assert_eq!(scene.open(Operator::Union), Err(full("nodes", 6)));
    assert_eq!(scene.scene().unwrap().parts().nodes.len(), 1);
    scene.leaf(BALL, &identity, 0).unwrap();
    assert_eq!(scene.leaf(BALL, &identity, 0), Err(full("objects", 2)));
    assert_eq!(scene.scene().unwrap().parts().nodes.len(), 2);
    let light = Light::Directional { toward: Vec3::X, color: Rgb::WHITE };
    scene.light(light).unwrap();
    assert_eq!(scene.light(light), Err(full("lights", 1)));
}

#[test]
fn operators_open_and_close_in_pairs() {
    let mut scene = builder();
    assert_eq!(scene.close(0), Err(SceneError::Unbalanced { at: Item::Node(1) }));
    scene.open(Operator::Union).unwrap();
    assert_eq!(scene.scene().err(), Some(SceneError::Unbalanced { at: Item::Node(1) }));

    let mut scene: SceneBuilder<f32> = SceneBuilder::new();
    for _ in 0..NESTING_MAX {
        scene.open(Operator::Union).unwrap();
    }
    let limit = NESTING_MAX as u32;
    let error = SceneError::TooDeep { at: Item::Node(limit), limit };
    assert_eq!(scene.open(Operator::Union), Err(error));
    assert_eq!(scene.scene().unwrap().parts().nodes.len(), 0);
}

#[test]
fn a_placement_for_a_texture_outlives_a_refused_object() {
    let mut scene = builder();
    scene.open(Operator::Complement).unwrap();
    let index = scene.placement(&Affine::translate(Vec3::X)).unwrap();
    scene.leaf(SLAB, &Affine::identity(), 0).unwrap();
    scene.leaf(SLAB, &Affine::identity(), 0).unwrap();
    assert!(scene.close(0).is_err());
    let found = scene.scene().unwrap();
    assert_eq!((index, found.parts().placements.len()), (0, 1));
    assert_eq!(found.parts().placements[0].anchor, Vec3::X);
}

/// Numbers that are the same in every run (SplitMix).
struct Random(u64);

impl Random {
    fn below(&mut self, n: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) % n
    }

    /// An index, mostly within `len`.
    fn index(&mut self, len: u64) -> u32 {
        match self.below(60) {
            0 => u32::MAX - self.below(3) as u32,
            1 => len as u32,
            _ => self.below(len.max(1)) as u32,
        }
    }

    /// A number, now and then an illegal or an extreme one.
    fn number(&mut self) -> f32 {
        let odd = [
            f32::NAN,
            f32::INFINITY,
            f32::NEG_INFINITY,
            0.0,
            -0.0,
            1e-38,
            f32::from_bits(1),
            1e15,
            -1e15,
            3e38,
        ];
        match self.below(120) {
            case @ 0..10 => odd[case as usize],
            _ => self.below(4001) as f32 / 1000.0 - 2.0,
        }
    }

    fn length(&mut self) -> f32 {
        let number = self.number();
        if self.below(60) == 0 { number } else { number.abs() + 0.05 }
    }

    fn point(&mut self) -> Vec3 {
        Vec3::new(self.number(), self.number(), self.number())
    }

    fn shape(&mut self, points: u64) -> Shape<f32> {
        let center = if self.below(2) == 0 { Vec3::ZERO } else { self.point() };
        let radius = self.length();
        match self.below(10) {
            0 | 1 => Shape::Sphere(Sphere { center, radius }),
            2 => Shape::Plane(Plane { normal: self.point(), offset: self.number() }),
            3 => Shape::Box(Cuboid { min: center, max: center + Vec3::splat(radius) }),
            4 => Shape::Cylinder(Cylinder { center, half_height: self.length(), radius }),
            5 => {
                let (half_height, top_radius) = (self.length(), self.length());
                Shape::Cone(Cone { center, half_height, base_radius: radius, top_radius })
            }
            6 => {
                let corners = [self.index(points), self.index(points), self.index(points)];
                let flat = self.below(2) == 0;
                let normals = if flat { Triangle::FLAT } else { self.index(points) };
                Shape::Triangle(Triangle { corners, normals })
            }
            8 => Shape::Quadric(Quadric { center, first: self.index(2) }),
            7 => Shape::Torus(Torus { center, major: self.length(), minor: radius }),
            _ => {
                let (first, count) = (self.index(points), self.index(points));
                Shape::Polygon(Polygon { first, count, normal: Vec3::Z })
            }
        }
    }

    /// A tree that is right except now and then.
    fn tree(&mut self, nodes: &mut Vec<Node<f32>>, depth: u64, points: u64) {
        if depth == 0 || self.below(3) == 0 {
            let shape = self.shape(points);
            let placement = (self.below(4) == 0).then(|| self.index(2) as u16);
            let material = self.index(2) as u16;
            return nodes.push(Node::Leaf(Leaf { shape, material, placement }));
        }
        let operators = [
            Operator::Union,
            Operator::Intersection,
            Operator::Difference,
            Operator::Xor,
            Operator::Complement,
        ];
        let operator = operators[self.below(5) as usize];
        let own = nodes.len();
        nodes.push(Node::Operator { operator, size: 0 });
        let operands = if operator == Operator::Complement { 1 } else { 1 + self.below(3) };
        for _ in 0..operands + u64::from(self.below(60) == 0) {
            self.tree(nodes, depth - 1, points);
        }
        let odd = self.below(60) == 0;
        let size = if odd { self.index(9) } else { (nodes.len() - own) as u32 };
        nodes[own] = Node::Operator { operator, size };
    }
}

/// Makes tables out of random numbers; a scene that is taken must render. Whether it was.
fn try_scene(seed: u64) -> bool {
    let mut random = Random(seed);
    let points: Vec<Vec3> = (0..4).map(|_| random.point()).collect();
    let (mut nodes, mut objects) = (Vec::new(), Vec::new());
    for _ in 0..1 + random.below(3) {
        let first = nodes.len() as u32;
        random.tree(&mut nodes, 3, 4);
        let count = match random.below(60) {
            0 => random.index(5),
            _ => nodes.len() as u32 - first,
        };
        objects.push(Object::new(first, count, random.index(2) as u16));
    }
    let turned = Affine::rotate(Axis::X, random.number() * 90.0);
    let moved = turned.then(&Affine::translate(random.point()));
    let stretched = Affine::scale(random.point()).then(&moved);
    let placements: Vec<_> = [moved, stretched].iter().filter_map(Placement::new).collect();
    let matte = Material::matte(Rgb::new(0.5, 0.6, 0.7));
    let glass = Material { transmit: 0.8, reflect: 0.2, ior: 1.5, absorb: Rgb::WHITE, ..matte };
    let toward = Vec3::new(0.0, -0.6, -0.8);
    let materials = [matte, glass];
    let lights = [Light::Directional { toward, color: Rgb::WHITE }];
    let scene = Scene::new(Parts {
        nodes: &nodes,
        objects: &objects,
        materials: &materials,
        textures: &[],
        stops: &[],
        images: &[],
        pixels: &[],
        channels: &[],
        lights: &lights,
        placements: &placements,
        tables: nostray::Tables { points: &points, ..nostray::Tables::EMPTY },
        camera: Camera {
            eye: Vec3::new(random.number(), random.number(), 5.0),
            look_at: Vec3::ZERO,
            up: Vec3::Y,
            projection: Projection::Pinhole { fov: 50.0 },
        },
        background: Background::Constant(Rgb::WHITE),
        ambient: Rgb::WHITE,
    });
    let Ok(scene) = scene else {
        return false;
    };
    let render: Result<Render<'_, f32, 5, 256>, _> = Render::new(&scene, 4, 4, Depth::fixed(4));
    let pixels: Vec<_> = render.unwrap().collect();
    assert_eq!(pixels.len(), 16);
    for pixel in pixels {
        let parts = pixel.color.to_array();
        assert!(parts.iter().all(|&part| (0.0..1e9).contains(&part)), "seed {seed}: {pixel:?}");
    }
    true
}

#[test]
fn random_tables_are_refused_or_render() {
    let tried = 60_000;
    let taken = (0..tried).filter(|&seed| try_scene(seed)).count() as u64;
    assert!(taken > tried / 20 && taken < tried * 19 / 20, "{taken}");
}

//! What a scene asks of the tracer, so that a program holds no code for anything else.
//!
//! A [`Scene`](crate::Scene) is made for certain needs, which are a part of its type: code for a
//! solid, for operators, textures, mirrors or glass that they do not name is not even linked. By default it
//! is made for [`ALL`]. What a `static` scene needs is known when it is compiled:
//!
//! ```
//! use nostray::glam::Vec3;
//! use nostray::*;
//!
//! const BALL: Shape<f32> = Shape::Sphere(Sphere { center: Vec3::ZERO, radius: 1.5 });
//!
//! static PARTS: Parts<f32> = Parts {
//!     nodes: &[Node::Leaf(Leaf { shape: BALL, material: 0, placement: None })],
//!     objects: &[Object::new(0, 1, 0)],
//!     materials: &[Material { color: Paint::Solid(Rgb::new(0.9, 0.2, 0.1)), ..Material::PLAIN }],
//!     ambient: Rgb::WHITE,
//!     ..Parts::seen_by(Camera::pinhole(Vec3::new(0.0, 0.0, 5.0), Vec3::ZERO, Vec3::Y, 40.0))
//! };
//!
//! // Numbers are not looked at when a program is compiled: that nothing mirrors and nothing lets light through
//! // has to be said, and is checked when the scene is made.
//! const NEEDS: u64 = PARTS.needs() & !needs::MIRRORS & !needs::GLASS;
//!
//! let scene = Scene::limited::<NEEDS>(PARTS)?;
//! let render: Render<f32, 1, 2, (), NEEDS> = Render::new(&scene, 8, 8, Depth::fixed(0))?;
//! assert_eq!(render.count(), 64);
//! # Ok::<(), SceneError>(())
//! ```

use crate::scalar::Scalar;
use crate::scene::Parts;
use crate::shape::Shape;
use crate::solid::Node;
use crate::texture::Mapping;

/// Spheres.
pub const SPHERE: u64 = 1;
/// Half-spaces.
pub const PLANE: u64 = 1 << 1;
/// Boxes.
pub const BOX: u64 = 1 << 2;
/// Cylinders.
pub const CYLINDER: u64 = 1 << 3;
/// Cones and frusta.
pub const CONE: u64 = 1 << 4;
/// Tori.
pub const TORUS: u64 = 1 << 5;
/// Surfaces of revolution.
pub const LATHE: u64 = 1 << 6;
/// Prisms.
pub const PRISM: u64 = 1 << 7;
/// Quadrics.
pub const QUADRIC: u64 = 1 << 8;
/// Triangles.
pub const TRIANGLE: u64 = 1 << 9;
/// Polygons.
pub const POLYGON: u64 = 1 << 10;
/// Implicit solids.
pub const IMPLICIT: u64 = 1 << 11;
/// Meshes.
pub const MESH: u64 = 1 << 12;
/// Bézier patches.
pub const PATCHES: u64 = 1 << 13;
/// Blobs.
pub const BLOB: u64 = 1 << 14;
/// Solids that are combined of others.
pub const OPERATORS: u64 = 1 << 32;
/// Solids and textures in coordinates of their own.
pub const PLACEMENTS: u64 = 1 << 33;
/// Textures, and channels that they drive.
pub const TEXTURES: u64 = 1 << 34;
/// Textures in the coordinates of surfaces.
pub const COORDINATES: u64 = 1 << 35;
/// Materials that mirror, also by Fresnel's law.
pub const MIRRORS: u64 = 1 << 36;
/// Materials that let light through.
pub const GLASS: u64 = 1 << 37;
/// Everything.
pub const ALL: u64 = u64::MAX;

/// Whether needs name one.
pub(crate) const fn has(needs: u64, need: u64) -> bool {
    needs & need != 0
}

/// What a scene asks for, as far as its tables tell without a look at their numbers: mirrors and glass
/// are always among it.
pub(crate) const fn of_parts<S: Scalar>(parts: &Parts<'_, S>) -> u64 {
    let mut needs = MIRRORS | GLASS;
    // Those of textures are among them.
    if !parts.placements.is_empty() {
        needs |= PLACEMENTS;
    }
    let mut nodes = parts.nodes;
    while let Some((node, rest)) = nodes.split_first() {
        needs |= match node {
            Node::Operator { .. } => OPERATORS,
            Node::Leaf(leaf) => of_shape(&leaf.shape),
        };
        nodes = rest;
    }
    let mut textures = parts.textures;
    while let Some((texture, rest)) = textures.split_first() {
        needs |= match texture.mapping {
            Mapping::Uv => TEXTURES | COORDINATES,
            _ => TEXTURES,
        };
        textures = rest;
    }
    needs
}

/// What a shape asks for.
pub(crate) const fn of_shape<S: Scalar>(shape: &Shape<S>) -> u64 {
    match shape {
        Shape::Sphere(_) => SPHERE,
        Shape::Plane(_) => PLANE,
        Shape::Box(_) => BOX,
        Shape::Cylinder(_) => CYLINDER,
        Shape::Cone(_) => CONE,
        Shape::Torus(_) => TORUS,
        Shape::Lathe(_) => LATHE,
        Shape::Prism(_) => PRISM,
        Shape::Quadric(_) => QUADRIC,
        Shape::Triangle(_) => TRIANGLE,
        Shape::Polygon(_) => POLYGON,
        Shape::Implicit(_) => IMPLICIT,
        Shape::Blob(_) => BLOB,
        Shape::Mesh(_) => MESH,
        Shape::Patches(_) => PATCHES,
    }
}

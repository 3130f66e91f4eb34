//! Scenes put together at run time, in tables of fixed size.

use super::check::check_object;
use super::{Object, Parts, Scene};
use crate::background::Background;
use crate::camera::{Camera, Projection};
use crate::color::Rgb;
use crate::error::{Item, SceneError};
use crate::light::Light;
use crate::material::Material;
use crate::place::{Affine, Placement, apply_transposed};
use crate::scalar::{Axis, Scalar, Vector};
use crate::shape::{Cone, Cuboid, Cylinder, Plane, Polygon, Shape, Sphere, Triangle};
use crate::solid::{Leaf, NESTING_MAX, Node};
use crate::span::Operator;
use crate::texture::Texture;

/// A table that grows, as far as it can.
pub trait Store<T: Copy>: Default {
    /// Adds an entry; false where there is no room.
    fn push(&mut self, entry: T) -> bool;
    /// The entries.
    fn entries(&self) -> &[T];
    /// The entries, to be changed.
    fn entries_mut(&mut self) -> &mut [T];
    /// Drops all entries from the given one on.
    fn truncate(&mut self, len: usize);
    /// How many entries there is room for.
    fn capacity(&self) -> usize;
}

impl<T: Copy, const N: usize> Store<T> for heapless::Vec<T, N> {
    fn push(&mut self, entry: T) -> bool {
        Self::push(self, entry).is_ok()
    }
    fn entries(&self) -> &[T] {
        self
    }
    fn entries_mut(&mut self) -> &mut [T] {
        self
    }
    fn truncate(&mut self, len: usize) {
        Self::truncate(self, len);
    }
    fn capacity(&self) -> usize {
        N
    }
}

/// Where a [`SceneBuilder`] keeps its tables.
pub trait Storage {
    /// The table of objects.
    type Objects<T: Copy>: Store<T>;
    /// The tables of nodes and of placements.
    type Nodes<T: Copy>: Store<T>;
    /// The tables of materials, of textures and of lights.
    type Materials<T: Copy>: Store<T>;
    /// The table of vertices.
    type Points<T: Copy>: Store<T>;
}

/// Tables of fixed size, without a heap: so many objects; nodes and placements; materials,
/// textures and lights; vertices.
#[derive(Clone, Copy, Debug)]
pub struct Fixed<
    const OBJECTS: usize,
    const NODES: usize,
    const MATERIALS: usize,
    const POINTS: usize,
>;

impl<const O: usize, const N: usize, const M: usize, const P: usize> Storage for Fixed<O, N, M, P> {
    type Objects<T: Copy> = heapless::Vec<T, O>;
    type Nodes<T: Copy> = heapless::Vec<T, N>;
    type Materials<T: Copy> = heapless::Vec<T, M>;
    type Points<T: Copy> = heapless::Vec<T, P>;
}

/// A shape as people describe it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form<'a, S: Scalar> {
    /// A ball.
    Sphere {
        /// The middle.
        center: S::Vec3,
        /// The radius.
        radius: S,
    },
    /// The half-space `normal · p ≤ offset`.
    Plane {
        /// The outward normal, of any length but 0.
        normal: S::Vec3,
        /// `normal · p` for a point of the plane.
        offset: S,
    },
    /// A box along the axes.
    Box {
        /// The least coordinates.
        min: S::Vec3,
        /// The greatest coordinates.
        max: S::Vec3,
    },
    /// A cylinder between the middles of its caps.
    Cylinder {
        /// The middle of the lower cap.
        base: S::Vec3,
        /// The middle of the upper cap.
        top: S::Vec3,
        /// The radius.
        radius: S,
    },
    /// A cone or frustum between the middles of its caps.
    Cone {
        /// The middle of the lower cap.
        base: S::Vec3,
        /// The radius of the lower cap; may be 0.
        base_radius: S,
        /// The middle of the upper cap.
        top: S::Vec3,
        /// The radius of the upper cap; may be 0.
        top_radius: S,
    },
    /// A triangle, an open surface.
    Triangle {
        /// The corners, counterclockwise from outside.
        corners: [S::Vec3; 3],
        /// The normals that light sees at the corners, if the triangle is to look curved.
        normals: Option<[S::Vec3; 3]>,
    },
    /// A plane polygon, convex or not, an open surface.
    Polygon {
        /// The vertices, counterclockwise from outside.
        vertices: &'a [S::Vec3],
    },
}

/// A scene that is put together piece by piece.
///
/// Leaves and operators come in the order in which a tree is read: [`open`](Self::open) an
/// operator, give its operands, [`close`](Self::close) it. A leaf outside of any operator, and
/// an operator that is closed outside of any other, is an object.
#[derive(Clone, Debug)]
pub struct SceneBuilder<S: Scalar, M: Storage = Fixed<16, 64, 16, 64>> {
    /// The viewer.
    pub camera: Camera<S>,
    /// What lies behind everything.
    pub background: Background<S>,
    /// The light that is everywhere.
    pub ambient: Rgb<S>,
    nodes: M::Nodes<Node<S>>,
    placements: M::Nodes<Placement<S>>,
    objects: M::Objects<Object<S>>,
    materials: M::Materials<Material<S>>,
    textures: M::Materials<Texture<S>>,
    lights: M::Materials<Light<S>>,
    points: M::Points<S::Vec3>,
    open: heapless::Vec<u32, NESTING_MAX>,
    /// The entries of the tables that belong to finished objects.
    finished: Finished,
}

/// How long the tables were when the last object was finished.
#[derive(Clone, Copy, Debug, Default)]
struct Finished {
    nodes: usize,
    placements: usize,
    points: usize,
}

impl<S: Scalar, M: Storage> Default for SceneBuilder<S, M> {
    fn default() -> Self {
        Self::new()
    }
}

fn add<T: Copy>(
    store: &mut impl Store<T>,
    table: &'static str,
    entry: T,
) -> Result<u32, SceneError> {
    let index = store.entries().len() as u32;
    let full = SceneError::Full { table, capacity: store.capacity() as u32 };
    if store.push(entry) { Ok(index) } else { Err(full) }
}

fn add_narrow<T: Copy>(
    store: &mut impl Store<T>,
    table: &'static str,
    entry: T,
) -> Result<u16, SceneError> {
    let full = SceneError::Full { table, capacity: u32::from(u16::MAX) };
    if store.entries().len() >= usize::from(u16::MAX) {
        return Err(full);
    }
    u16::try_from(add(store, table, entry)?).map_err(|_| full)
}

impl<S: Scalar, M: Storage> SceneBuilder<S, M> {
    /// An empty scene: black, seen from (0, 0, 5) towards the origin at 40 degrees.
    pub fn new() -> Self {
        Self {
            camera: Camera {
                eye: S::Vec3::ZERO.with(Axis::Z, S::from_i32(5)),
                look_at: S::Vec3::ZERO,
                up: S::Vec3::ZERO.with(Axis::Y, S::ONE),
                projection: Projection::Pinhole { fov: S::from_i32(40) },
            },
            background: Background::Constant(Rgb::BLACK),
            ambient: Rgb::BLACK,
            nodes: Default::default(),
            placements: Default::default(),
            objects: Default::default(),
            materials: Default::default(),
            textures: Default::default(),
            lights: Default::default(),
            points: Default::default(),
            open: heapless::Vec::new(),
            finished: Finished::default(),
        }
    }

    /// Adds a material and gives its index.
    ///
    /// # Errors
    /// If there is no room for it.
    pub fn material(&mut self, material: Material<S>) -> Result<u16, SceneError> {
        add_narrow(&mut self.materials, "materials", material)
    }

    /// Adds a texture and gives its index. It may name the textures before it.
    ///
    /// # Errors
    /// If there is no room for it.
    pub fn texture(&mut self, texture: Texture<S>) -> Result<u16, SceneError> {
        add_narrow(&mut self.textures, "textures", texture)
    }

    /// Adds a light.
    ///
    /// # Errors
    /// If there is no room for it.
    pub fn light(&mut self, light: Light<S>) -> Result<(), SceneError> {
        add(&mut self.lights, "lights", light).map(|_| ())
    }

    /// Adds a placement for a texture, by the map from its coordinates to the scene's.
    ///
    /// # Errors
    /// If the map is singular, or if there is no room for it.
    pub fn placement(&mut self, to_world: &Affine<S>) -> Result<u16, SceneError> {
        let at = Item::Placement(self.placements.entries().len() as u32);
        let placement = Placement::new(to_world).ok_or(SceneError::SingularPlacement { at })?;
        let index = add_narrow(&mut self.placements, "placements", placement)?;
        // It belongs to no object, so no refused object may take it along.
        self.finished.placements = self.placements.entries().len();
        Ok(index)
    }

    /// Begins an operator; what follows until it is closed are its operands.
    ///
    /// # Errors
    /// If operators are nested too deeply, or if there is no room for it; then the object that
    /// it is a part of is taken back.
    pub fn open(&mut self, operator: Operator) -> Result<(), SceneError> {
        let at = Item::Node(self.nodes.entries().len() as u32);
        let deep = SceneError::TooDeep { at, limit: NESTING_MAX as u32 };
        let added = add(&mut self.nodes, "nodes", Node::Operator { operator, size: 0 });
        let opened = added.and_then(|index| self.open.push(index).map_err(|_| deep));
        opened.inspect_err(|_| self.take_back())
    }

    /// Ends the operator that was begun last. The object, if this is the end of one, is filled
    /// with the given material.
    ///
    /// # Errors
    /// If no operator is open, or if the finished object is not legal; then it is taken back.
    pub fn close(&mut self, material: u16) -> Result<(), SceneError> {
        let end = self.nodes.entries().len() as u32;
        let index = self.open.pop().ok_or(SceneError::Unbalanced { at: Item::Node(end) })?;
        if let Some(Node::Operator { size, .. }) = self.nodes.entries_mut().get_mut(index as usize)
        {
            *size = end - index;
        }
        self.finish_object(material)
    }

    /// Adds a shape, moved by an affine map.
    ///
    /// # Errors
    /// If a parameter is not legal, if the map is singular, or if there is no room for it;
    /// then the object that it is a part of is taken back.
    pub fn leaf(
        &mut self,
        form: Form<'_, S>,
        to_world: &Affine<S>,
        material: u16,
    ) -> Result<(), SceneError> {
        let added = self.realise(form, to_world).and_then(|(shape, placement)| {
            let leaf = Leaf { shape, material, placement };
            add(&mut self.nodes, "nodes", Node::Leaf(leaf))
        });
        if let Err(error) = added {
            self.take_back();
            return Err(error);
        }
        self.finish_object(material)
    }

    /// The checked scene.
    ///
    /// # Errors
    /// The first thing that is wrong with it.
    pub fn scene(&self) -> Result<Scene<'_, S>, SceneError> {
        if let Some(&node) = self.open.first() {
            return Err(SceneError::Unbalanced { at: Item::Node(node) });
        }
        Scene::new(self.parts())
    }

    fn parts(&self) -> Parts<'_, S> {
        Parts {
            nodes: self.nodes.entries(),
            objects: self.objects.entries(),
            materials: self.materials.entries(),
            textures: self.textures.entries(),
            lights: self.lights.entries(),
            placements: self.placements.entries(),
            points: self.points.entries(),
            camera: self.camera,
            background: self.background,
            ambient: self.ambient,
        }
    }

    /// Makes an object of the nodes since the last one, if no operator is open.
    fn finish_object(&mut self, material: u16) -> Result<(), SceneError> {
        if !self.open.is_empty() {
            return Ok(());
        }
        let (first, end) = (self.finished.nodes, self.nodes.entries().len());
        let mut object = Object::new(first as u32, (end - first) as u32, material);
        let index = self.objects.entries().len() as u32;
        let result = check_object(&self.parts(), index, &object).and_then(|needs| {
            let bounds = needs.bounds;
            let bounded = bounds != crate::bounds::Bounds::everywhere();
            object.bounds = (bounded && !self.culls_itself(&object)).then_some(bounds);
            add(&mut self.objects, "objects", object)
        });
        match result {
            Ok(_) => {
                self.finished = Finished {
                    nodes: end,
                    placements: self.placements.entries().len(),
                    points: self.points.entries().len(),
                };
                Ok(())
            }
            Err(error) => {
                self.take_back();
                Err(error)
            }
        }
    }

    /// A shape whose own test is as cheap as that of its bounds.
    fn culls_itself(&self, object: &Object<S>) -> bool {
        let node = self.nodes.entries().get(object.first as usize);
        matches!(node, Some(Node::Leaf(Leaf { shape: Shape::Plane(_), .. })))
            || matches!(
                node,
                Some(Node::Leaf(Leaf {
                    shape: Shape::Sphere(_) | Shape::Box(_),
                    placement: None,
                    ..
                }))
            )
    }

    /// Drops the object that is being put together, with its placements and vertices.
    fn take_back(&mut self) {
        self.nodes.truncate(self.finished.nodes);
        self.placements.truncate(self.finished.placements);
        self.points.truncate(self.finished.points);
        self.open.clear();
    }

    /// The shape and the placement that a form becomes, with its vertices in the table.
    fn realise(
        &mut self,
        form: Form<'_, S>,
        to_world: &Affine<S>,
    ) -> Result<(Shape<S>, Option<u16>), SceneError> {
        let at = Item::Node(self.nodes.entries().len() as u32);
        let singular = SceneError::SingularPlacement { at };
        let finite = to_world.rows.iter().chain([&to_world.offset]).all(|row| row.is_finite());
        if !finite {
            return Err(SceneError::NotFinite { at, field: "placement" });
        }
        let inverse = to_world.inverse_rows().ok_or(singular)?;
        match form {
            Form::Sphere { center, radius } => {
                let stand =
                    Stand::new(&Affine::translate(center).then(to_world)).ok_or(singular)?;
                let center = stand.centre();
                let shape = Shape::Sphere(Sphere { center, radius: radius * stand.factor });
                Ok((shape, self.stand(&stand)?))
            }
            Form::Plane { normal, offset } => {
                let normal = apply_transposed::<S>(&inverse, normal);
                let offset = offset + normal.dot(to_world.offset);
                Ok((Shape::Plane(Plane { normal, offset }), None))
            }
            Form::Box { min, max } => self.realise_box(min, max, to_world, singular),
            Form::Cylinder { base, top, radius } => {
                let (stand, half_height) = Stand::along(base, top, to_world, at)?;
                let shape = Cylinder {
                    center: stand.centre(),
                    half_height: half_height * stand.factor,
                    radius: radius * stand.factor,
                };
                Ok((Shape::Cylinder(shape), self.stand(&stand)?))
            }
            Form::Cone { base, base_radius, top, top_radius } => {
                let (stand, half_height) = Stand::along(base, top, to_world, at)?;
                let shape = Cone {
                    center: stand.centre(),
                    half_height: half_height * stand.factor,
                    base_radius: base_radius * stand.factor,
                    top_radius: top_radius * stand.factor,
                };
                Ok((Shape::Cone(shape), self.stand(&stand)?))
            }
            Form::Triangle { corners, normals } => {
                let mut indices = [0; 3];
                for (index, corner) in indices.iter_mut().zip(corners) {
                    *index = add(&mut self.points, "points", to_world.point(corner))?;
                }
                let first = self.points.entries().len() as u32;
                for normal in normals.iter().flatten() {
                    let normal = apply_transposed::<S>(&inverse, *normal).normalize();
                    add(&mut self.points, "points", normal)?;
                }
                let normals = if normals.is_some() { first } else { Triangle::FLAT };
                Ok((Shape::Triangle(Triangle { corners: indices, normals }), None))
            }
            Form::Polygon { vertices } => {
                let first = self.points.entries().len() as u32;
                for &vertex in vertices {
                    add(&mut self.points, "points", to_world.point(vertex))?;
                }
                let placed = self.points.entries().get(first as usize..).unwrap_or(&[]);
                let normal = Polygon::<S>::newell(placed);
                let count = placed.len() as u32;
                Ok((Shape::Polygon(Polygon { first, count, normal }), None))
            }
        }
    }

    fn realise_box(
        &mut self,
        min: S::Vec3,
        max: S::Vec3,
        to_world: &Affine<S>,
        singular: SceneError,
    ) -> Result<(Shape<S>, Option<u16>), SceneError> {
        let [x, y, z] = to_world.rows;
        let diagonal = x.with(Axis::X, S::ZERO) == S::Vec3::ZERO
            && y.with(Axis::Y, S::ZERO) == S::Vec3::ZERO
            && z.with(Axis::Z, S::ZERO) == S::Vec3::ZERO;
        if diagonal {
            let (a, b) = (to_world.point(min), to_world.point(max));
            // Only a mirror may swap the corners; a box that was empty or inverted stays so.
            let order = S::Vec3::new(x.x(), y.y(), z.z());
            let swap = |a: S::Vec3, b: S::Vec3| {
                let pick = |axis: Axis| {
                    if order.get(axis) < S::ZERO { b.get(axis) } else { a.get(axis) }
                };
                S::Vec3::new(pick(Axis::X), pick(Axis::Y), pick(Axis::Z))
            };
            return Ok((Shape::Box(Cuboid { min: swap(a, b), max: swap(b, a) }), None));
        }
        let centre = (min + max) * S::HALF;
        let half = (max - min) * S::HALF;
        let stand = Stand::new(&Affine::translate(centre).then(to_world)).ok_or(singular)?;
        let half = half * stand.factor;
        let placement = Placement::new(&stand.to_world).ok_or(singular)?;
        let index = add_narrow(&mut self.placements, "placements", placement)?;
        Ok((Shape::Box(Cuboid { min: -half, max: half }), Some(index)))
    }

    /// The placement of a stand that needs one.
    fn stand(&mut self, stand: &Stand<S>) -> Result<Option<u16>, SceneError> {
        if stand.is_upright() {
            return Ok(None);
        }
        let at = Item::Node(self.nodes.entries().len() as u32);
        let placement =
            Placement::new(&stand.to_world).ok_or(SceneError::SingularPlacement { at })?;
        add_narrow(&mut self.placements, "placements", placement).map(Some)
    }
}

/// Where a centred shape stands: a map without the factor of a similarity, which goes into
/// the shape's lengths instead.
struct Stand<S: Scalar> {
    to_world: Affine<S>,
    factor: S,
}

impl<S: Scalar> Stand<S> {
    fn new(to_world: &Affine<S>) -> Option<Self> {
        to_world.inverse_rows()?;
        let Some(factor) = to_world.similarity() else {
            return Some(Self { to_world: *to_world, factor: S::ONE });
        };
        let inverse = S::ONE / factor;
        let rows =
            if factor == S::ONE { to_world.rows } else { to_world.rows.map(|row| row * inverse) };
        Some(Self { to_world: Affine { rows, offset: to_world.offset }, factor })
    }

    /// The stand of a body whose local y axis goes from `base` to `top`, and half its height.
    fn along(
        base: S::Vec3,
        top: S::Vec3,
        to_world: &Affine<S>,
        at: Item,
    ) -> Result<(Self, S), SceneError> {
        let axis = top - base;
        if !axis.is_finite() {
            return Err(SceneError::NotFinite { at, field: "base" });
        }
        let length = axis.length();
        if !(length >= S::LENGTH_MIN) {
            return Err(SceneError::Empty { at, field: "top" });
        }
        let unit = axis.normalize();
        let upright = unit == S::Vec3::ZERO.with(Axis::Y, S::ONE);
        let rows = if upright {
            Affine::<S>::identity().rows
        } else {
            let (w, u) = unit.basis();
            Axis::ALL.map(|axis| S::Vec3::new(u.get(axis), unit.get(axis), w.get(axis)))
        };
        let own = Affine { rows, offset: (base + top) * S::HALF };
        let stand = Self::new(&own.then(to_world)).ok_or(SceneError::SingularPlacement { at })?;
        Ok((stand, length * S::HALF))
    }

    fn is_upright(&self) -> bool {
        self.to_world.rows == Affine::<S>::identity().rows
    }

    /// The centre that the shape itself has: its place if it stands upright.
    fn centre(&self) -> S::Vec3 {
        if self.is_upright() { self.to_world.offset } else { S::Vec3::ZERO }
    }
}

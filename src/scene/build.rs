//! Scenes put together at run time, in tables of fixed size.

mod form;
mod paint;
mod realise;

pub use form::{Corners, Form, Heights, Metaball, Profile, Triangles};

use super::check::check_object;
use super::{Object, Parts, Scene};
use crate::background::Background;
use crate::camera::{Camera, Projection};
use crate::color::Rgb;
use crate::error::{Item, SceneError};
use crate::hierarchy::Branch;
use crate::light::Light;
use crate::material::Material;
use crate::place::{Affine, Placement};
use crate::scalar::{Axis, Scalar, Vector};
use crate::shape::{Shape, Tables};
use crate::solid::{Leaf, NESTING_MAX, Node};
use crate::span::Operator;
use crate::texture::{Channel, Image, Stop, Texture};

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
    /// The tables of materials, of textures with their images and channels, and of lights.
    type Materials<T: Copy>: Store<T>;
    /// The tables of vertices and of the stops of colour ramps.
    type Points<T: Copy>: Store<T>;
    /// The tables of numbers, of indices and of programs, for solids of many parts.
    type Data<T: Copy>: Store<T>;
    /// The bytes of images.
    type Pixels<T: Copy>: Store<T>;
    /// The table of branches of hierarchies.
    type Branches<T: Copy>: Store<T>;
}

/// Tables of fixed size, without a heap: so many objects; nodes and placements; materials,
/// textures with their images and channels, and lights; vertices and stops of ramps; numbers, indices
/// and bytes of programs; bytes of images; branches of hierarchies.
#[derive(Clone, Copy, Debug)]
pub struct Fixed<
    const OBJECTS: usize,
    const NODES: usize,
    const MATERIALS: usize,
    const POINTS: usize,
    const DATA: usize = 0,
    const PIXELS: usize = 0,
    const BRANCHES: usize = 0,
>;

impl<
    const O: usize,
    const N: usize,
    const M: usize,
    const P: usize,
    const D: usize,
    const X: usize,
    const B: usize,
> Storage for Fixed<O, N, M, P, D, X, B>
{
    type Objects<T: Copy> = heapless::Vec<T, O>;
    type Nodes<T: Copy> = heapless::Vec<T, N>;
    type Materials<T: Copy> = heapless::Vec<T, M>;
    type Points<T: Copy> = heapless::Vec<T, P>;
    type Data<T: Copy> = heapless::Vec<T, D>;
    type Pixels<T: Copy> = heapless::Vec<T, X>;
    type Branches<T: Copy> = heapless::Vec<T, B>;
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
    stops: M::Points<Stop<S>>,
    images: M::Materials<Image>,
    pixels: M::Pixels<u8>,
    channels: M::Materials<Channel<S>>,
    lights: M::Materials<Light<S>>,
    points: M::Points<S::Vec3>,
    numbers: M::Data<S>,
    indices: M::Data<u32>,
    code: M::Data<u8>,
    branches: M::Branches<Branch<S>>,
    open: heapless::Vec<u32, NESTING_MAX>,
    /// The entries of the tables that belong to finished objects.
    finished: Finished,
}

/// How long the tables were when the last object was finished.
#[derive(Clone, Copy, Debug, Default)]
struct Finished {
    nodes: u32,
    placements: u32,
    points: u32,
    numbers: u32,
    indices: u32,
    code: u32,
    branches: u32,
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
            stops: Default::default(),
            images: Default::default(),
            pixels: Default::default(),
            channels: Default::default(),
            lights: Default::default(),
            points: Default::default(),
            numbers: Default::default(),
            indices: Default::default(),
            code: Default::default(),
            branches: Default::default(),
            open: heapless::Vec::new(),
            finished: Finished::default(),
        }
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
        self.finished.placements = self.placements.entries().len() as u32;
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
            stops: self.stops.entries(),
            images: self.images.entries(),
            pixels: self.pixels.entries(),
            channels: self.channels.entries(),
            lights: self.lights.entries(),
            placements: self.placements.entries(),
            tables: Tables {
                points: self.points.entries(),
                numbers: self.numbers.entries(),
                indices: self.indices.entries(),
                code: self.code.entries(),
                branches: self.branches.entries(),
            },
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
        let (first, end) = (self.finished.nodes, self.nodes.entries().len() as u32);
        let mut object = Object::new(first, end - first, material);
        let index = self.objects.entries().len() as u32;
        let result = check_object::<S, { crate::needs::ALL }>(&self.parts(), index, &object)
            .and_then(|needs| {
                let bounds = needs.bounds;
                let bounded = bounds != crate::bounds::Bounds::everywhere();
                object.bounds = (bounded && !self.culls_itself(&object)).then_some(bounds);
                add(&mut self.objects, "objects", object)
            });
        match result {
            Ok(_) => {
                self.finished = Finished {
                    nodes: end,
                    placements: self.placements.entries().len() as u32,
                    points: self.points.entries().len() as u32,
                    numbers: self.numbers.entries().len() as u32,
                    indices: self.indices.entries().len() as u32,
                    code: self.code.entries().len() as u32,
                    branches: self.branches.entries().len() as u32,
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
        self.nodes.truncate(self.finished.nodes as usize);
        self.placements.truncate(self.finished.placements as usize);
        self.points.truncate(self.finished.points as usize);
        self.numbers.truncate(self.finished.numbers as usize);
        self.indices.truncate(self.finished.indices as usize);
        self.code.truncate(self.finished.code as usize);
        self.branches.truncate(self.finished.branches as usize);
        self.open.clear();
    }
}

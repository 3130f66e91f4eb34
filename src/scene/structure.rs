//! What can be checked of a scene without computing with its numbers, so that a `static`
//! scene that is put together wrongly does not compile.

use super::Object;
use crate::error::{Item, SceneError};
use crate::scalar::Scalar;
use crate::shape::Shape;
use crate::solid::{Leaf, NESTING_MAX, Node};
use crate::span::Operator;

/// What the solids of a scene need, known from how they are put together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Structure {
    /// The boundaries that the evaluation of one solid may hold at a time: the room that
    /// [`Render`](crate::render::Render) needs. A mesh that is an object of its own needs no
    /// list, and neither do patches.
    pub boundaries: u32,
    /// The surfaces that a ray can go through at most, all objects together.
    pub crossings: u32,
}

/// Checks how the solids of a scene are put together: that each object is exactly one tree,
/// that operators have the operands and the size they state, that open surfaces stand only where no
/// inside is needed, and that materials and placements exist.
///
/// It can run at compile time:
///
/// ```
/// use nostray::glam::Vec3;
/// use nostray::scene::{Structure, structure};
/// use nostray::*;
///
/// const fn ball(x: f32) -> Node<f32> {
///     let sphere = Sphere { center: Vec3::new(x, 0.0, 0.0), radius: 1.0 };
///     Node::Leaf(Leaf { shape: Shape::Sphere(sphere), material: 0, placement: None })
/// }
///
/// static NODES: [Node<f32>; 4] = [
///     ball(-3.0),
///     Node::Operator { operator: Operator::Difference, size: 3 },
///     ball(0.0),
///     ball(0.5),
/// ];
/// static OBJECTS: [Object<f32>; 2] = [Object::new(0, 1, 0), Object::new(1, 3, 0)];
/// static MATERIALS: [Material<f32>; 1] =
///     [Material { color: Paint::Solid(Rgb::new(0.9, 0.2, 0.1)), ..Material::PLAIN }];
///
/// // A wrong size, a missing material or an operator without operands would not compile.
/// const NEEDS: Structure = match structure(&NODES, &OBJECTS, MATERIALS.len(), 0) {
///     Ok(needs) => needs,
///     Err(_) => panic!("the scene is put together wrongly"),
/// };
///
/// // The numbers are checked when the scene is made.
/// let scene = Scene::new(Parts {
///     nodes: &NODES,
///     objects: &OBJECTS,
///     materials: &MATERIALS,
///     ambient: Rgb::WHITE,
///     ..Parts::seen_by(Camera::pinhole(Vec3::new(0.0, 0.0, 5.0), Vec3::ZERO, Vec3::Y, 40.0))
/// })?;
/// let render: Render<f32, 1, { NEEDS.boundaries as usize }> =
///     Render::new(&scene, 8, 8, Depth::fixed(0))?;
/// assert_eq!(render.count(), 64);
/// # Ok::<(), SceneError>(())
/// ```
///
/// ```compile_fail,E0080
/// use nostray::scene::structure;
/// use nostray::*;
///
/// static NODES: [Node<f32>; 1] = [Node::Operator { operator: Operator::Union, size: 1 }];
/// const _: () = assert!(structure(&NODES, &[Object::new(0, 1, 0)], 1, 0).is_ok());
/// ```
///
/// # Errors
/// The first thing that is wrong, with its place.
pub const fn structure<S: Scalar>(
    nodes: &[Node<S>],
    mut objects: &[Object<S>],
    materials: usize,
    placements: usize,
) -> Result<Structure, SceneError> {
    let mut all = Structure { boundaries: 0, crossings: 0 };
    let mut index = 0;
    while let Some((object, rest)) = objects.split_first() {
        match object_structure(nodes, index, object, materials, placements) {
            Ok(needs) => {
                if needs.boundaries > all.boundaries {
                    all.boundaries = needs.boundaries;
                }
                all.crossings = all.crossings.saturating_add(needs.crossings);
            }
            Err(error) => return Err(error),
        }
        objects = rest;
        index += 1;
    }
    Ok(all)
}

/// An operator whose operands are being counted.
#[derive(Clone, Copy)]
struct Open {
    operator: Operator,
    node: u32,
    end: u32,
    operands: u32,
}

/// The operators around the node that is looked at, outermost first.
struct Nest {
    open: [Open; NESTING_MAX],
    depth: usize,
}

impl Nest {
    const fn innermost(&mut self) -> Option<&mut Open> {
        match self.open.split_at_mut_checked(self.depth) {
            Some((open, _)) => open.last_mut(),
            None => None,
        }
    }

    /// Adds an operator; false where there is no room.
    const fn push(&mut self, opened: Open) -> bool {
        match self.open.split_at_mut_checked(self.depth) {
            Some((_, [slot, ..])) => {
                *slot = opened;
                self.depth += 1;
                true
            }
            _ => false,
        }
    }

    /// The outermost operator that needs an inside.
    const fn closed_operator(&self) -> Option<Operator> {
        let mut open: &[Open] = match self.open.split_at_checked(self.depth) {
            Some((open, _)) => open,
            None => &[],
        };
        while let Some((first, rest)) = open.split_first() {
            if !matches!(first.operator, Operator::Union) {
                return Some(first.operator);
            }
            open = rest;
        }
        None
    }

    /// Counts a finished operand, and every operator that ends with it as one of the next; true
    /// when none is left open.
    const fn finish(&mut self, end: u32) -> Result<bool, SceneError> {
        while let Some(inner) = self.innermost() {
            inner.operands = inner.operands.saturating_add(1);
            if inner.end > end {
                return Ok(false);
            }
            if let (Operator::Complement, 2..) = (inner.operator, inner.operands) {
                return Err(SceneError::OperandOverflow { at: Item::Node(inner.node), most: 1 });
            }
            self.depth -= 1;
        }
        Ok(true)
    }
}

/// Checks the tree of one object.
pub(super) const fn object_structure<S: Scalar>(
    nodes: &[Node<S>],
    index: u32,
    object: &Object<S>,
    materials: usize,
    placements: usize,
) -> Result<Structure, SceneError> {
    let at = Item::Object(index);
    if let Err(error) = check_index(at, "materials", object.material, materials) {
        return Err(error);
    }
    let mut rest = match run(nodes, object) {
        Some(run) => run,
        None => {
            let index = object.first.saturating_add(object.count);
            let len = nodes.len() as u32;
            return Err(SceneError::IndexOutOfRange { at, table: "nodes", index, len });
        }
    };
    let end = object.first + object.count;
    let vacant = Open { operator: Operator::Union, node: 0, end: 0, operands: 0 };
    let mut nest = Nest { open: [vacant; NESTING_MAX], depth: 0 };
    let (mut node, mut finished) = (object.first, false);
    let (mut crossings, mut operators, mut listed) = (0_u32, false, true);
    while let Some((next, further)) = rest.split_first() {
        if finished {
            return Err(SceneError::StrayNodes { at, node });
        }
        match next {
            Node::Operator { operator, size } => {
                operators = true;
                let limit = match nest.innermost() {
                    Some(outer) => outer.end,
                    None => end,
                };
                if let Err(error) = open(&mut nest, node, limit, *operator, *size) {
                    return Err(error);
                }
            }
            Node::Leaf(leaf) => {
                let (from, operator) = (Item::Node(node), nest.closed_operator());
                if let Err(error) = check_leaf(from, leaf, operator, [materials, placements]) {
                    return Err(error);
                }
                crossings = crossings.saturating_add(leaf.shape.boundaries_max());
                listed = !matches!(leaf.shape, Shape::Mesh(_) | Shape::Patches(_));
                finished = match nest.finish(node + 1) {
                    Ok(finished) => finished,
                    Err(error) => return Err(error),
                };
            }
        }
        node += 1;
        rest = further;
    }
    if !finished {
        return Err(SceneError::StrayNodes { at, node });
    }
    let needed = room(crossings, operators, listed);
    let limit = u16::MAX as u32;
    if needed > limit {
        return Err(SceneError::SpanOverflow { at, needed, limit });
    }
    Ok(Structure { boundaries: needed, crossings })
}

/// The boundaries that the lists of an object may hold, of so many that there may be. A merge reads two lists
/// and writes a third that is no longer than both; the others wait. A mesh that stands alone is not
/// listed, but searched for one boundary at a time, and so are patches.
const fn room(crossings: u32, operators: bool, listed: bool) -> u32 {
    match (operators, listed) {
        (true, _) => crossings.saturating_mul(2),
        (false, true) => crossings,
        (false, false) => 2,
    }
}

/// Checks the indices of a leaf, into tables of these lengths, and whether it may be an open
/// surface under the operator that needs an inside, if there is one.
const fn check_leaf<S: Scalar>(
    at: Item,
    leaf: &Leaf<S>,
    operator: Option<Operator>,
    [materials, placements]: [usize; 2],
) -> Result<(), SceneError> {
    if let Err(error) = check_index(at, "materials", leaf.material, materials) {
        return Err(error);
    }
    if let Some(placement) = leaf.placement
        && let Err(error) = check_index(at, "placements", placement, placements)
    {
        return Err(error);
    }
    match operator {
        Some(operator) if leaf.shape.is_open() => Err(SceneError::OpenSurface { at, operator }),
        _ => Ok(()),
    }
}

/// The nodes of an object, or `None` beyond the end of the table.
const fn run<'a, S: Scalar>(nodes: &'a [Node<S>], object: &Object<S>) -> Option<&'a [Node<S>]> {
    let Some((_, rest)) = nodes.split_at_checked(object.first as usize) else {
        return None;
    };
    match rest.split_at_checked(object.count as usize) {
        Some((run, _)) => Some(run),
        None => None,
    }
}

const fn open(
    nest: &mut Nest,
    node: u32,
    limit: u32,
    operator: Operator,
    size: u32,
) -> Result<(), SceneError> {
    let at = Item::Node(node);
    let end = match node.checked_add(size) {
        Some(end) if size > 0 && end <= limit => end,
        _ => return Err(SceneError::OperatorSize { at, size }),
    };
    if size == 1 {
        return Err(SceneError::OperandUnderflow { at, operands: 0, least: 1 });
    }
    if nest.push(Open { operator, node, end, operands: 0 }) {
        Ok(())
    } else {
        Err(SceneError::TooDeep { at, limit: NESTING_MAX as u32 })
    }
}

const fn check_index(
    at: Item,
    table: &'static str,
    index: u16,
    len: usize,
) -> Result<(), SceneError> {
    let (index, len) = (index as u32, len as u32);
    if index < len { Ok(()) } else { Err(SceneError::IndexOutOfRange { at, table, index, len }) }
}

//! The solids of a document, node by node into a scene builder.

use std::collections::HashMap;

use nostray::{Affine, Form, Operator, Scalar, SceneBuilder, SceneError, Vector};

use crate::document::{Object, Solid};
use crate::flaw::{Flaw, Path};
use crate::forms::Stock;
use crate::heap::Heap;
use crate::moves::{compose, converted};
use crate::origin::Origins;

/// Adds solids to a scene, and remembers where the nodes of the current one came from.
pub(crate) struct Planter<'a, S: Scalar> {
    builder: &'a mut SceneBuilder<S, Heap>,
    /// The materials by name; without them every name stands for material 0.
    materials: Option<&'a HashMap<&'a str, u16>>,
    /// The paths of the nodes of the object that is being added.
    nodes: Vec<String>,
    /// The nodes of the objects before it.
    before: u32,
}

/// What a node inherits from those around it.
#[derive(Clone, Copy)]
struct Around<'a> {
    to_world: &'a Affine<f64>,
    material: Option<u16>,
    /// What fills the object.
    fill: u16,
}

impl<'a, S: Scalar> Planter<'a, S> {
    pub(crate) fn new(
        builder: &'a mut SceneBuilder<S, Heap>,
        materials: Option<&'a HashMap<&'a str, u16>>,
    ) -> Self {
        Self { builder, materials, nodes: Vec::new(), before: 0 }
    }

    /// Adds one object.
    pub(crate) fn object(&mut self, object: &Object, path: &Path<'_>) -> Result<(), Flaw> {
        let to_world = compose(&object.place, &path.field("place"))?;
        let named = match &object.material {
            Some(name) => Some(self.material(name, &path.field("material"))?),
            None => None,
        };
        self.plant(&object.solid, &to_world, named, &path.field("solid"))
    }

    /// Adds a solid with a placement and, unless it brings its own, a material.
    pub(crate) fn plant(
        &mut self,
        solid: &Solid,
        to_world: &Affine<f64>,
        material: Option<u16>,
        path: &Path<'_>,
    ) -> Result<(), Flaw> {
        let first = first_material(solid);
        // A name that is unknown is told at its place, when the walk comes there.
        let first_index = first.and_then(|name| self.index_of(name));
        let fill = match material {
            Some(material) => material,
            None if first.is_none() => return Err(Flaw::new(path, "has no material")),
            None => first_index.unwrap_or(0),
        };
        let around = Around { to_world, material, fill };
        // A leaf of its own object is filled with what covers it; two materials need a node more.
        let wrapped = is_leaf(solid) && first_index.is_some_and(|index| index != fill);
        if wrapped {
            self.open(Operator::Union, path)?;
        }
        self.node(solid, around, path)?;
        if wrapped {
            self.close(around, path)?;
        }
        self.before += self.nodes.len() as u32;
        self.nodes.clear();
        Ok(())
    }

    fn node(&mut self, solid: &Solid, around: Around<'_>, path: &Path<'_>) -> Result<(), Flaw> {
        match solid {
            Solid::With { solid, material, place } => {
                let path = path.field("With");
                let own = compose(place, &path.field("place"))?;
                let material = match material {
                    Some(name) => Some(self.material(name, &path.field("material"))?),
                    None => around.material,
                };
                let to_world = own.then(around.to_world);
                let inside = Around { to_world: &to_world, material, ..around };
                self.node(solid, inside, &path.field("solid"))
            }
            Solid::Union(operands) => self.operator(Operator::Union, operands, around, path),
            Solid::Intersection(operands) => {
                self.operator(Operator::Intersection, operands, around, path)
            }
            Solid::Difference(operands) => {
                self.operator(Operator::Difference, operands, around, path)
            }
            Solid::Xor(operands) => self.operator(Operator::Xor, operands, around, path),
            Solid::Complement(operand) => {
                self.open(Operator::Complement, &path.field("Complement"))?;
                self.node(operand, around, &path.field("Complement"))?;
                self.close(around, path)
            }
            leaf => self.leaf(leaf, around, path),
        }
    }

    fn operator(
        &mut self,
        operator: Operator,
        operands: &[Solid],
        around: Around<'_>,
        path: &Path<'_>,
    ) -> Result<(), Flaw> {
        let name = format!("{operator:?}");
        let path = path.field(&name);
        self.open(operator, &path)?;
        for (index, operand) in operands.iter().enumerate() {
            self.node(operand, around, &path.entry(index))?;
        }
        self.close(around, &path)
    }

    fn open(&mut self, operator: Operator, path: &Path<'_>) -> Result<(), Flaw> {
        self.nodes.push(path.to_string());
        self.builder.open(operator).map_err(|error| self.flaw(&error, path))
    }

    fn close(&mut self, around: Around<'_>, path: &Path<'_>) -> Result<(), Flaw> {
        self.builder.close(around.fill).map_err(|error| self.flaw(&error, path))
    }

    fn leaf(&mut self, leaf: &Solid, around: Around<'_>, path: &Path<'_>) -> Result<(), Flaw> {
        let mut stock = Stock::default();
        let (name, form) = stock.form(leaf, path)?;
        let path = path.field(name);
        let material = around.material.ok_or_else(|| Flaw::new(path, "has no material"))?;
        self.check_reach(&form, around.to_world, &path)?;
        self.nodes.push(path.to_string());
        let added = self.builder.leaf(form, &converted(around.to_world), material);
        added.map_err(|error| self.flaw(&error, &path))
    }

    /// A point of the shape must still be in the legal range when it is placed.
    fn check_reach(
        &self,
        form: &Form<'_, S>,
        to_world: &Affine<f64>,
        path: &Path<'_>,
    ) -> Result<(), Flaw> {
        let point = match *form {
            Form::Sphere { center, .. } => center,
            Form::Box { min, .. } | Form::Implicit { min, .. } => min,
            Form::Cylinder { base, .. } | Form::Cone { base, .. } => base,
            _ => S::Vec3::ZERO,
        };
        let point = <f64 as Scalar>::Vec3::from_array(point.to_array().map(S::to_f64));
        // What is not a number is left to the check of the shape itself.
        if point.is_finite() && to_world.point(point).max_abs() > S::COORD_MAX.to_f64() {
            return Err(Flaw::new(path, "is placed beyond the range of this number format"));
        }
        Ok(())
    }

    fn material(&self, name: &str, path: &Path<'_>) -> Result<u16, Flaw> {
        let unknown = || Flaw::new(path, format!("there is no material {name:?}"));
        self.index_of(name).ok_or_else(unknown)
    }

    fn index_of(&self, name: &str) -> Option<u16> {
        match self.materials {
            None => Some(0),
            Some(materials) => materials.get(name).copied(),
        }
    }

    /// An error of the builder, told by the path of the node that it names.
    fn flaw(&self, error: &SceneError, path: &Path<'_>) -> Flaw {
        let node = Origins::node_of(error).and_then(|node| node.checked_sub(self.before));
        match node.and_then(|node| self.nodes.get(node as usize)) {
            Some(path) => Origins::at(error, path),
            None => Origins::at(error, path),
        }
    }
}

/// The name of the material of the first leaf, if it brings its own.
fn first_material(mut solid: &Solid) -> Option<&str> {
    let mut found = None;
    loop {
        solid = match solid {
            Solid::With { solid, material, .. } => {
                found = material.as_deref().or(found);
                solid
            }
            Solid::Union(operands)
            | Solid::Intersection(operands)
            | Solid::Difference(operands)
            | Solid::Xor(operands) => match operands.first() {
                Some(first) => first,
                None => return found,
            },
            Solid::Complement(operand) => operand,
            _ => return found,
        };
    }
}

/// It is one shape, whatever its material and place.
fn is_leaf(mut solid: &Solid) -> bool {
    while let Solid::With { solid: inner, .. } = solid {
        solid = inner;
    }
    !matches!(
        solid,
        Solid::Union(_)
            | Solid::Intersection(_)
            | Solid::Difference(_)
            | Solid::Xor(_)
            | Solid::Complement(_)
    )
}

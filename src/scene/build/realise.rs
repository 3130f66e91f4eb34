//! From a shape as people describe it to the shape that is stored, and its placement.

mod blob;
mod flat;
mod heights;
mod implicit;
mod mesh;
mod outline;
mod patches;
mod quadric;
mod torus;

use implicit::Formula;

use super::{Form, SceneBuilder, Storage, Store, add_narrow};
use crate::error::{Item, SceneError};
use crate::place::{Affine, Placement, Rows, apply_transposed};
use crate::scalar::{Axis, Number, Scalar, Vector};
use crate::shape::{Cone, Cuboid, Cylinder, Plane, Shape, Sphere};
use mesh::Site;

impl<S: Scalar, M: Storage> SceneBuilder<S, M> {
    /// The shape and the placement that a form becomes, with its vertices in the table.
    pub(super) fn realise(
        &mut self,
        form: Form<'_, S>,
        to_world: &Affine<S>,
    ) -> Result<(Shape<S>, Option<u16>), SceneError> {
        let at = Item::Node(self.nodes.entries().len() as u32);
        let singular = SceneError::SingularPlacement { at };
        if !to_world.is_finite() {
            return Err(SceneError::NotFinite { at, field: "placement" });
        }
        let inverse = to_world.inverse_rows().ok_or(singular)?;
        let site = Site { to_world, inverse: &inverse, at };
        match form {
            Form::Sphere { center, radius } => {
                let stand =
                    Stand::new(&Affine::translate(center).then(to_world)).ok_or(singular)?;
                let center = stand.centre();
                let shape = Shape::Sphere(Sphere { center, radius: stand.scaled(radius) });
                Ok((shape, self.stand(&stand)?))
            }
            Form::Plane { normal, offset } => Ok((plane(normal, offset, &site), None)),
            Form::Box { min, max } => self.realise_box(min, max, to_world, singular),
            Form::Cylinder { base, top, radius } => {
                let (stand, half_height) = Stand::along(base, top, to_world, at)?;
                let shape = Cylinder {
                    center: stand.centre(),
                    half_height: S::narrow(half_height * stand.factor),
                    radius: stand.scaled(radius),
                };
                Ok((Shape::Cylinder(shape), self.stand(&stand)?))
            }
            Form::Cone { base, base_radius, top, top_radius } => {
                let (stand, half_height) = Stand::along(base, top, to_world, at)?;
                let shape = Cone {
                    center: stand.centre(),
                    half_height: S::narrow(half_height * stand.factor),
                    base_radius: stand.scaled(base_radius),
                    top_radius: stand.scaled(top_radius),
                };
                Ok((Shape::Cone(shape), self.stand(&stand)?))
            }
            Form::Torus { center, axis, major, minor } => {
                self.realise_torus([center, axis], [major, minor], to_world)
            }
            Form::Lathe { center, profile } => self.realise_lathe(center, profile, to_world),
            Form::Prism { vertices, height } => self.realise_prism(vertices, height, to_world),
            Form::Quadric { center, squares, products, linear, constant } => {
                self.realise_quadric(center, [squares, products, linear], constant, to_world)
            }
            Form::Triangle { corners, normals } => {
                Ok((self.realise_triangle(corners, normals, to_world, &inverse)?, None))
            }
            Form::Polygon { vertices } => Ok((self.realise_polygon(vertices, to_world)?, None)),
            Form::Implicit { min, max, code, numbers, spans } => {
                let formula = Formula { corners: [min, max], code, numbers, spans };
                self.realise_implicit(&formula, to_world)
            }
            Form::Blob { threshold, components } => {
                self.realise_blob(threshold, components, to_world)
            }
            Form::Mesh(form) => Ok((self.realise_mesh(&form, site)?, None)),
            Form::HeightField(form) => Ok((self.realise_heights(&form, site)?, None)),
            Form::Patches { points, patches } => self.realise_patches(points, patches, to_world),
            Form::Spline { points, columns, closed } => {
                self.realise_spline(points, columns, closed, to_world)
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
        let (zero, origin) = (S::Wide::ZERO, S::WideVec::ZERO);
        let diagonal = x.with(Axis::X, zero) == origin
            && y.with(Axis::Y, zero) == origin
            && z.with(Axis::Z, zero) == origin;
        if diagonal {
            let (a, b) = (to_world.point(min), to_world.point(max));
            // Only a mirror may swap the corners; a box that was empty or inverted stays so.
            let order = S::WideVec::new(x.x(), y.y(), z.z());
            let swap = |a: S::Vec3, b: S::Vec3| {
                let pick = |axis: Axis| {
                    if order.get(axis) < zero { b.get(axis) } else { a.get(axis) }
                };
                S::Vec3::new(pick(Axis::X), pick(Axis::Y), pick(Axis::Z))
            };
            return Ok((Shape::Box(Cuboid { min: swap(a, b), max: swap(b, a) }), None));
        }
        let centre = (min + max) * S::HALF;
        let half = (max - min) * S::HALF;
        let stand = Stand::new(&Affine::translate(centre).then(to_world)).ok_or(singular)?;
        let half = half.map(|v| stand.scaled(v));
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

/// A half-space in the scene.
fn plane<S: Scalar>(normal: S::Vec3, offset: S, site: &Site<'_, S>) -> Shape<S> {
    let normal = apply_transposed::<S>(site.inverse, S::widen_vec(normal));
    let offset = offset.widen() + normal.dot(site.to_world.offset);
    let (normal, offset) = S::plane(normal, offset);
    Shape::Plane(Plane { normal, offset })
}

/// The rows of a rotation of the local y axis into a direction that is not zero.
fn turned_to<S: Scalar>(axis: S::WideVec) -> Rows<S> {
    let unit = axis.normalize();
    if unit == S::WideVec::ZERO.with(Axis::Y, S::Wide::ONE) {
        return Affine::<S>::identity().rows;
    }
    let (w, u) = unit.basis();
    Axis::ALL.map(|axis| S::WideVec::new(u.get(axis), unit.get(axis), w.get(axis)))
}

/// Where a centred shape stands: a map without the factor of a similarity, which goes into
/// the shape's lengths instead.
struct Stand<S: Scalar> {
    to_world: Affine<S>,
    factor: S::Wide,
}

impl<S: Scalar> Stand<S> {
    fn new(to_world: &Affine<S>) -> Option<Self> {
        to_world.inverse_rows()?;
        let Some(factor) = to_world.similarity() else {
            return Some(Self { to_world: *to_world, factor: S::Wide::ONE });
        };
        let inverse = S::Wide::ONE / factor;
        let rows = if factor == S::Wide::ONE {
            to_world.rows
        } else {
            to_world.rows.map(|row| row * inverse)
        };
        Some(Self { to_world: Affine { rows, offset: to_world.offset }, factor })
    }

    /// The stand of a body whose local y axis goes from `base` to `top`, and half its height.
    fn along(
        base: S::Vec3,
        top: S::Vec3,
        to_world: &Affine<S>,
        at: Item,
    ) -> Result<(Self, S::Wide), SceneError> {
        let axis = S::widen_vec(top) - S::widen_vec(base);
        if !axis.is_finite() {
            return Err(SceneError::NotFinite { at, field: "base" });
        }
        let length = axis.length();
        if !(length >= S::LENGTH_MIN.widen()) {
            return Err(SceneError::Empty { at, field: "top" });
        }
        let middle = (S::widen_vec(base) + S::widen_vec(top)) * S::Wide::HALF;
        let own = Affine { rows: turned_to::<S>(axis), offset: middle };
        let stand = Self::new(&own.then(to_world)).ok_or(SceneError::SingularPlacement { at })?;
        Ok((stand, length * S::Wide::HALF))
    }

    /// The stand of a body in a place whose local y axis has a direction.
    fn around(
        center: S::Vec3,
        axis: S::Vec3,
        to_world: &Affine<S>,
        at: Item,
    ) -> Result<Self, SceneError> {
        let axis = S::widen_vec(axis);
        if !axis.is_finite() {
            return Err(SceneError::NotFinite { at, field: "axis" });
        }
        if !(axis.length() >= S::LENGTH_MIN.widen()) {
            return Err(SceneError::Empty { at, field: "axis" });
        }
        let own = Affine { rows: turned_to::<S>(axis), offset: S::widen_vec(center) };
        Self::new(&own.then(to_world)).ok_or(SceneError::SingularPlacement { at })
    }

    /// A length of the shape, as it is in the scene.
    fn scaled(&self, length: S) -> S {
        S::narrow(length.widen() * self.factor)
    }

    fn is_upright(&self) -> bool {
        self.to_world.rows == Affine::<S>::identity().rows
    }

    /// The centre that the shape itself has: its place if it stands upright.
    fn centre(&self) -> S::Vec3 {
        if self.is_upright() { S::narrow_vec(self.to_world.offset) } else { S::Vec3::ZERO }
    }
}

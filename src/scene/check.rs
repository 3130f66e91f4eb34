//! The one place where a scene is checked; after it nothing can fail.

mod texture;

use super::structure::{Structure, object_structure};
use super::{Limits, Object, Parts};
use crate::background::Background;
use crate::bounds::Bounds;
use crate::color::Rgb;
use crate::error::{Item, SceneError};
use crate::light::{Attenuation, Light};
use crate::material::{Fresnel, Material};
use crate::needs::{self, has};
use crate::place::{Placement, apply};
use crate::scalar::{Axis, Number, Real, Scalar, Vector};
use crate::shape::{Shape, Triangle};
use crate::solid::{Leaf, NESTING_MAX, Node};
use crate::span::Operator;
use crate::texture::Mapping;
use texture::{check_channels, check_paint, check_texture};

/// Checks all tables and works out what the scene needs.
pub(super) fn check<S: Scalar, const NEEDS: u64>(
    parts: &Parts<'_, S>,
) -> Result<Limits<S>, SceneError> {
    parts.camera.check().map_err(SceneError::of_camera)?;
    check_background(&parts.background)?;
    check_light_amount(Item::Ambient, "color", parts.ambient)?;
    for (index, placement) in (0..).zip(parts.placements) {
        need::<NEEDS>(needs::PLACEMENTS, Item::Placement(index), "a placement")?;
        check_placement(Item::Placement(index), placement)?;
    }
    for (index, texture) in (0..).zip(parts.textures) {
        need::<NEEDS>(needs::TEXTURES, Item::Texture(index), "a texture")?;
        if texture.mapping == Mapping::Uv {
            need::<NEEDS>(needs::COORDINATES, Item::Texture(index), "a surface's coordinates")?;
        }
        check_texture(parts, index, texture)?;
    }
    for (index, material) in (0..).zip(parts.materials) {
        check_material::<S, NEEDS>(parts, Item::Material(index), material)?;
    }
    for (index, light) in (0..).zip(parts.lights) {
        check_light(Item::Light(index), light)?;
    }
    let (mut boundaries, mut widest, mut crossings) = (0, 0, 0_u32);
    for (index, object) in (0..).zip(parts.objects) {
        let needs = check_object::<S, NEEDS>(parts, index, object)?;
        if needs.structure.boundaries > boundaries {
            (boundaries, widest) = (needs.structure.boundaries, index);
        }
        crossings = crossings.saturating_add(needs.structure.crossings);
    }
    Ok(Limits { boundaries, widest, crossings, ..reach(parts) })
}

/// A scene that is made for certain needs asks for nothing else.
fn need<const NEEDS: u64>(need: u64, at: Item, what: &'static str) -> Result<(), SceneError> {
    if has(NEEDS, need) { Ok(()) } else { Err(SceneError::NotNeeded { at, what }) }
}

/// What one object needs.
pub(super) struct Needs<S: Scalar> {
    pub(super) structure: Structure,
    pub(super) bounds: Bounds<S>,
}

/// An operator whose operands are being taken together.
#[derive(Clone, Copy)]
struct Open<S: Scalar> {
    operator: Operator,
    end: u32,
    bounds: Option<Bounds<S>>,
}

impl<S: Scalar> Open<S> {
    fn take(&mut self, operand: &Bounds<S>) {
        self.bounds = Some(match (self.operator, self.bounds) {
            (Operator::Complement, _) => Bounds::everywhere(),
            (_, None) => *operand,
            (Operator::Union | Operator::Xor, Some(bounds)) => bounds.union(operand),
            (Operator::Intersection, Some(bounds)) => bounds.intersection(operand),
            (Operator::Difference, Some(bounds)) => bounds,
        });
    }
}

/// Walks the nodes of one object: they must be exactly one well-formed solid of legal leaves.
pub(super) fn check_object<S: Scalar, const NEEDS: u64>(
    parts: &Parts<'_, S>,
    index: u32,
    object: &Object<S>,
) -> Result<Needs<S>, SceneError> {
    let (materials, placements) = (parts.materials.len(), parts.placements.len());
    let structure = object_structure(parts.nodes, index, object, materials, placements)?;
    let mut open: heapless::Vec<Open<S>, NESTING_MAX> = heapless::Vec::new();
    let mut bounds = Bounds::nothing();
    for node in object.first..object.first + object.count {
        let leaf = match parts.nodes.get(node as usize) {
            Some(&Node::Operator { operator, size }) => {
                need::<NEEDS>(needs::OPERATORS, Item::Node(node), "an operator")?;
                // There is room: the structure is checked.
                let _ = open.push(Open { operator, end: node + size, bounds: None });
                continue;
            }
            Some(Node::Leaf(leaf)) => leaf,
            None => continue,
        };
        bounds = check_leaf::<S, NEEDS>(parts, node, leaf)?;
        // The leaf ends every operator that ends with it.
        while let Some(inner) = open.last_mut() {
            inner.take(&bounds);
            if inner.end > node + 1 {
                break;
            }
            bounds = inner.bounds.unwrap_or(bounds);
            open.pop();
        }
    }
    if object.bounds.is_some_and(|stated| stated.union(&bounds) != stated) {
        return Err(SceneError::BoundsTooSmall { at: Item::Object(index) });
    }
    Ok(Needs { structure, bounds })
}

/// Checks the numbers of a leaf whose indices are known to be legal.
fn check_leaf<S: Scalar, const NEEDS: u64>(
    parts: &Parts<'_, S>,
    node: u32,
    leaf: &Leaf<S>,
) -> Result<Bounds<S>, SceneError> {
    let place = leaf.placement.and_then(|index| parts.placements.get(usize::from(index)));
    let flaw = leaf.shape.check_for::<NEEDS>(place.is_some(), &parts.tables);
    flaw.map_err(|flaw| {
        let (last, len) = (last_point(&leaf.shape), parts.tables.points.len() as u32);
        SceneError::of_flaw(Item::Node(node), flaw, last, len)
    })?;
    Ok(leaf.shape.bounds_for::<NEEDS>(place, &parts.tables))
}

/// The greatest index of a point that a shape names.
fn last_point<S: Scalar>(shape: &Shape<S>) -> u32 {
    match shape {
        Shape::Triangle(Triangle { corners: [a, b, c], normals }) => {
            let last = *a.max(b).max(c);
            if *normals == Triangle::FLAT { last } else { last.max(normals.saturating_add(2)) }
        }
        Shape::Lathe(lathe) => lathe.first.saturating_add(lathe.count.saturating_sub(1)),
        Shape::Prism(prism) => prism.first.saturating_add(prism.count.saturating_sub(1)),
        Shape::Polygon(polygon) => polygon.first.saturating_add(polygon.count.saturating_sub(1)),
        _ => 0,
    }
}

fn check_placement<S: Scalar>(at: Item, placement: &Placement<S>) -> Result<(), SceneError> {
    let rows = placement.to_local.iter().chain(&placement.to_world);
    if !(rows.into_iter().all(|row| row.is_finite()) && placement.anchor.is_finite()) {
        return Err(SceneError::NotFinite { at, field: "placement" });
    }
    if placement.anchor.max_abs() > S::COORD_MAX {
        return Err(SceneError::TooLarge { at, field: "anchor" });
    }
    // The two matrices must undo each other, to the rounding of their entries.
    for axis in Axis::ALL {
        let (one, zero) = (S::Wide::ONE, S::Wide::ZERO);
        let unit = S::WideVec::ZERO.with(axis, one);
        let there = apply::<S>(&placement.to_world, unit);
        let scale =
            there.max_abs() * placement.to_local.iter().fold(zero, |m, r| m.max(r.max_abs()));
        let back = apply::<S>(&placement.to_local, there);
        if !((back - unit).max_abs() <= scale.max(one) * S::EPSILON_ROOT.widen()) {
            return Err(SceneError::SingularPlacement { at });
        }
        let rigid = (there.length() - one).abs() <= S::Wide::EPSILON * S::Wide::from_i32(64);
        if placement.rigid && !rigid {
            return Err(SceneError::OutOfRange {
                at,
                field: "rigid",
                allowed: "true only without a scale",
            });
        }
    }
    Ok(())
}

/// Light is finite and not negative.
fn check_light_amount<S: Scalar>(
    at: Item,
    field: &'static str,
    color: Rgb<S>,
) -> Result<(), SceneError> {
    for part in color.to_array() {
        check_amount(at, field, part)?;
    }
    Ok(())
}

fn check_amount<S: Scalar>(at: Item, field: &'static str, value: S) -> Result<(), SceneError> {
    if !value.is_finite() {
        Err(SceneError::NotFinite { at, field })
    } else if value < S::ZERO {
        Err(SceneError::OutOfRange { at, field, allowed: "at least 0" })
    } else if value > S::from_i32(10_000) {
        Err(SceneError::OutOfRange { at, field, allowed: "at most 10000" })
    } else {
        Ok(())
    }
}

fn check_background<S: Scalar>(background: &Background<S>) -> Result<(), SceneError> {
    let at = Item::Background;
    match *background {
        Background::Constant(color) => check_light_amount(at, "color", color),
        Background::Gradient { bottom, top } => {
            check_light_amount(at, "bottom", bottom)?;
            check_light_amount(at, "top", top)
        }
    }
}

fn check_material<S: Scalar, const NEEDS: u64>(
    parts: &Parts<'_, S>,
    at: Item,
    material: &Material<S>,
) -> Result<(), SceneError> {
    if material.reflect != S::ZERO || material.fresnel != Fresnel::Off {
        need::<NEEDS>(needs::MIRRORS, at, "a mirror")?;
    }
    if material.is_transparent() {
        need::<NEEDS>(needs::GLASS, at, "glass")?;
    }
    check_paint(at, material.color, parts.textures.len(), None)?;
    check_channels(parts, at, material)?;
    for (value, field) in [
        (material.ambient, "ambient"),
        (material.diffuse, "diffuse"),
        (material.specular, "specular"),
        (material.reflect, "reflect"),
        (material.transmit, "transmit"),
    ] {
        check_amount(at, field, value)?;
    }
    if !material.shininess.is_finite() {
        return Err(SceneError::NotFinite { at, field: "shininess" });
    }
    if material.shininess < S::ZERO {
        return Err(SceneError::OutOfRange { at, field: "shininess", allowed: "at least 0" });
    }
    if !material.ior.is_finite() {
        return Err(SceneError::NotFinite { at, field: "ior" });
    }
    if !(material.ior >= S::from_ratio(1, 10) && material.ior <= S::from_i32(10)) {
        return Err(SceneError::OutOfRange { at, field: "ior", allowed: "between 0.1 and 10" });
    }
    check_light_amount(at, "absorb", material.absorb)
}

fn check_attenuation<S: Scalar>(at: Item, attenuation: &Attenuation<S>) -> Result<(), SceneError> {
    check_amount(at, "attenuation", attenuation.constant)?;
    check_amount(at, "attenuation", attenuation.linear)?;
    check_amount(at, "attenuation", attenuation.quadratic)?;
    if attenuation.constant < S::from_ratio(1, 10_000) {
        let allowed = "at least 0.0001 in its constant part";
        return Err(SceneError::OutOfRange { at, field: "attenuation", allowed });
    }
    Ok(())
}

fn check_unit<S: Scalar>(at: Item, field: &'static str, v: S::Dir) -> Result<(), SceneError> {
    if !v.is_finite() {
        return Err(SceneError::NotFinite { at, field });
    }
    let off = (S::widen_dir(v).length() - S::Wide::ONE).abs();
    if !(off <= S::EPSILON.widen() * S::Wide::from_i32(64)) {
        Err(SceneError::OutOfRange { at, field, allowed: "of unit length" })
    } else {
        Ok(())
    }
}

fn check_light<S: Scalar>(at: Item, light: &Light<S>) -> Result<(), SceneError> {
    match light {
        Light::Directional { toward, color } => {
            check_light_amount(at, "color", *color)?;
            check_unit::<S>(at, "toward", *toward)
        }
        Light::Point { at: position, color, attenuation }
        | Light::Spot { at: position, color, attenuation, .. } => {
            if !position.is_finite() {
                return Err(SceneError::NotFinite { at, field: "at" });
            }
            if position.max_abs() > S::COORD_MAX {
                return Err(SceneError::TooLarge { at, field: "at" });
            }
            check_light_amount(at, "color", *color)?;
            check_attenuation(at, attenuation)?;
            let Light::Spot { cone, .. } = light else {
                return Ok(());
            };
            check_unit::<S>(at, "toward", cone.axis)?;
            let in_order = cone.cos_inner <= S::ONE
                && cone.cos_outer >= -S::ONE
                && cone.cos_outer < cone.cos_inner;
            if in_order {
                Ok(())
            } else {
                let allowed = "an outer angle greater than the inner one, up to 180 degrees";
                Err(SceneError::OutOfRange { at, field: "cone", allowed })
            }
        }
    }
}

/// The greatest amounts of light, from the tables alone.
fn reach<S: Scalar>(parts: &Parts<'_, S>) -> Limits<S> {
    let zero = S::Wide::ZERO;
    let lights =
        parts.lights.iter().fold(zero, |sum, light| sum + light.brightest().max_part().widen());
    let background = parts.background.brightest();
    let (mut local, mut growth) = (zero, zero);
    let mut transparent = false;
    for material in parts.materials {
        let color = texture::brightest(parts, material.color).widen();
        let tint = if material.metallic { color } else { S::Wide::ONE };
        let lit = material.diffuse.widen() * color + material.specular.widen() * tint;
        let ambient = parts.ambient.max_part().widen() * material.ambient.widen();
        local = local.max(ambient * color + lights * lit);
        let moved = if material.fresnel == Fresnel::Off { zero } else { material.diffuse.widen() };
        let mirrored = material.reflect.widen() + material.transmit.widen() + moved;
        growth = growth.max(mirrored * tint.max(S::Wide::ONE));
        transparent |= material.is_transparent();
    }
    // Sums are rounded; a little more is certainly enough.
    let margin = S::Wide::ONE + S::EPSILON.widen() * S::Wide::from_i32(1024);
    Limits {
        boundaries: 0,
        widest: 0,
        crossings: 0,
        transparent,
        brightest: S::narrow(local.max(background.widen()) * margin),
        background,
        growth: S::narrow(growth * margin),
    }
}

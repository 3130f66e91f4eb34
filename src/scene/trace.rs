//! What a ray meets first, and what stands between a point and a light.

use super::{Object, Scene};
use crate::color::Rgb;
use crate::error::SceneError;
use crate::look::Look;
use crate::material::Material;
use crate::needs::{self, has};
use crate::ray::{Line, Ray};
use crate::scalar::{Number, Real, Scalar, Vector};
use crate::solid::{Contact, Leaf, Node};
use crate::span::{Boundary, End, Passage};
use crate::stats::{Event, Tally};
use crate::texture::{Channels, Parameter};

/// The nearest boundary on a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit<S> {
    /// The object, as an index into the scene's.
    pub object: u32,
    /// The boundary of that object.
    pub boundary: Boundary<S>,
}

/// The transparent objects that a point lies in: where they overlap, the one listed last rules.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Media {
    /// The object that rules, and the one that would without it.
    ruling: [Option<u32>; 2],
}

impl Media {
    const AIR: Self = Self { ruling: [None; 2] };

    /// Takes note of an object around the point; objects come in ascending order.
    fn add(&mut self, object: u32) {
        self.ruling = [Some(object), self.ruling[0]];
    }

    /// The object that fills the space here.
    pub(crate) fn here(&self) -> Option<u32> {
        self.ruling[0]
    }

    /// The object that fills the space behind a boundary of `object`.
    pub(crate) fn behind(&self, object: u32, passage: Passage) -> Option<u32> {
        match passage {
            Passage::Touch => self.ruling[0],
            Passage::Enter => self.ruling[0].max(Some(object)),
            Passage::Leave if self.ruling[0] == Some(object) => self.ruling[1],
            Passage::Leave => self.ruling[0],
        }
    }
}

/// What a search along a ray found.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found<S> {
    pub(crate) hit: Option<Hit<S>>,
    pub(crate) media: Media,
}

/// Which objects a search looks at.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Among {
    All,
    Transparent,
}

impl<'a, S: Scalar, const NEEDS: u64> Scene<'a, S, NEEDS> {
    /// The nearest boundary along a ray from free space, if it meets any.
    ///
    /// # Errors
    /// If the buffer has less room than [`limits`](Self::limits) tells.
    pub fn nearest(
        &self,
        ray: Ray<S>,
        buffer: &mut [Boundary<S>],
    ) -> Result<Option<Hit<S>>, SceneError> {
        self.check_room(buffer.len())?;
        Ok(self.search(&Line::new(ray, None), S::ZERO, buffer, &mut ()).hit)
    }

    /// The point of the surface where a ray meets a hit that was found along it; `None` for a
    /// hit of another scene.
    pub fn contact(&self, ray: Ray<S>, hit: &Hit<S>) -> Option<Contact<S>> {
        let Boundary { t, node, face, .. } = hit.boundary;
        let leaf = self.geometry().leaf(node)?;
        Some(self.geometry().contact(&Line::new(ray, None), leaf, End { t, face }))
    }

    /// The nearest boundary after a point of the ray, and the media there.
    #[inline]
    pub(crate) fn search(
        &self,
        line: &Line<S>,
        after: S,
        buffer: &mut [Boundary<S>],
        tally: &mut impl Tally,
    ) -> Found<S> {
        self.search_among(Among::All, line, [after, S::FAR], buffer, tally)
    }

    fn search_among(
        &self,
        among: Among,
        line: &Line<S>,
        [after, mut before]: [S; 2],
        buffer: &mut [Boundary<S>],
        tally: &mut impl Tally,
    ) -> Found<S> {
        let mut found = Found { hit: None, media: Media::AIR };
        for (index, object) in (0..).zip(self.parts.objects) {
            if object.bounds.is_some_and(|bounds| !bounds.meets(line, before)) {
                tally.count(Event::BoundsSkip);
                continue;
            }
            if among == Among::Transparent && self.is_opaque_leaf(object) {
                continue;
            }
            let fills = self.fills(object);
            let window = [after, before];
            let (inside, first) = self.first_boundary(object, line, window, buffer, tally);
            if inside && fills {
                found.media.add(index);
            }
            if let Some(boundary) = first {
                before = boundary.t;
                found.hit = Some(Hit { object: index, boundary });
            }
        }
        found
    }

    /// Light goes through what fills the object.
    #[inline]
    fn fills(&self, object: &Object<S>) -> bool {
        has(NEEDS, needs::GLASS)
            && self.limits.transparent
            && self.material(object.material).is_some_and(Material::is_transparent)
    }

    /// The object is a single leaf that lets no light through.
    fn is_opaque_leaf(&self, object: &Object<S>) -> bool {
        self.geometry()
            .leaf(object.first)
            .and_then(|leaf| self.material(leaf.material))
            .is_some_and(|material| !material.is_transparent())
    }

    /// Whether the start of a window of the ray is inside an object, and its first boundary
    /// between the ends.
    #[inline]
    fn first_boundary(
        &self,
        object: &Object<S>,
        line: &Line<S>,
        window: [S; 2],
        buffer: &mut [Boundary<S>],
        tally: &mut impl Tally,
    ) -> (bool, Option<Boundary<S>>) {
        match self.parts.nodes.get(object.first as usize) {
            Some(Node::Leaf(leaf)) => self.first_of_leaf(object.first, leaf, line, window, tally),
            _ if !has(NEEDS, needs::OPERATORS) => (false, None),
            _ => {
                let leaf = || tally.count(Event::LeafTest);
                let geometry = self.geometry();
                let spans = geometry.evaluate(object.first, object.count, line, buffer, leaf);
                let [after, before] = window;
                let first = spans.boundaries.iter().find(|b| b.t > after);
                (spans.contains(after), first.filter(|b| b.t < before).copied())
            }
        }
    }

    /// The same for an object that is a single leaf, without a list.
    #[inline]
    fn first_of_leaf(
        &self,
        node: u32,
        leaf: &Leaf<S>,
        line: &Line<S>,
        window: [S; 2],
        tally: &mut impl Tally,
    ) -> (bool, Option<Boundary<S>>) {
        tally.count(Event::LeafTest);
        let sight = self.geometry().sight(node, leaf, line);
        let (inside, first) = leaf.shape.first::<NEEDS>(&sight, window);
        let boundary = first.map(|(End { t, face }, passage)| Boundary {
            t,
            node,
            face,
            passage,
            inverted: false,
        });
        (inside, boundary)
    }

    /// The share of a light that arrives along a ray from a surface: nothing behind an opaque
    /// surface; each transparent one lets its `transmit` through, and what lies between
    /// absorbs by its length.
    pub(crate) fn transmittance(
        &self,
        line: &Line<S>,
        distance: S,
        buffer: &mut [Boundary<S>],
        tally: &mut impl Tally,
    ) -> Rgb<S> {
        let mut filtered = false;
        for object in self.parts.objects {
            if object.bounds.is_some_and(|bounds| !bounds.meets(line, distance)) {
                tally.count(Event::BoundsSkip);
                continue;
            }
            match self.obstacle(object, line, distance, buffer, tally) {
                Obstacle::None => {}
                Obstacle::Filter => filtered = true,
                Obstacle::Opaque => return Rgb::BLACK,
            }
        }
        if has(NEEDS, needs::GLASS) && filtered {
            self.filter(line, distance, buffer, tally)
        } else {
            Rgb::WHITE
        }
    }

    /// What one object does to the light along a part of a ray.
    fn obstacle(
        &self,
        object: &Object<S>,
        line: &Line<S>,
        distance: S,
        buffer: &mut [Boundary<S>],
        tally: &mut impl Tally,
    ) -> Obstacle {
        let of = |node: u32| {
            let leaf = self.geometry().leaf(node);
            let clear = leaf.and_then(|leaf| self.material(leaf.material));
            if has(NEEDS, needs::GLASS) && clear.is_some_and(Material::is_transparent) {
                Obstacle::Filter
            } else {
                Obstacle::Opaque
            }
        };
        if let Some(Node::Leaf(leaf)) = self.parts.nodes.get(object.first as usize) {
            let window = [S::ZERO, distance];
            let (inside, first) = self.first_of_leaf(object.first, leaf, line, window, tally);
            let around =
                if inside && self.fills(object) { Obstacle::Filter } else { Obstacle::None };
            return first.map_or(around, |boundary| of(boundary.node));
        }
        if !has(NEEDS, needs::OPERATORS) {
            return Obstacle::None;
        }
        let leaf = || tally.count(Event::LeafTest);
        let spans = self.geometry().evaluate(object.first, object.count, line, buffer, leaf);
        let around = spans.inside && self.fills(object);
        let mut obstacle = if around { Obstacle::Filter } else { Obstacle::None };
        for boundary in spans.boundaries.iter().filter(|b| b.t < distance) {
            obstacle = of(boundary.node);
            if obstacle == Obstacle::Opaque {
                break;
            }
        }
        obstacle
    }

    /// Goes through the transparent surfaces towards a light, one after another.
    fn filter(
        &self,
        line: &Line<S>,
        distance: S,
        buffer: &mut [Boundary<S>],
        tally: &mut impl Tally,
    ) -> Rgb<S> {
        let (mut after, mut share) = (S::ZERO, Rgb::WHITE);
        // Each search goes on behind the boundary of the one before; there are so many at most.
        for _ in 0..=self.limits.crossings {
            let window = [after, distance];
            let found = self.search_among(Among::Transparent, line, window, buffer, tally);
            let to = found.hit.map_or(distance, |hit| hit.boundary.t);
            share = share * self.absorption(found.media.here(), to - after);
            let Some(Hit { object, boundary }) = found.hit else {
                break;
            };
            let behind = found.media.behind(object, boundary.passage);
            if boundary.passage == Passage::Touch || behind != found.media.here() {
                share = share * self.transmit_at(line, &boundary, tally);
            }
            after = boundary.t;
        }
        share
    }

    /// The share of light that a transparent surface lets through where a ray meets it.
    fn transmit_at(&self, line: &Line<S>, boundary: &Boundary<S>, tally: &mut impl Tally) -> S {
        let Boundary { t, node, face, .. } = *boundary;
        let geometry = self.geometry();
        let Some(leaf) = geometry.leaf(node) else {
            return S::ZERO;
        };
        match self.material(leaf.material) {
            Some(material) if material.channels == Channels::NONE => material.transmit,
            _ => {
                let contact = geometry.contact(line, leaf, End { t, face });
                let look = Look::new(self, leaf, &contact, face);
                look.map_or(S::ZERO, |look| look.number(Parameter::Transmit, self, tally))
            }
        }
    }

    /// A transparent surface that does not show: what rules the space is the same on both sides.
    pub(crate) fn is_hidden(
        &self,
        boundary: &Boundary<S>,
        [here, behind]: [Option<u32>; 2],
    ) -> bool {
        let material = self.geometry().leaf(boundary.node).and_then(|l| self.material(l.material));
        has(NEEDS, needs::GLASS)
            && boundary.passage != Passage::Touch
            && here == behind
            && material.is_some_and(Material::is_transparent)
    }

    /// The share of light left after a length of what fills an object.
    pub(crate) fn absorption(&self, medium: Option<u32>, length: S) -> Rgb<S> {
        if !has(NEEDS, needs::GLASS) {
            return Rgb::WHITE;
        }
        let object = medium.and_then(|index| self.parts.objects.get(index as usize));
        let Some(material) = object.and_then(|object| self.material(object.material)) else {
            return Rgb::WHITE;
        };
        if material.absorb.is_black() {
            return Rgb::WHITE;
        }
        material.absorb.map(|part| {
            // Nothing to multiply with an infinite length.
            if part == S::ZERO {
                S::ONE
            } else {
                S::narrow((-(part.widen() * length.widen())).exp())
            }
        })
    }

    /// The index of refraction of what fills an object; 1 for air.
    pub(crate) fn ior(&self, medium: Option<u32>) -> S {
        let object = medium.and_then(|index| self.parts.objects.get(index as usize));
        let material = object.and_then(|object| self.material(object.material));
        material.map_or(S::ONE, |material| material.ior)
    }

    /// The unit normal that light sees where a ray meets a face of a leaf, on the side of the true one.
    pub(crate) fn shading_normal(
        &self,
        leaf: &Leaf<S>,
        contact: &Contact<S>,
        face: u32,
        normal: S::Dir,
    ) -> S::Dir {
        let Some(shading) =
            leaf.shape.shading_normal_for::<NEEDS>(contact.local, face, &self.parts.tables)
        else {
            return normal;
        };
        let place = self.geometry().placement(leaf);
        let unit = S::unit(place.map_or(shading, |place| place.normal(shading)));
        if unit.dot(normal) < S::Unit::ZERO { -unit } else { unit }
    }
}

/// What stands in the way of light.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Obstacle {
    None,
    Filter,
    Opaque,
}

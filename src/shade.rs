//! The light that leaves a surface: what is lit directly, and which rays carry the rest.

use crate::color::Rgb;
use crate::look::Look;
use crate::material::{Fresnel, Highlight, Material};
use crate::needs::{self, has};
use crate::ray::{Line, Ray, Start};
use crate::scalar::{Number, Real, Scalar, Vector};
use crate::scene::Scene;
use crate::solid::Contact;
use crate::span::{Boundary, End, Passage};
use crate::stats::{Event, Tally};
use crate::texture::Parameter;

/// A surface where a ray met it.
pub(crate) struct Surface<'a, S: Scalar> {
    look: Look<'a, S>,
    contact: Contact<S>,
    node: u32,
    face: u32,
    passage: Passage,
    /// The viewer is on the inner side of the leaf.
    from_within: bool,
    /// The unit normal of the geometry, to the viewer's side.
    normal: S::Dir,
    /// The unit normal that light sees, to the viewer's side.
    shading: S::Dir,
}

/// A ray to follow, and its share of the light.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Branch<S: Scalar> {
    pub(crate) ray: Ray<S>,
    pub(crate) start: Start<S>,
    pub(crate) weight: Rgb<S>,
}

/// The rays that carry light to a surface.
pub(crate) struct Branches<S: Scalar> {
    pub(crate) reflected: Option<Branch<S>>,
    pub(crate) refracted: Option<Branch<S>>,
    /// The share of the diffuse light that is left beside them.
    pub(crate) diffuse: S,
}

impl<'a, S: Scalar> Surface<'a, S> {
    /// The surface at a boundary; `None` only for one that is not of this scene.
    pub(crate) fn new<const NEEDS: u64>(
        scene: &'a Scene<'_, S, NEEDS>,
        line: &Line<S>,
        boundary: &Boundary<S>,
        tally: &mut impl Tally,
    ) -> Option<Self> {
        let Boundary { t, node, face, passage, inverted } = *boundary;
        let geometry = scene.geometry();
        let leaf = geometry.leaf(node)?;
        let contact = geometry.contact(line, leaf, End { t, face });
        let look = Look::new(scene, leaf, &contact, face)?;
        // The side is known from the boundary; only an open surface asks the normal, which
        // rounding may turn over at a grazing angle.
        let from_within = match passage {
            Passage::Touch => contact.normal.dot(line.dir) > S::Unit::ZERO,
            Passage::Enter => inverted,
            Passage::Leave => !inverted,
        };
        let normal = if from_within { -contact.normal } else { contact.normal };
        let shading = scene.shading_normal(leaf, &contact, face, normal);
        let shading = look.relief(shading, from_within, scene, tally);
        Some(Self { look, contact, node, face, passage, from_within, normal, shading })
    }

    fn start(&self, other_side: bool) -> Start<S> {
        Start {
            node: self.node,
            face: self.face,
            inward: self.from_within != other_side,
            local: self.contact.local,
        }
    }

    fn branch(&self, dir: S::Dir, other_side: bool, weight: Rgb<S>) -> Branch<S> {
        let ray = Ray { origin: self.contact.position, dir };
        Branch { ray, start: self.start(other_side), weight }
    }

    /// The light of the lamps and the ambient light towards the viewer against `view`, with
    /// the share of the diffuse light that Fresnel's law leaves.
    pub(crate) fn local_light<const NEEDS: u64>(
        &mut self,
        scene: &Scene<'_, S, NEEDS>,
        view: S::Dir,
        diffuse_share: S,
        buffer: &mut [Boundary<S>],
        tally: &mut impl Tally,
    ) -> Rgb<S> {
        let material = self.look.material;
        let parts = scene.parts();
        let mut light = Rgb::BLACK;
        if !parts.ambient.is_black() && material.ambient != S::ZERO {
            let ambient = self.look.number(Parameter::Ambient, scene, tally);
            light = parts.ambient * self.look.color(scene, tally) * ambient;
        }
        if material.diffuse * diffuse_share == S::ZERO && material.specular == S::ZERO {
            return light;
        }
        let mut gloss = None;
        for lamp in parts.lights {
            let Some(seen) = lamp.seen_from(self.contact.position) else {
                tally.count(Event::ShadowSkip);
                continue;
            };
            let facing = self.shading.dot(seen.toward);
            if !(facing > S::Unit::ZERO && self.normal.dot(seen.toward) > S::Unit::ZERO) {
                tally.count(Event::ShadowSkip);
                continue;
            }
            let mut share = Rgb::BLACK;
            if material.diffuse * diffuse_share != S::ZERO {
                let diffuse = self.look.diffuse(scene, tally) * diffuse_share;
                share = self.look.color(scene, tally) * (diffuse * S::from_unit(facing));
            }
            if material.specular > S::ZERO {
                let cosine = self.highlight_cosine(seen.toward, view, facing);
                if cosine > S::Unit::ZERO {
                    let (gloss, shininess) =
                        *gloss.get_or_insert_with(|| self.look.gloss(scene, tally));
                    share += gloss * Material::lobe(shininess, cosine);
                }
            }
            let arriving = seen.color * share;
            if arriving.is_black() {
                tally.count(Event::ShadowSkip);
                continue;
            }
            tally.count(Event::ShadowRay);
            let ray = Ray { origin: self.contact.position, dir: seen.toward };
            let line = Line::new(ray, Some(self.start(false)));
            light += arriving * scene.transmittance(&line, seen.distance, buffer, tally);
        }
        light
    }

    /// R·V of Phong's model, or N·H of Blinn's.
    #[inline]
    fn highlight_cosine(&self, toward: S::Dir, view: S::Dir, facing: S::Unit) -> S::Unit {
        let cosine = match self.look.material.highlight {
            Highlight::Phong => S::mirror(toward, self.shading, facing).dot(view),
            Highlight::Blinn => {
                let half = S::unit(S::widen_dir(toward) - S::widen_dir(view));
                self.shading.dot(half)
            }
        };
        cosine.min(S::Unit::ONE)
    }

    /// The mirrored and the refracted ray for a ray of direction `view` and a weight; `ratio`
    /// is the index of refraction on this side over that on the other.
    ///
    /// Snell's law decides the direction; beyond the critical angle all that would pass is mirrored.
    pub(crate) fn branches<const NEEDS: u64>(
        &mut self,
        scene: &Scene<'_, S, NEEDS>,
        view: S::Dir,
        weight: Rgb<S>,
        ratio: S::Wide,
        tally: &mut impl Tally,
    ) -> Branches<S> {
        if !has(NEEDS, needs::MIRRORS | needs::GLASS) {
            return Branches { reflected: None, refracted: None, diffuse: S::ONE };
        }
        let material = self.look.material;
        let mut reflect = self.look.number(Parameter::Reflect, scene, tally);
        let mut transmit = self.look.number(Parameter::Transmit, scene, tally);
        let mut diffuse = S::ONE;
        let cosine = (-self.shading.dot(view)).clamp(S::Unit::ZERO, S::Unit::ONE);
        let mut through = S::widen_dir(view);
        if self.passage != Passage::Touch
            && (transmit > S::ZERO || material.fresnel != Fresnel::Off)
        {
            let (one, cos_in) = (S::Wide::ONE, S::widen_unit(cosine));
            let square = one - ratio.squared() * (one - cos_in.squared());
            if square > S::Wide::ZERO {
                let cos_out = square.sqrt();
                let moved = S::narrow(material.reflectance(cos_in, cos_out, ratio));
                reflect += moved * (transmit + self.look.diffuse(scene, tally));
                transmit *= S::ONE - moved;
                diffuse = S::ONE - moved;
                if ratio != one {
                    let shading = S::widen_dir(self.shading);
                    through = through * ratio + shading * (ratio * cos_in - cos_out);
                }
            } else {
                reflect += transmit;
                transmit = S::ZERO;
            }
        }
        let reflected = (reflect > S::ZERO).then(|| {
            let dir = S::unit(S::widen_dir(self.mirrored(view, cosine)));
            let tint = self.look.tint(scene, tally);
            self.branch(dir, false, weight * tint * reflect)
        });
        let refracted =
            (transmit > S::ZERO).then(|| self.branch(S::unit(through), true, weight * transmit));
        Branches { reflected, refracted, diffuse }
    }

    /// The mirrored direction; never to the far side of the geometry, whatever the shading normal says.
    fn mirrored(&self, view: S::Dir, cosine: S::Unit) -> S::Dir {
        let dir = S::mirror(view, self.shading, -cosine);
        if dir.dot(self.normal) >= S::Unit::ZERO {
            dir
        } else {
            S::mirror(view, self.normal, view.dot(self.normal))
        }
    }
}

//! A material at one spot: each of its textures is evaluated when it is first asked for, and not where it is
//! multiplied with 0.

use crate::color::Rgb;
use crate::material::Material;
use crate::needs::{self, has};
use crate::scalar::Scalar;
use crate::scene::Scene;
use crate::solid::{Contact, Leaf};
use crate::stats::Tally;
use crate::texture::{Channel, Face, Ground, Parameter, Spot};

/// What a surface looks like where a ray met it.
pub(crate) struct Look<'a, S: Scalar> {
    pub(crate) material: &'a Material<S>,
    channels: &'a [Channel<S>],
    ground: Ground<'a, S>,
    color: Option<Rgb<S>>,
    diffuse: Option<S>,
}

impl<'a, S: Scalar> Look<'a, S> {
    /// The look of a face of a leaf; `None` without a material.
    pub(crate) fn new<const NEEDS: u64>(
        scene: &'a Scene<'_, S, NEEDS>,
        leaf: &'a Leaf<S>,
        contact: &Contact<S>,
        face: u32,
    ) -> Option<Self> {
        let material = scene.material(leaf.material)?;
        let on = Some(Face { shape: &leaf.shape, face, tables: &scene.parts().tables });
        let spot = Spot { position: contact.position, local: contact.local, on };
        let ground = Ground { spot, place: scene.geometry().placement(leaf) };
        let channels = material.channels.of(scene.parts().channels);
        Some(Self { material, channels, ground, color: None, diffuse: None })
    }

    /// The colour.
    #[inline]
    pub(crate) fn color<const NEEDS: u64>(
        &mut self,
        scene: &Scene<'_, S, NEEDS>,
        tally: &mut impl Tally,
    ) -> Rgb<S> {
        if let Some(color) = self.color {
            return color;
        }
        let color = scene.textures().see(self.material.color, &self.ground.spot, tally).color;
        self.color = Some(color);
        color
    }

    /// White, or the colour of a metal.
    #[inline]
    pub(crate) fn tint<const NEEDS: u64>(
        &mut self,
        scene: &Scene<'_, S, NEEDS>,
        tally: &mut impl Tally,
    ) -> Rgb<S> {
        if self.material.metallic { self.color(scene, tally) } else { Rgb::WHITE }
    }

    /// The share of the diffuse reflection.
    #[inline]
    pub(crate) fn diffuse<const NEEDS: u64>(
        &mut self,
        scene: &Scene<'_, S, NEEDS>,
        tally: &mut impl Tally,
    ) -> S {
        if let Some(diffuse) = self.diffuse {
            return diffuse;
        }
        let diffuse = self.number(Parameter::Diffuse, scene, tally);
        self.diffuse = Some(diffuse);
        diffuse
    }

    /// A number of the material.
    #[inline]
    pub(crate) fn number<const NEEDS: u64>(
        &self,
        parameter: Parameter,
        scene: &Scene<'_, S, NEEDS>,
        tally: &mut impl Tally,
    ) -> S {
        let material = self.material;
        let number = match parameter {
            Parameter::Ambient => material.ambient,
            Parameter::Diffuse => material.diffuse,
            Parameter::Specular => material.specular,
            Parameter::Shininess => material.shininess,
            Parameter::Reflect => material.reflect,
            Parameter::Transmit => material.transmit,
        };
        if !has(NEEDS, needs::TEXTURES) || self.channels.is_empty() || number == S::ZERO {
            return number;
        }
        number * scene.textures().share(self.channels, parameter, &self.ground.spot, tally)
    }

    /// The colour and the exponent of the highlights.
    pub(crate) fn gloss<const NEEDS: u64>(
        &mut self,
        scene: &Scene<'_, S, NEEDS>,
        tally: &mut impl Tally,
    ) -> (Rgb<S>, S) {
        let specular = self.number(Parameter::Specular, scene, tally);
        let shininess = self.number(Parameter::Shininess, scene, tally);
        (self.tint(scene, tally) * specular, shininess)
    }

    /// The unit normal that light sees, for the one that it would see without a relief; on the inner side of the
    /// leaf the relief is seen from behind.
    #[inline]
    pub(crate) fn relief<const NEEDS: u64>(
        &self,
        normal: S::Dir,
        from_within: bool,
        scene: &Scene<'_, S, NEEDS>,
        tally: &mut impl Tally,
    ) -> S::Dir {
        let Material { diffuse, specular, reflect, transmit, .. } = *self.material;
        let matters = [diffuse, specular, reflect, transmit].iter().any(|part| *part > S::ZERO);
        let is_relief = |channel: &Channel<S>| matches!(channel, Channel::Relief { .. });
        if !has(NEEDS, needs::TEXTURES) || !matters || !self.channels.iter().any(is_relief) {
            return normal;
        }
        let outward = if from_within { -normal } else { normal };
        let tilted = scene.textures().tilted(self.channels, &self.ground, outward, tally);
        if from_within { -tilted } else { tilted }
    }
}

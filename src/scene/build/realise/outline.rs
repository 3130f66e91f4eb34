//! Outlines that are turned about an axis or drawn out along it, from what people describe.

use super::Stand;
use crate::error::{Item, SceneError};
use crate::place::Affine;
use crate::scalar::{Axis, Number, Real, Scalar, Vector};
use crate::scene::build::{Profile, SceneBuilder, Storage, Store, add};
use crate::shape::{Curve, Lathe, Prism, Shape};

/// A distance from the axis and a height.
type Spot<T> = [T; 2];

impl<S: Scalar, M: Storage> SceneBuilder<S, M> {
    pub(super) fn realise_lathe(
        &mut self,
        center: S::Vec3,
        profile: Profile<'_, S>,
        to_world: &Affine<S>,
    ) -> Result<(Shape<S>, Option<u16>), SceneError> {
        let at = Item::Node(self.nodes.entries().len() as u32);
        let stand = Stand::new(&Affine::translate(center).then(to_world))
            .ok_or(SceneError::SingularPlacement { at })?;
        let first = self.points.entries().len() as u32;
        let curve = match profile {
            Profile::Linear(points) => {
                self.add_profile(points.iter().map(|spot| spot.map(S::widen)), &stand)?;
                Curve::Lines
            }
            Profile::Bezier(points) => {
                self.add_profile(points.iter().map(|spot| spot.map(S::widen)), &stand)?;
                Curve::Cubics
            }
            Profile::CatmullRom(points) => {
                self.add_profile(catmull_rom(points), &stand)?;
                Curve::Cubics
            }
        };
        let points = self.points.entries().get(first as usize..).unwrap_or(&[]);
        let shape = Lathe {
            center: stand.centre(),
            first,
            count: points.len() as u32,
            curve,
            filled: Lathe::<S>::filled(points, curve),
        };
        Ok((Shape::Lathe(shape), self.stand(&stand)?))
    }

    pub(super) fn realise_prism(
        &mut self,
        vertices: &[Spot<S>],
        height: S,
        to_world: &Affine<S>,
    ) -> Result<(Shape<S>, Option<u16>), SceneError> {
        let at = Item::Node(self.nodes.entries().len() as u32);
        let half = height.widen() * S::Wide::HALF;
        let own =
            Affine::<S> { offset: S::WideVec::ZERO.with(Axis::Y, half), ..Affine::identity() };
        let stand = Stand::new(&own.then(to_world)).ok_or(SceneError::SingularPlacement { at })?;
        let first = self.points.entries().len() as u32;
        for vertex in vertices {
            let [x, z] = vertex.map(|length| stand.scaled(length));
            add(&mut self.points, "points", S::Vec3::new(x, S::ZERO, z))?;
        }
        let placed = self.points.entries().get(first as usize..).unwrap_or(&[]);
        let shape = Prism {
            center: stand.centre(),
            half_height: S::narrow(half * stand.factor),
            first,
            count: placed.len() as u32,
            winding: Prism::<S>::winding(placed),
        };
        Ok((Shape::Prism(shape), self.stand(&stand)?))
    }

    fn add_profile(
        &mut self,
        points: impl Iterator<Item = Spot<S::Wide>>,
        stand: &Stand<S>,
    ) -> Result<(), SceneError> {
        for [rho, y] in points {
            let [rho, y] = [rho, y].map(|length| S::narrow(length * stand.factor));
            add(&mut self.points, "points", S::Vec3::new(rho, y, S::ZERO))?;
        }
        Ok(())
    }
}

/// The control points of a Catmull-Rom spline.
fn catmull_rom<S: Scalar>(points: &[Spot<S>]) -> impl Iterator<Item = Spot<S::Wide>> {
    let ring = points.len() > 3 && points.first() == points.last();
    let wide = |index: usize| points.get(index).map(|spot| spot.map(S::widen));
    // What comes before the first point or after the last one, from the end and the one next to it.
    let beyond = move |end: Spot<S::Wide>, next: Spot<S::Wide>, around: Option<Spot<S::Wide>>| {
        let [[a, b], [c, d]] = [end, next];
        match around {
            Some(around) if ring => around,
            // The curve on the other side of the axis.
            _ if a == S::Wide::ZERO => [-c, d],
            _ => [a * S::Wide::TWO - c, b * S::Wide::TWO - d],
        }
    };
    let sixth = S::Wide::from_ratio(1, 6);
    let step = move |[a, b]: Spot<S::Wide>, [before, after]: [Spot<S::Wide>; 2], sign: S::Wide| {
        [a + (after[0] - before[0]) * sixth * sign, b + (after[1] - before[1]) * sixth * sign]
    };
    let last = points.len().saturating_sub(1);
    let pieces = (0..last).flat_map(move |index| {
        let Some((from, to)) = wide(index).zip(wide(index + 1)) else {
            return [[S::Wide::ZERO; 2]; 3];
        };
        let before = index.checked_sub(1).and_then(wide);
        let before = before.unwrap_or_else(|| beyond(from, to, wide(last.saturating_sub(1))));
        let after = wide(index + 2).unwrap_or_else(|| beyond(to, from, wide(1)));
        let one = S::Wide::ONE;
        [step(from, [before, to], one), step(to, [from, after], -one), to]
    });
    wide(0).into_iter().chain(pieces)
}

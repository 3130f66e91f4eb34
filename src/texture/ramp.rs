//! Colour ramps: the paints of a pattern, in order.

use super::Paint;
use crate::scalar::Scalar;

/// The most stops of a ramp.
pub const STOPS_MAX: u16 = 256;

/// A paint of a ramp, and where it stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop<S: Scalar> {
    /// The level of the pattern at which there is this paint alone; 0 to 1.
    pub at: S,
    /// The paint.
    pub paint: Paint<S>,
}

impl<S: Scalar> Stop<S> {
    /// One colour at a level.
    pub const fn color(at: S, color: crate::color::Rgb<S>) -> Self {
        Self { at, paint: Paint::Solid(color) }
    }
}

/// What lies between two stops.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Blend {
    /// A mixture, in proportion.
    #[default]
    Linear,
    /// A mixture without a bend at the stops.
    Smooth,
    /// The paint of the lower stop.
    Step,
}

/// A run of stops, in ascending order. A pattern that has parts instead of levels takes them in turn,
/// wherever they stand. Without stops a pattern is grey, as bright as its level.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Ramp {
    /// The index of the first.
    pub first: u16,
    /// How many; at most [`STOPS_MAX`].
    pub count: u16,
    /// What lies between two of them.
    pub blend: Blend,
}

impl Ramp {
    /// From black to white.
    pub const GREY: Self = Self::new(0, 0);

    /// A run of stops with mixtures between.
    pub const fn new(first: u16, count: u16) -> Self {
        Self { first, count, blend: Blend::Linear }
    }

    /// Its stops.
    pub(crate) fn stops<'a, S: Scalar>(&self, stops: &'a [Stop<S>]) -> &'a [Stop<S>] {
        let (first, count) = (usize::from(self.first), usize::from(self.count));
        stops.get(first..first + count).unwrap_or(&[])
    }
}

/// One or two paints and their shares.
#[derive(Clone, Copy)]
pub(super) struct Mixture<S: Scalar> {
    pub(super) paints: [(Paint<S>, S); 2],
    /// A number that changes where the mixture jumps.
    pub(super) side: u32,
}

impl<S: Scalar> Mixture<S> {
    pub(super) fn only(paint: Paint<S>, side: u32) -> Self {
        Self { paints: [(paint, S::ONE), (paint, S::ZERO)], side }
    }
}

/// The mixture at a level; `None` without stops.
pub(super) fn mixture<S: Scalar>(stops: &[Stop<S>], blend: Blend, level: S) -> Option<Mixture<S>> {
    let mut below: Option<&Stop<S>> = None;
    let (mut steps, mut passed) = (0, 0);
    for stop in stops {
        if level < stop.at {
            let Some(lower) = below else {
                return Some(Mixture::only(stop.paint, 0));
            };
            if blend == Blend::Step {
                return Some(Mixture::only(lower.paint, passed));
            }
            let share = (level - lower.at) / (stop.at - lower.at);
            let share = match blend {
                Blend::Smooth => share * share * (S::from_i32(3) - share - share),
                _ => share,
            };
            let paints = [(lower.paint, S::ONE - share), (stop.paint, share)];
            return Some(Mixture { paints, side: steps });
        }
        // Two stops in one place are a step.
        steps += u32::from(below.is_some_and(|below| below.at == stop.at));
        passed += 1;
        below = Some(stop);
    }
    let side = if blend == Blend::Step { passed } else { steps };
    below.map(|last| Mixture::only(last.paint, side))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Rgb;

    fn grey(v: f64) -> Rgb<f64> {
        Rgb::new(v, v, v)
    }

    /// The brightness at a level, and the side.
    fn at(stops: &[Stop<f64>], blend: Blend, level: f64) -> (f64, u32) {
        let found = mixture(stops, blend, level).unwrap();
        let sum = found.paints.iter().map(|(paint, share)| match paint {
            Paint::Solid(color) => color.r * share,
            Paint::Texture(_) => panic!("there are colours only"),
        });
        (sum.sum(), found.side)
    }

    #[test]
    fn levels_lie_between_their_stops() {
        let stops = [
            Stop::color(0.2, grey(1.0)),
            Stop::color(0.4, grey(3.0)),
            Stop::color(0.4, grey(5.0)),
            Stop::color(0.8, grey(9.0)),
        ];
        let linear = |level| at(&stops, Blend::Linear, level);
        assert_eq!([linear(-1.0), linear(0.2), linear(1.5)], [(1.0, 0), (1.0, 0), (9.0, 1)]);
        assert!((linear(0.25).0 - 1.5).abs() <= 1e-15 && linear(0.25).1 == 0);
        assert!((linear(0.399_999).0 - 3.0).abs() <= 1e-4 && linear(0.399_999).1 == 0);
        assert_eq!(linear(0.4), (5.0, 1));
        assert!((linear(0.6).0 - 7.0).abs() <= 1e-12);
        let step = |level| at(&stops, Blend::Step, level);
        assert_eq!([step(0.1), step(0.2), step(0.39)], [(1.0, 0), (1.0, 1), (1.0, 1)]);
        assert_eq!([step(0.4), step(0.79), step(0.8)], [(5.0, 3), (5.0, 3), (9.0, 4)]);
        let smooth = |level| at(&stops, Blend::Smooth, level).0;
        assert!((smooth(0.6) - 7.0).abs() <= 1e-12 && smooth(0.5) < linear(0.5).0);
    }

    #[test]
    fn a_ramp_without_stops_mixes_nothing() {
        assert!(mixture::<f64>(&[], Blend::Linear, 0.5).is_none());
        let one = [Stop::color(0.5, grey(2.0))];
        assert_eq!(at(&one, Blend::Smooth, 0.0).0, 2.0);
        assert_eq!(at(&one, Blend::Linear, 1.0).0, 2.0);
    }

    #[test]
    fn a_run_beyond_the_table_is_empty() {
        let stops = [Stop::color(0.0, grey(1.0)); 3];
        assert_eq!(Ramp::new(1, 2).stops(&stops).len(), 2);
        assert_eq!(Ramp::new(2, 2).stops(&stops).len(), 0);
        assert_eq!(Ramp::new(65_535, 65_535).stops(&stops).len(), 0);
    }
}

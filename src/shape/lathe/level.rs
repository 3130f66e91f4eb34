//! Rays at right angles to the axis: they stay at one height, and meet a profile where it comes
//! through that.
//!
//! A ray at the very height of a vertex or a disc is taken for two, one a little below and one a little
//! above: it is inside where one of them is.

use super::Known;
use super::profile::{Cubic, Piece, Spot, blossom, mix};
use super::sweep::Sweep;
use crate::roots::bernstein_crossings;
use crate::scalar::Real;
use crate::shape::crossings::{BOTH, Crossings, LOWER, UPPER};

/// A level ray, and the rules by which something goes through its height.
pub(super) struct Level<'a, T> {
    pub(super) sweep: &'a Sweep<T>,
    /// Both, or the one of the side to which a ray departs.
    pub(super) rules: u8,
}

impl<'a, T: Real> Level<'a, T> {
    pub(super) fn new(sweep: &'a Sweep<T>, known: Option<&Known<T>>) -> Self {
        let rules = match known {
            None => BOTH,
            // From a disc up or down; from anything else both are the same.
            Some(known) if known.normal[0] == T::ZERO => {
                if (T::ZERO < known.normal[1]) == known.inward { LOWER } else { UPPER }
            }
            Some(_) => LOWER,
        };
        Self { sweep, rules }
    }

    /// Offers where the ray meets a piece; where it starts on it that crossing is left out.
    #[inline(never)]
    pub(super) fn cross(
        &self,
        piece: &Piece<T>,
        known: Option<&Known<T>>,
        face: u32,
        out: &mut Crossings<T>,
    ) {
        let sweep = self.sweep;
        match (piece, known) {
            (Piece::Line([[a, b], [c, d]]), None) => {
                let share = (sweep.y - *b) / (*d - *b);
                let rho = mix([*a, *c], share.clamp(T::ZERO, T::ONE));
                self.offer(rho, self.rules_of([*b, *d]), face, out);
            }
            (Piece::Line([[_, b], [_, d]]), Some(known)) => {
                if *b != *d {
                    self.offer_partner(known, face, out);
                }
            }
            (Piece::Cubic(cubic), None) => self.cross_cubic(cubic, face, out),
            (Piece::Cubic(cubic), Some(known)) => {
                for end in [T::ZERO, T::ONE] {
                    self.depart(cubic, known, end, face, out);
                }
                self.offer_partner(known, face, out);
            }
        }
    }

    /// By which rules a monotone piece from one height to another comes through that of the ray: a height
    /// on the ray lies above the lower of two rays and below the upper one.
    fn rules_of(&self, heights: [T; 2]) -> u8 {
        let y = self.sweep.y;
        let [[a, b], [c, d]] = heights.map(|height| [height < y, y < height]);
        let lower = if a != c { LOWER } else { 0 };
        let upper = if b != d { UPPER } else { 0 };
        (lower | upper) & self.rules
    }

    /// Offers the two crossings of a circle of the surface.
    fn offer(&self, rho: T, rules: u8, face: u32, out: &mut Crossings<T>) {
        let Some(ends) = self.sweep.at_distance(rho).filter(|_| rules != 0) else {
            return;
        };
        // What departs follows one rule alone.
        let rules = if self.rules == BOTH { rules } else { BOTH };
        for t in ends {
            out.offer(t, face, rules);
        }
    }

    fn cross_cubic(&self, cubic: &Cubic<T>, face: u32, out: &mut Crossings<T>) {
        let heights = cubic.y.map(|y| y - self.sweep.y);
        let [first, .., last] = heights;
        let both = self.rules == BOTH && first != T::ZERO && last != T::ZERO;
        let rules: &[u8] = if both { &[BOTH] } else { &[LOWER, UPPER] };
        for &rule in rules {
            if rule & self.rules == 0 {
                continue;
            }
            // A height of 0 counts as above the ray.
            let turned = heights.map(|height| if rule == UPPER { -height } else { height });
            bernstein_crossings(&turned, |u| {
                self.offer(blossom(&cubic.rho, [u; 3]), rule, face, out);
            });
        }
    }

    /// Offers the crossings of the part of a cubic from the start of the ray to one end, but for that
    /// at the start, by whose share the heights are divided.
    fn depart(
        &self,
        cubic: &Cubic<T>,
        known: &Known<T>,
        end: T,
        face: u32,
        out: &mut Crossings<T>,
    ) {
        let [rho, [_, a, b, c]] = cubic.way(known.u, end);
        let sign = if self.rules == UPPER { -T::ONE } else { T::ONE };
        let heights = [a * T::from_i32(3), b * T::from_ratio(3, 2), c].map(|height| height * sign);
        bernstein_crossings(&heights, |v| {
            self.offer(known.spot[0] + blossom(&rho, [v; 3]), self.rules, face, out);
        });
    }

    /// Offers where a ray that starts on a circle of the surface meets it again.
    fn offer_partner(&self, known: &Known<T>, face: u32, out: &mut Crossings<T>) {
        let sweep = self.sweep;
        let t = -(sweep.along * T::TWO) / sweep.across;
        let [normal, _]: Spot<T> = known.normal;
        let t = if normal == T::ZERO {
            t
        } else if (T::ZERO < normal) == known.inward {
            // Towards the axis.
            t.abs()
        } else {
            -t.abs()
        };
        out.offer(t, face, BOTH);
    }
}

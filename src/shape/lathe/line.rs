//! The side of a conical frustum, a disc or a cylinder: what a line of a profile sweeps out.
//!
//! Seen from the axis a ray is a branch of a hyperbola, which is convex. So a line between two points on
//! its outer side meets it nowhere, one between a point here and one there once, and one between two points on
//! the side of the axis twice or not at all.

use super::Known;
use super::profile::Spot;
use super::sweep::Sweep;
use crate::scalar::Real;
use crate::shape::crossings::{BOTH, Crossings};

/// A line and its two ends: how far the ray is beyond them.
#[derive(Clone, Copy)]
pub(super) struct Line<T> {
    pub(super) from: Spot<T>,
    pub(super) to: Spot<T>,
    pub(super) beyond: [T; 2],
}

/// The quadratic whose roots are where a ray meets the cone of a line.
struct Quadratic<T> {
    a: T,
    b: T,
    c: T,
    discriminant: T,
    /// The factor of the root of the discriminant.
    rise: T,
}

impl<T: Real> Line<T> {
    /// The cone of the line, `rise·ρ = m0 + m1·t` along the ray.
    fn quadratic(&self, sweep: &Sweep<T>) -> Quadratic<T> {
        let ([a, b], [c, d]) = (self.from, self.to);
        let (rise, growth) = (d - b, c - a);
        let scale = rise.abs().max(growth.abs());
        let (rise, growth) = (rise / scale, growth / scale);
        // The end that is nearer in height gives the line with less rounding.
        let (below, above) = (b - sweep.y, d - sweep.y);
        let (rho, height) = if below.abs() <= above.abs() { (a, below) } else { (c, above) };
        let (m0, m1) = (rise * rho - growth * height, growth * sweep.dy);
        let [x, z] = sweep.place(T::ZERO);
        let [dx, dz] = sweep.heading();
        let (px, pz) = (m0 * dx - m1 * x, m0 * dz - m1 * z);
        Quadratic {
            a: rise.squared() * sweep.across - m1.squared(),
            b: rise.squared() * sweep.along - m0 * m1,
            c: rise.squared() * (x.squared() + z.squared()) - m0.squared(),
            discriminant: px.squared() + pz.squared() - (rise * sweep.moment).squared(),
            rise: rise.abs(),
        }
    }

    /// Offers where a ray that is not level meets the line.
    pub(super) fn cross(&self, sweep: &Sweep<T>, face: u32, out: &mut Crossings<T>) {
        let [first, second] = self.beyond.map(|beyond| beyond < T::ZERO);
        if first && second {
            return;
        }
        let [a, b] = [self.from, self.to].map(|[_, y]| sweep.at_height(y));
        let (low, high) = (a.min(b), a.max(b));
        if first != second {
            let falls = (a <= b) == second;
            let t = self.quadratic(sweep).root(falls);
            // Where rounding leaves no root the two ends are next to one another.
            let t = if t.is_finite() { t } else { low + (high - low) * T::HALF };
            out.offer(t.clamp(low, high), face, BOTH);
        } else if let Some(roots) = self.quadratic(sweep).both([low, high]) {
            for t in roots {
                out.offer(t, face, BOTH);
            }
        }
    }

    /// Offers where a ray that starts on the line meets it again.
    pub(super) fn cross_again(
        &self,
        sweep: &Sweep<T>,
        known: &Known<T>,
        face: u32,
        out: &mut Crossings<T>,
    ) {
        let Departing { slope, bend, height } = self.depart(sweep, known);
        let root = -slope / bend;
        let before = T::ZERO - known.u;
        let after = T::ONE - known.u;
        // On each side of the start: its sign there, and that at the end.
        if (T::ZERO < slope) != (self.beyond[0] < T::ZERO) {
            let u = if root.is_finite() { root.clamp(before, T::ZERO) } else { T::ZERO };
            out.offer(u * height, face, BOTH);
        }
        if (slope < T::ZERO) != (self.beyond[1] < T::ZERO) {
            let u = if root.is_finite() { root.clamp(T::ZERO, after) } else { T::ZERO };
            out.offer(u * height, face, BOTH);
        }
    }

    /// How far a ray that starts on the line is beyond its points, `u·(slope + u·bend)` where u counts
    /// from the start on in lengths of the line.
    pub(super) fn depart(&self, sweep: &Sweep<T>, known: &Known<T>) -> Departing<T> {
        let ([a, b], [c, d]) = (self.from, self.to);
        let (growth, height) = (c - a, sweep.above(d - b));
        let slope = (height * sweep.along - known.spot[0] * growth) * T::TWO;
        let bend = height.squared() * sweep.across - growth.squared();
        Departing { slope: known.fit(slope, false), bend, height }
    }
}

/// See [`Line::depart`].
pub(super) struct Departing<T> {
    pub(super) slope: T,
    pub(super) bend: T,
    /// The parameter from one end of the line to the other.
    height: T,
}

impl<T: Real> Departing<T> {
    /// The value at `u`.
    pub(super) fn at(&self, u: T) -> T {
        u * (self.slope + u * self.bend)
    }
}

impl<T: Real> Quadratic<T> {
    /// The root through which the value falls or rises as t grows, without cancellation; not finite where there is none.
    #[inline]
    fn root(&self, falls: bool) -> T {
        let root = self.discriminant.sqrt() * self.rise;
        let root = if falls { -root } else { root };
        // (root − b)/a, or c/(−root − b).
        if (self.b < T::ZERO) == falls && self.b != T::ZERO {
            self.c / (-root - self.b)
        } else {
            (root - self.b) / self.a
        }
    }

    /// The two roots strictly between two ends at which the value is positive.
    #[inline]
    fn both(&self, [low, high]: [T; 2]) -> Option<[T; 2]> {
        let middle = -self.b / self.a;
        let dips = self.a > T::ZERO && self.discriminant > T::ZERO && self.rise > T::ZERO;
        if !(dips && low < middle && middle < high) {
            return None;
        }
        let roots = [self.root(true).max(low), self.root(false).min(high)];
        (roots[0] < roots[1]).then_some(roots)
    }
}

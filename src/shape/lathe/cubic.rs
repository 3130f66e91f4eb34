//! What a cubic curve of a profile sweeps out.
//!
//! At the height of a point of the curve the ray is somewhere. How far that is from the axis, less how
//! far the point is, in squares, is a polynomial of degree 6 in the curve's parameter, and its roots are where the
//! ray meets the surface. The parts of the curve at whose height the ray is farther from the axis than the curve
//! ever comes are cut off first: nearly level rays are left with little more than a point of it, and so with
//! coefficients of the size of the solid.

use super::Known;
use super::profile::{
    Cubic, blossom, differences, greatest, least, mix, product, quadratic_blossom,
};
use super::sweep::Sweep;
use crate::roots::bernstein_crossings;
use crate::scalar::{Number, Real};
use crate::shape::crossings::{BOTH, Crossings};

/// A point between two parts of a curve.
#[derive(Clone, Copy)]
struct Station<T> {
    u: T,
    /// The ray's parameter at its height.
    t: T,
    rho: T,
    /// How far the ray is beyond it.
    beyond: T,
}

/// A ray and a curve.
struct Pass<'a, T> {
    sweep: &'a Sweep<T>,
    cubic: &'a Cubic<T>,
    /// The ray's parameter at the height of the curve.
    t: [T; 4],
    /// Where the ray is near enough to the axis.
    window: [T; 2],
    /// Parts of the curve lie outside of it; those that are left are monotone.
    clipped: bool,
    face: u32,
}

impl<T: Real> Cubic<T> {
    /// Offers where a ray that is not level meets the curve; the ends tell how far the ray is beyond
    /// them. Where a ray starts on the curve that crossing is left out.
    #[inline(never)]
    pub(super) fn cross(
        &self,
        sweep: &Sweep<T>,
        beyond: [T; 2],
        known: Option<&Known<T>>,
        face: u32,
        out: &mut Crossings<T>,
    ) {
        let t = self.y.map(|y| sweep.at_height(y));
        let (low, high) = (least(t), greatest(t));
        let window = sweep.window(greatest(self.rho.map(Number::abs)));
        let outside = known.is_none() && beyond.iter().all(|beyond| !(*beyond < T::ZERO));
        if outside && window.is_none_or(|[enter, exit]| high < enter || exit < low) {
            return;
        }
        let [t_first, .., t_last] = t;
        let [rho_first, .., rho_last] = self.rho;
        let first = Station { u: T::ZERO, t: t_first, rho: rho_first, beyond: beyond[0] };
        let last = Station { u: T::ONE, t: t_last, rho: rho_last, beyond: beyond[1] };
        let mut window = window.unwrap_or([T::ZERO; 2]);
        for end in [&first, &last].into_iter().filter(|end| end.beyond < T::ZERO) {
            window = [window[0].min(end.t), window[1].max(end.t)];
        }
        let clipped = low < window[0] || window[1] < high;
        let pass = Pass { sweep, cubic: self, t, window, clipped, face };
        let mut from = first;
        for cut in cuts(&t, clipped, known.map(|known| known.u)) {
            let to = if cut < T::ONE { pass.station(cut) } else { last };
            match known {
                Some(known) if from.u == known.u => pass.depart(known, &to, out),
                Some(known) if to.u == known.u => pass.depart(known, &from, out),
                _ => pass.part(from, to, out),
            }
            from = to;
        }
        if let Some(known) = known {
            // At an end of the curve one side of the start is no part of it.
            let before = known.u == T::ZERO && known.rises != (beyond[0] < T::ZERO);
            let after = known.u == T::ONE && known.rises == (beyond[1] < T::ZERO);
            if before || after {
                out.offer(T::ZERO, face, BOTH);
            }
        }
    }

    /// The control points of the part from `from` to `to`, as seen from its first point: however short
    /// it is, they are as exact as the whole.
    pub(super) fn way(&self, from: T, to: T) -> [[T; 4]; 2] {
        let width = to - from;
        [self.rho, self.y].map(|control| {
            let step = differences(control);
            let [a, b, c] = [[from, from], [from, to], [to, to]]
                .map(|ends| quadratic_blossom(&step, ends) * width);
            [T::ZERO, a, a + b, a + b + c]
        })
    }
}

/// Where to part a curve, in ascending order: at the parameter of a start, and, if it is to be clipped,
/// where its height turns; last at its end.
fn cuts<T: Real>(t: &[T; 4], clipped: bool, start: Option<T>) -> impl Iterator<Item = T> {
    let mut found = [T::ONE; 3];
    let mut add = |mut cut: T| {
        for slot in &mut found {
            if cut < *slot {
                core::mem::swap(slot, &mut cut);
            }
        }
    };
    if let Some(u) = start.filter(|u| T::ZERO < *u) {
        add(u);
    }
    if clipped {
        bernstein_crossings(&differences(*t), |u| {
            if T::ZERO < u && start != Some(u) {
                add(u);
            }
        });
    }
    found.into_iter().filter(|cut| *cut < T::ONE).chain([T::ONE])
}

impl<T: Real> Pass<'_, T> {
    fn station(&self, u: T) -> Station<T> {
        let (t, rho) = (blossom(&self.t, [u; 3]), blossom(&self.cubic.rho, [u; 3]));
        Station { u, t, rho, beyond: self.sweep.beyond(rho, t) }
    }

    /// All of a part lies on one side of the window.
    fn is_outside(&self, from: T, to: T) -> bool {
        let [enter, exit] = self.window;
        self.clipped && ((from < enter && to < enter) || (exit < from && exit < to))
    }

    /// The end of a part, drawn to the window if it lies outside; `t` are its parameters on the ray.
    fn clip(&self, from: T, end: Station<T>, [a, b, c, d]: [T; 4]) -> Station<T> {
        let limit = end.t.clamp(self.window[0], self.window[1]);
        if !self.clipped || limit == end.t {
            return end;
        }
        let mut share = T::ONE;
        let control = [a - limit, b - limit, c - limit, d - limit];
        bernstein_crossings(&control, |v| share = v);
        let u = mix([from, end.u], share);
        let rho = blossom(&self.cubic.rho, [u; 3]);
        let beyond = self.sweep.beyond(rho, limit).max(T::ZERO);
        Station { u, t: limit, rho, beyond }
    }

    /// Control points of a part between two stations.
    fn control(&self, of: &[T; 4], [a, b]: [T; 2], [from, to]: [T; 2]) -> [T; 4] {
        let [c, d] = [blossom(of, [a, a, b]), blossom(of, [a, b, b])];
        [from, c, d, to]
    }

    /// The parameters on the ray of a part between two stations.
    fn times(&self, from: &Station<T>, to: &Station<T>) -> [T; 4] {
        self.monotone(self.control(&self.t, [from.u, to.u], [from.t, to.t]))
    }

    /// Of a part that is monotone and so short that rounding shows, the control points where they can be.
    fn monotone(&self, [a, b, c, d]: [T; 4]) -> [T; 4] {
        if !self.clipped {
            return [a, b, c, d];
        }
        // A slope of 0 at one end and none elsewhere: 4/3 of the way at most.
        let (way, third) = (d - a, T::from_ratio(4, 3));
        let (near, far) = (a + way * third, d - way * third);
        [a, b.clamp(a.min(near), a.max(near)), c.clamp(far.min(d), far.max(d)), d]
    }

    /// Offers the crossings of a part.
    #[inline(never)]
    fn part(&self, from: Station<T>, to: Station<T>, out: &mut Crossings<T>) {
        if self.is_outside(from.t, to.t) {
            return;
        }
        let t = self.times(&from, &to);
        let [a, b, c, d] = t;
        let (from, to) = (self.clip(to.u, from, [d, c, b, a]), self.clip(from.u, to, t));
        let t = self.times(&from, &to);
        let rho = self.control(&self.cubic.rho, [from.u, to.u], [from.rho, to.rho]);
        let places = t.map(|t| self.sweep.place(t));
        let [x, z] = [places.map(|[x, _]| x), places.map(|[_, z]| z)];
        let mut beyond = product(&x, &x);
        for (control, sign) in [(&z, T::ONE), (&rho, -T::ONE)] {
            for (sum, part) in beyond.iter_mut().zip(product(control, control)) {
                *sum += part * sign;
            }
        }
        let [first, .., last] = &mut beyond;
        (*first, *last) = (from.beyond, to.beyond);
        bernstein_crossings(&beyond, |v| out.offer(blossom(&t, [v; 3]), self.face, BOTH));
    }

    /// Offers the crossings of the part between the start of the ray and a station, but for the one
    /// at the start: there the polynomial is 0, and so it is divided by the parameter.
    #[inline(never)]
    fn depart(&self, known: &Known<T>, to: &Station<T>, out: &mut Crossings<T>) {
        let sweep = self.sweep;
        let times = |u: T| {
            let [rho, y] = self.cubic.way(known.u, u);
            [rho, y.map(|y| sweep.above(y))]
        };
        let [_, t] = times(to.u);
        let [.., end] = t;
        if self.is_outside(T::ZERO, end) {
            return;
        }
        let to = self.clip(known.u, Station { t: end, ..*to }, t);
        let [rho, [a, b, c, _]] = times(to.u);
        let t = self.monotone([a, b, c, to.t]);
        let mut linear = [T::ZERO; 4];
        for ((sum, t), rho) in linear.iter_mut().zip(t).zip(rho) {
            *sum = (t * sweep.along - known.spot[0] * rho) * T::TWO;
        }
        let [linear, times, distances] =
            [product(&linear, &[T::ONE; 4]), product(&t, &t), product(&rho, &rho)];
        let terms = linear.iter().zip(&times).zip(&distances);
        let mut beyond = [T::ZERO; 6];
        for ((to, power), ((linear, time), distance)) in
            beyond.iter_mut().zip(1..).zip(terms.skip(1))
        {
            let value = *linear + (*time * sweep.across - *distance);
            *to = value * T::from_ratio(6, power);
        }
        let [first, .., last] = &mut beyond;
        *first = known.fit(*first, to.u < known.u);
        *last = to.beyond;
        bernstein_crossings(&beyond, |v| out.offer(blossom(&t, [v; 3]), self.face, BOTH));
    }
}

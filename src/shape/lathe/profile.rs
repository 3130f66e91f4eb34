//! The profile of a surface of revolution: pieces of lines or of cubics in the plane of the distance from the axis
//! and the height.

use super::Curve;
use crate::roots::bernstein_crossings;
use crate::scalar::{Number, Real, Scalar, Vector};

/// A distance from the axis and a height.
pub(super) type Spot<T> = [T; 2];

/// A profile as it lies in the table of points.
#[derive(Clone, Copy)]
pub(super) struct Profile<'a, S: Scalar> {
    pub(super) points: &'a [S::Vec3],
    pub(super) curve: Curve,
}

impl<'a, S: Scalar> Profile<'a, S> {
    /// Its pieces in order; each begins where the one before ends.
    #[inline]
    pub(super) fn pieces(&self) -> impl Iterator<Item = Piece<S::Wide>> + Clone + use<'a, S> {
        let (lines, cubics): (&[_], &[_]) = match self.curve {
            Curve::Lines => (self.points, &[]),
            Curve::Cubics => (&[], self.points),
        };
        let lines = lines.windows(2).filter_map(|ends| match ends {
            [a, b] => Some(Piece::Line([*a, *b].map(spot::<S>))),
            _ => None,
        });
        let cubics = cubics.windows(4).step_by(3).filter_map(|control| match control {
            [a, b, c, d] => Some(Piece::Cubic(Cubic::new([*a, *b, *c, *d].map(spot::<S>)))),
            _ => None,
        });
        lines.chain(cubics)
    }

    /// The piece of this index.
    #[inline]
    pub(super) fn piece(&self, index: u32) -> Option<Piece<S::Wide>> {
        let steps = if self.curve == Curve::Lines { 1 } else { 3 };
        let first = (index as usize).saturating_mul(steps);
        let points = self.points.get(first..first.saturating_add(steps + 1));
        Self { points: points?, curve: self.curve }.pieces().next()
    }

    /// The first point and the last.
    #[inline]
    pub(super) fn ends(&self) -> Option<[S::Vec3; 2]> {
        Some([*self.points.first()?, *self.points.last()?])
    }

    /// Begins and ends at the same place.
    #[inline]
    pub(super) fn is_ring(&self) -> bool {
        self.ends().is_some_and(|[first, last]| first == last)
    }

    /// Together with the axis it goes around an area.
    pub(super) fn is_closed(&self) -> bool {
        let on_axis = |p: S::Vec3| p.x() == S::ZERO;
        self.is_ring() || self.ends().is_some_and(|ends| ends.into_iter().all(on_axis))
    }
}

#[inline]
fn spot<S: Scalar>(p: S::Vec3) -> Spot<S::Wide> {
    [p.x().widen(), p.y().widen()]
}

/// A part of a profile.
#[derive(Clone, Copy, Debug)]
pub(super) enum Piece<T> {
    /// From one point to another.
    Line([Spot<T>; 2]),
    /// A curve.
    Cubic(Cubic<T>),
}

/// A cubic curve by its control points, in Bernstein's basis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cubic<T> {
    /// Distances from the axis.
    pub(super) rho: [T; 4],
    /// Heights.
    pub(super) y: [T; 4],
}

/// A point of a piece.
#[derive(Clone, Copy, Debug)]
pub(super) struct Foot<T> {
    /// Where on the piece, in 0..=1.
    pub(super) u: T,
    pub(super) spot: Spot<T>,
    /// The direction of the piece there; its greater part is 1 or −1.
    pub(super) tangent: Spot<T>,
}

impl<T: Real> Piece<T> {
    /// Its two ends.
    pub(super) fn ends(&self) -> [Spot<T>; 2] {
        match self {
            Self::Line(ends) => *ends,
            Self::Cubic(Cubic { rho: [a, .., d], y: [e, .., h] }) => [[*a, *e], [*d, *h]],
        }
    }

    /// The point of the piece that is nearest to a place close to it.
    pub(super) fn foot(&self, near: Spot<T>) -> Foot<T> {
        match self {
            Self::Line([[a, b], [c, d]]) => {
                let (rho, y) = (*c - *a, *d - *b);
                let scale = rho.abs().max(y.abs());
                let tangent = scaled([rho, y]);
                let square = tangent[0].squared() + tangent[1].squared();
                let way = (near[0] - *a) * tangent[0] + (near[1] - *b) * tangent[1];
                let u = (way / (square * scale)).clamp(T::ZERO, T::ONE);
                let spot = [mix([*a, *c], u), mix([*b, *d], u)];
                Foot { u, spot, tangent }
            }
            Self::Cubic(cubic) => cubic.foot(near),
        }
    }

    /// The greatest distance of the piece from the axis, or more.
    pub(super) fn reach(&self) -> T {
        match self {
            Self::Line([[a, _], [b, _]]) => a.max(*b),
            Self::Cubic(cubic) => greatest(cubic.rho.map(Number::abs)),
        }
    }

    /// The least height of the piece and the greatest, or beyond.
    pub(super) fn heights(&self) -> [T; 2] {
        match self {
            Self::Line([[_, a], [_, b]]) => [a.min(*b), a.max(*b)],
            Self::Cubic(cubic) => [least(cubic.y), greatest(cubic.y)],
        }
    }

    /// The least distance of the piece from the axis and the greatest, or beyond.
    pub(super) fn distances(&self) -> [T; 2] {
        match self {
            Self::Line([[a, _], [b, _]]) => [a.min(*b), a.max(*b)],
            Self::Cubic(cubic) => [least(cubic.rho), greatest(cubic.rho)],
        }
    }

    /// About how long it is: of a curve, between the chord and the way along the control points.
    pub(super) fn length(&self) -> T {
        let distance = |[a, b]: Spot<T>, [c, d]: Spot<T>| {
            let (rho, y) = ((c - a).abs(), (d - b).abs());
            let scale = rho.max(y);
            if scale == T::ZERO {
                return scale;
            }
            ((rho / scale).squared() + (y / scale).squared()).sqrt() * scale
        };
        let [from, to] = self.ends();
        let chord = distance(from, to);
        let Self::Cubic(Cubic { rho: [_, a, b, _], y: [_, c, d, _] }) = self else {
            return chord;
        };
        let (second, third) = ([*a, *c], [*b, *d]);
        let around = distance(from, second) + distance(second, third) + distance(third, to);
        (chord + around) * T::HALF
    }
}

impl<T: Real> Cubic<T> {
    pub(super) fn new([a, b, c, d]: [Spot<T>; 4]) -> Self {
        Self { rho: [a[0], b[0], c[0], d[0]], y: [a[1], b[1], c[1], d[1]] }
    }

    /// The point at `u`.
    #[inline]
    pub(super) fn at(&self, u: T) -> Spot<T> {
        [blossom(&self.rho, [u; 3]), blossom(&self.y, [u; 3])]
    }

    /// The direction at `u`; where the derivative vanishes, that of the next one that does not.
    fn tangent(&self, u: T) -> Spot<T> {
        let (rho, y) = (differences(self.rho), differences(self.y));
        let first = [&rho, &y].map(|d| quadratic_blossom(d, [u; 2]));
        if first[0] != T::ZERO || first[1] != T::ZERO {
            return first;
        }
        let bend = |[a, b, c]: &[T; 3]| mix([*b - *a, *c - *b], u);
        let second = [bend(&rho), bend(&y)];
        if second[0] != T::ZERO || second[1] != T::ZERO {
            // Forward from here, or backward to here.
            return if u <= T::HALF { second } else { [-second[0], -second[1]] };
        }
        let [[a, .., b], [c, .., d]] = [self.rho, self.y];
        [b - a, d - c]
    }

    /// The integral of the distance from the axis over the height.
    pub(super) fn area(&self) -> T {
        // Half the sum of the coefficients is three times their mean.
        let product = product_cubic_quadratic(&self.rho, &differences(self.y));
        product.into_iter().fold(T::ZERO, |sum, part| sum + part) * T::HALF
    }

    /// Where the way to a place is at right angles to the curve, or an end: what is nearest of these.
    fn foot(&self, near: Spot<T>) -> Foot<T> {
        let (mut best, mut distance) = (T::ZERO, T::FAR);
        let mut offer = |u: T| {
            let [rho, y] = self.at(u);
            let square = (rho - near[0]).squared() + (y - near[1]).squared();
            if square < distance {
                (best, distance) = (u, square);
            }
        };
        offer(T::ZERO);
        offer(T::ONE);
        let along = self.along(near);
        bernstein_crossings(&along, &mut offer);
        Foot { u: best, spot: self.at(best), tangent: scaled(self.tangent(best)) }
    }

    /// The product of the way from a place and the curve's direction, in Bernstein's basis.
    fn along(&self, near: Spot<T>) -> [T; 6] {
        let mut sum = [T::ZERO; 6];
        for (control, near) in [(self.rho, near[0]), (self.y, near[1])] {
            let (way, step) = (control.map(|c| c - near), differences(control));
            for (to, part) in sum.iter_mut().zip(product_cubic_quadratic(&way, &step)) {
                *to += part;
            }
        }
        sum
    }
}

/// A direction whose greater part is 1 or −1.
fn scaled<T: Real>([rho, y]: Spot<T>) -> Spot<T> {
    let scale = rho.abs().max(y.abs());
    [rho / scale, y / scale]
}

/// Between two numbers, in shares of the way; exact at the ends.
#[inline]
pub(super) fn mix<T: Real>([a, b]: [T; 2], u: T) -> T {
    a * (T::ONE - u) + b * u
}

/// From each coefficient to the next: the derivative, but for a factor of 3.
#[inline]
pub(super) fn differences<T: Real>([a, b, c, d]: [T; 4]) -> [T; 3] {
    [b - a, c - b, d - c]
}

/// The symmetric form of a cubic, linear in each of three parameters; the value where they are equal.
///
/// Source: L. Ramshaw, "Blossoming: A Connect-the-Dots Approach to Splines" (1987).
#[inline]
pub(super) fn blossom<T: Real>([a, b, c, d]: &[T; 4], [u, v, w]: [T; 3]) -> T {
    let first = [mix([*a, *b], u), mix([*b, *c], u), mix([*c, *d], u)];
    quadratic_blossom(&first, [v, w])
}

/// The same of a quadratic.
#[inline]
pub(super) fn quadratic_blossom<T: Real>([a, b, c]: &[T; 3], [u, v]: [T; 2]) -> T {
    mix([mix([*a, *b], u), mix([*b, *c], u)], v)
}

/// The product of two cubics in Bernstein's basis.
///
/// Source: G. Farin, *Curves and Surfaces for CAGD*, section 5.
#[inline]
pub(super) fn product<T: Real>([a, b, c, d]: &[T; 4], [e, f, g, h]: &[T; 4]) -> [T; 7] {
    let (fifth, three) = (T::from_ratio(1, 5), T::from_i32(3));
    let nine = T::from_i32(9);
    [
        *a * *e,
        (*a * *f + *b * *e) * T::HALF,
        ((*a * *g + *c * *e) + three * *b * *f) * fifth,
        ((*a * *h + *d * *e) + nine * (*b * *g + *c * *f)) * (fifth * T::HALF * T::HALF),
        ((*b * *h + *d * *f) + three * *c * *g) * fifth,
        (*c * *h + *d * *g) * T::HALF,
        *d * *h,
    ]
}

/// The product of a cubic and a quadratic in Bernstein's basis.
fn product_cubic_quadratic<T: Real>([a, b, c, d]: &[T; 4], [e, f, g]: &[T; 3]) -> [T; 6] {
    let (fifth, tenth) = (T::from_ratio(1, 5), T::from_ratio(1, 10));
    let (two, three, six) = (T::TWO, T::from_i32(3), T::from_i32(6));
    [
        *a * *e,
        (two * *a * *f + three * *b * *e) * fifth,
        ((*a * *g + three * *c * *e) + six * *b * *f) * tenth,
        ((*d * *e + three * *b * *g) + six * *c * *f) * tenth,
        (two * *d * *f + three * *c * *g) * fifth,
        *d * *g,
    ]
}

/// The greatest of some numbers.
#[inline]
pub(super) fn greatest<T: Real, const N: usize>(numbers: [T; N]) -> T {
    numbers.into_iter().fold(-T::FAR, Number::max)
}

/// The least of some numbers.
#[inline]
pub(super) fn least<T: Real, const N: usize>(numbers: [T; N]) -> T {
    numbers.into_iter().fold(T::FAR, Number::min)
}

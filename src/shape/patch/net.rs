//! A net of control points as a ray sees it: in the two coordinates across the ray.

use crate::scalar::Real;

/// Two coordinates: across the ray, or the two parameters.
pub(super) type Pair<T> = [T; 2];

/// Four control points of a curve.
type Cubic<T> = [Pair<T>; 4];

/// One of the two parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    U,
    V,
}

/// Four rows, one after another along v, of four points along u.
#[derive(Clone, Copy, Debug)]
pub(super) struct Net<T>(pub(super) [Cubic<T>; 4]);

/// A point of a patch across the ray, and its derivatives along u and v.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place<T> {
    pub(super) at: Pair<T>,
    pub(super) du: Pair<T>,
    pub(super) dv: Pair<T>,
}

/// How much of a net can be told from a line or from a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Extent {
    /// It has an area, or is too short to be told from one.
    Area,
    /// All lies on a line, and far apart.
    Line,
    /// All lies in one place.
    Point,
}

/// The share of the plane that two vectors span, with its sign.
#[inline]
pub(super) fn cross<T: Real>([ax, ay]: Pair<T>, [bx, by]: Pair<T>) -> T {
    ax * by - ay * bx
}

#[inline]
pub(super) fn minus<T: Real>([ax, ay]: Pair<T>, [bx, by]: Pair<T>) -> Pair<T> {
    [ax - bx, ay - by]
}

#[inline]
fn plus<T: Real>([ax, ay]: Pair<T>, [bx, by]: Pair<T>) -> Pair<T> {
    [ax + bx, ay + by]
}

/// The sum of the magnitudes: at most √2 times the length, and never less.
#[inline]
pub(super) fn reach<T: Real>([x, y]: Pair<T>) -> T {
    x.abs() + y.abs()
}

#[inline]
fn middle<T: Real>(a: Pair<T>, b: Pair<T>) -> Pair<T> {
    plus(a, b).map(|x| x * T::HALF)
}

/// The two halves of a curve, by de Casteljau's construction.
#[inline]
fn halves<T: Real>([a, b, c, d]: Cubic<T>) -> (Cubic<T>, Cubic<T>) {
    let (ab, bc, cd) = (middle(a, b), middle(b, c), middle(c, d));
    let (abc, bcd) = (middle(ab, bc), middle(bc, cd));
    let centre = middle(abc, bcd);
    ([a, ab, abc, centre], [centre, bcd, cd, d])
}

/// Bernstein's polynomials of degree 3.
#[inline]
pub(super) fn weights<T: Real>(s: T) -> [T; 4] {
    let (r, three) = (T::ONE - s, T::from_i32(3));
    let (ss, rr, rs) = (s * s, r * r, three * r * s);
    [rr * r, rs * r, rs * s, ss * s]
}

/// Their derivatives.
#[inline]
pub(super) fn slopes<T: Real>(s: T) -> [T; 4] {
    let (r, three) = (T::ONE - s, T::from_i32(3));
    let (ss, rr, rs) = (s * s * three, r * r * three, r * s * three * T::TWO);
    [-rr, rr - rs, rs - ss, ss]
}

#[inline]
fn blend<T: Real>([a, b, c, d]: &Cubic<T>, [wa, wb, wc, wd]: [T; 4]) -> Pair<T> {
    [
        a[0] * wa + b[0] * wb + (c[0] * wc + d[0] * wd),
        a[1] * wa + b[1] * wb + (c[1] * wc + d[1] * wd),
    ]
}

/// All numbers lie farther than `margin` from 0, on one side.
#[inline]
fn on_one_side<T: Real>(values: impl Iterator<Item = T>, margin: T) -> bool {
    let (mut above, mut below) = (true, true);
    for value in values {
        above &= value > margin;
        below &= value < -margin;
        if !(above || below) {
            return false;
        }
    }
    above || below
}

/// The directions between two of them, less than half a turn counterclockwise.
type Cone<T> = Option<[Pair<T>; 2]>;

/// Takes a direction into a cone; false where that would make it half a turn or more. A zero
/// vector has no direction.
#[inline]
fn takes<T: Real>(cone: &mut Cone<T>, v: Pair<T>) -> bool {
    let zero = T::ZERO;
    if v == [zero, zero] {
        return true;
    }
    let Some([low, high]) = cone else {
        *cone = Some([v, v]);
        return true;
    };
    let (from_low, to_high) = (cross(*low, v), cross(v, *high));
    if from_low > zero && to_high >= zero || from_low == zero && to_high > zero {
        return true;
    }
    if from_low < zero && to_high > zero {
        *low = v;
    } else if from_low > zero && to_high < zero {
        *high = v;
    } else {
        // Along the only direction so far, or against it.
        return from_low == zero && to_high == zero && low[0] * v[0] + low[1] * v[1] > zero;
    }
    true
}

impl<T: Real> Net<T> {
    fn points(&self) -> impl Iterator<Item = Pair<T>> {
        self.0.iter().flatten().copied()
    }

    /// The columns, each along v.
    fn columns(&self) -> impl Iterator<Item = Cubic<T>> {
        let [a, b, c, d] = &self.0;
        let rows = a.iter().zip(b).zip(c).zip(d);
        rows.map(|(((a, b), c), d)| [*a, *b, *c, *d])
    }

    /// Cuts the net in the middle: it keeps the lower half, the other becomes the upper one.
    pub(super) fn halve(&mut self, upper: &mut Self, way: Way) {
        if way == Way::U {
            for (low, high) in self.0.iter_mut().zip(&mut upper.0) {
                (*low, *high) = halves(*low);
            }
            return;
        }
        let ([a, b, c, d], [e, f, g, h]) = (&mut self.0, &mut upper.0);
        let low = a.iter_mut().zip(b).zip(c).zip(d);
        let high = e.iter_mut().zip(f).zip(g).zip(h);
        for ((((a, b), c), d), (((e, f), g), h)) in low.zip(high) {
            ([*a, *b, *c, *d], [*e, *f, *g, *h]) = halves([*a, *b, *c, *d]);
        }
    }

    /// The greatest coordinate.
    pub(super) fn size(&self) -> T {
        self.points().fold(T::ZERO, |most, [x, y]| most.max(x.abs()).max(y.abs()))
    }

    /// No point of the net, moved by `margin` at most, is on the ray: a line across separates
    /// them. The lines tried lie along the coordinates and along the net's own two ways, which settles all
    /// nets that are nearly a parallelogram.
    pub(super) fn misses(&self, margin: T) -> bool {
        if on_one_side(self.points().map(|[x, _]| x), margin)
            || on_one_side(self.points().map(|[_, y]| y), margin)
        {
            return true;
        }
        let [[a, _, _, b], _, _, [c, _, _, d]] = self.0;
        let along_u = plus(minus(b, a), minus(d, c));
        let along_v = plus(minus(c, a), minus(d, b));
        [along_u, along_v]
            .into_iter()
            .any(|way| on_one_side(self.points().map(|p| cross(way, p)), margin * reach(way)))
    }

    /// The sign of the area that du and dv span, where it is the same for a du and a dv anywhere in the net, by
    /// more than rounding: then no two points of the patch are in the same place.
    ///
    /// Between two points of a convex domain the patch moves by the mean of its du and the mean of its dv on the
    /// way; both lie in the cones of the net's differences, and such a pair is linearly independent.
    pub(super) fn facing(&self, error: T) -> Option<i8> {
        let (mut along_u, mut along_v) = (None, None);
        for &[a, b, c, d] in &self.0 {
            let differences = [minus(b, a), minus(c, b), minus(d, c)];
            if !differences.into_iter().all(|v| takes(&mut along_u, v)) {
                return None;
            }
        }
        for [a, b, c, d] in self.columns() {
            let differences = [minus(b, a), minus(c, b), minus(d, c)];
            if !differences.into_iter().all(|v| takes(&mut along_v, v)) {
                return None;
            }
        }
        let (along_u, along_v) = (along_u?, along_v?);
        let (mut positive, mut negative) = (true, true);
        for u in along_u {
            for v in along_v {
                let (area, margin) = (cross(u, v), error * (reach(u) + reach(v)));
                positive &= area > margin;
                negative &= area < -margin;
            }
        }
        match (positive, negative) {
            (true, _) => Some(1),
            (_, true) => Some(-1),
            _ => None,
        }
    }

    /// The parameter along which the net is longer, by its inner rows and columns.
    pub(super) fn longer_way(&self) -> Way {
        let longest = |[a, b, c, d]: Cubic<T>| {
            let steps = [minus(b, a), minus(c, b), minus(d, c)].map(reach);
            steps.into_iter().fold(T::ZERO, T::max)
        };
        let [[_, a, b, _], row, other_row, [_, g, h, _]] = self.0;
        let ([_, c, d, _], [_, e, f, _]) = (row, other_row);
        let along_u = longest(row).max(longest(other_row));
        let along_v = longest([a, c, e, g]).max(longest([b, d, f, h]));
        if along_u < along_v { Way::V } else { Way::U }
    }

    /// What the net is, to within `least`.
    pub(super) fn extent(&self, least: T) -> Extent {
        let [[a, _, _, b], _, _, [c, _, _, d]] = self.0;
        let from_corner = || self.points().map(|p| minus(p, a));
        if from_corner().all(|[x, y]| x.abs() <= least && y.abs() <= least) {
            return Extent::Point;
        }
        let (first, second) = (minus(d, a), minus(c, b));
        let axis = if reach(first) < reach(second) { second } else { first };
        let width = least * reach(axis);
        let on_line = reach(axis) > least * T::from_i32(64)
            && from_corner().all(|p| cross(axis, p).abs() <= width);
        if on_line { Extent::Line } else { Extent::Area }
    }

    /// A point of the patch.
    pub(super) fn place(&self, [u, v]: Pair<T>) -> Place<T> {
        let (along_u, slopes_u) = (weights(u), slopes(u));
        let (along_v, slopes_v) = (weights(v), slopes(v));
        let [a, b, c, d] = &self.0;
        let points = [a, b, c, d].map(|row| blend(row, along_u));
        let steps = [a, b, c, d].map(|row| blend(row, slopes_u));
        Place {
            at: blend(&points, along_v),
            du: blend(&steps, along_v),
            dv: blend(&points, slopes_v),
        }
    }
}

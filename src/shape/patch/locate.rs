//! Points of a patch in space: by their parameters, and the parameters of a point.

use super::Patches;
use super::net::{Pair, slopes, weights};
use crate::scalar::{Number, Real, Scalar, Vector};
use crate::shape::Tables;

/// How many points of a patch the search for the nearest one computes at most.
const POINTS_MAX: u32 = 24;

/// A point of a patch and its derivatives along u and v, in local coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot<S: Scalar> {
    pub(super) patch: u16,
    pub(super) at: Pair<S::Wide>,
    pub(super) point: S::WideVec,
    pub(super) du: S::WideVec,
    pub(super) dv: S::WideVec,
}

impl<S: Scalar> Patches<S> {
    /// A point of a patch with its derivatives; zero for a patch that does not exist.
    pub(super) fn spot(&self, tables: &Tables<'_, S>, patch: u16, at: Pair<S::Wide>) -> Spot<S> {
        let zero = S::WideVec::ZERO;
        let mut spot = Spot { patch, at, point: zero, du: zero, dv: zero };
        let Some(indices) = self.indices(tables, patch) else {
            return spot;
        };
        let center = S::widen_vec(self.center);
        let [u, v] = at;
        let (along_u, slopes_u) = (weights(u), slopes(u));
        let rows = indices.chunks_exact(4).zip(weights(v)).zip(slopes(v));
        for ((row, weight), slope) in rows {
            let (mut point, mut du) = (zero, zero);
            for ((&index, weight), slope) in row.iter().zip(along_u).zip(slopes_u) {
                let control = tables.points.get(index as usize).copied().unwrap_or_default();
                let control = S::widen_vec(control) - center;
                point += control * weight;
                du += control * slope;
            }
            spot.point += point * weight;
            spot.du += du * weight;
            spot.dv += point * slope;
        }
        spot
    }

    /// A point of a patch.
    pub(super) fn point(
        &self,
        tables: &Tables<'_, S>,
        patch: u16,
        [u, v]: Pair<S::Wide>,
    ) -> S::WideVec {
        let center = S::widen_vec(self.center);
        let indices = self.indices(tables, patch).unwrap_or(&[]);
        let along_u = weights(u);
        let mut sum = S::WideVec::ZERO;
        for (row, weight) in indices.chunks_exact(4).zip(weights(v)) {
            let mut point = S::WideVec::ZERO;
            for (&index, weight) in row.iter().zip(along_u) {
                let control = tables.points.get(index as usize).copied().unwrap_or_default();
                point += (S::widen_vec(control) - center) * weight;
            }
            sum += point * weight;
        }
        sum
    }

    /// The point of a patch nearest to a point close to it, from a guess, and the square of its distance.
    ///
    /// Gauss and Newton's method for least squares; a step that does not come nearer is halved, one that leaves
    /// the patch goes on along its side.
    #[inline(never)]
    fn nearest_from(
        &self,
        tables: &Tables<'_, S>,
        patch: u16,
        to: S::WideVec,
        guess: Pair<S::Wide>,
    ) -> (Spot<S>, S::Wide) {
        let mut spot = self.spot(tables, patch, guess);
        let mut distance = (to - spot.point).length_squared();
        let mut share = S::Wide::ONE;
        let small = S::EPSILON_ROOT.widen() * S::Wide::from_ratio(1, 16);
        for _ in 0..POINTS_MAX {
            let next = step(&spot, to, share);
            let moved = [next[0] - spot.at[0], next[1] - spot.at[1]];
            if moved[0].abs().max(moved[1].abs()) <= small {
                // What a further step would change is less than rounding.
                spot.at = next;
                spot.point += spot.du * moved[0] + spot.dv * moved[1];
                break;
            }
            let there = self.spot(tables, patch, next);
            let nearer = (to - there.point).length_squared();
            if nearer < distance {
                (spot, distance, share) = (there, nearer, S::Wide::ONE);
            } else {
                share *= S::Wide::HALF;
            }
        }
        (spot, distance)
    }

    /// The point of a patch nearest to a local point close to it; `guess` is within a few hundredths,
    /// or the point is far away and any answer will do.
    pub(super) fn nearest(
        &self,
        tables: &Tables<'_, S>,
        patch: u16,
        to: S::WideVec,
        guess: Pair<S::Wide>,
    ) -> Spot<S> {
        let (mut spot, mut distance) = self.nearest_from(tables, patch, to, guess);
        let size = self.size(tables, patch);
        if distance <= size * size * S::Wide::from_ratio(1, 1024) {
            return spot;
        }
        for v in [1, 3, 5] {
            for u in [1, 3, 5] {
                let guess = [u, v].map(|n| S::Wide::from_ratio(n, 6));
                let (other, nearer) = self.nearest_from(tables, patch, to, guess);
                if nearer < distance {
                    (spot, distance) = (other, nearer);
                }
            }
        }
        spot
    }

    /// The normal at a pair of parameters; where the patch is degenerate there, that of a point close by.
    pub(super) fn normal_at(
        &self,
        tables: &Tables<'_, S>,
        patch: u16,
        at: Pair<S::Wide>,
    ) -> S::WideVec {
        let size = self.size(tables, patch);
        let (root, half) = (S::Wide::EPSILON.sqrt(), S::Wide::HALF);
        let least = size * root;
        let mut inward = S::Wide::ZERO;
        for share in [root * S::Wide::from_i32(4), half.powi(4), half, half] {
            let place = at.map(|x| x + (half - x) * inward);
            let Spot { du, dv, .. } = self.spot(tables, patch, place);
            let normal = du.normalize().cross(dv.normalize());
            let clear = du.max_abs().min(dv.max_abs()) > least || inward == half;
            if clear && normal.max_abs() > root {
                return normal;
            }
            inward = share;
        }
        self.mean_normal(tables, patch)
    }

    /// A direction across the patch as a whole: that of the greatest triangle at a corner.
    fn mean_normal(&self, tables: &Tables<'_, S>, patch: u16) -> S::WideVec {
        self.greatest_triangle(tables, patch).normalize()
    }

    /// The vector product of the longest way from the first control point to another, at unit length, and the
    /// way to the point that makes it greatest.
    fn greatest_triangle(&self, tables: &Tables<'_, S>, patch: u16) -> S::WideVec {
        let zero = S::WideVec::ZERO;
        let Some(rows) = self.control(tables, patch) else {
            return zero;
        };
        let [[first, ..], ..] = rows;
        let first = S::widen_vec(first);
        let points = || rows.iter().flatten().map(|p| S::widen_vec(*p) - first);
        let longer = |a: S::WideVec, b: S::WideVec| if a.max_abs() < b.max_abs() { b } else { a };
        let axis = points().fold(zero, longer).normalize();
        points().map(|p| axis.cross(p)).fold(zero, longer)
    }

    /// The greatest extent of the box around a patch.
    pub(super) fn size(&self, tables: &Tables<'_, S>, patch: u16) -> S::Wide {
        let bounds = self.patch_bounds(tables, patch);
        (S::widen_vec(bounds.max) - S::widen_vec(bounds.min)).max_abs()
    }

    /// The patch has no area: all its control points lie on a line, to rounding.
    pub(super) fn is_flat(&self, tables: &Tables<'_, S>, patch: u16) -> bool {
        let across = self.greatest_triangle(tables, patch);
        across.max_abs() <= self.size(tables, patch) * S::Wide::EPSILON * S::Wide::from_i32(16)
    }
}

/// A step of least squares towards a point, within 0..=1.
fn step<S: Scalar>(spot: &Spot<S>, to: S::WideVec, share: S::Wide) -> Pair<S::Wide> {
    let (zero, one) = (S::Wide::ZERO, S::Wide::ONE);
    let Spot { at, point, du, dv, .. } = *spot;
    let off = (to - point) * share;
    let (uu, uv, vv) = (du.dot(du), du.dot(dv), dv.dot(dv));
    let (u, v) = (du.dot(off), dv.dot(off));
    let quotient = |a: S::Wide, b: S::Wide| if b > zero { a / b } else { zero };
    let det = uu * vv - uv * uv;
    let [mut step_u, mut step_v] = if det > uu * vv * S::Wide::EPSILON * S::Wide::from_i32(16) {
        [(u * vv - v * uv) / det, (v * uu - u * uv) / det]
    } else if uu < vv {
        [zero, quotient(v, vv)]
    } else {
        [quotient(u, uu), zero]
    };
    let [at_u, at_v] = at;
    let inside = |x: S::Wide| x.clamp(zero, one);
    if inside(at_u + step_u) != at_u + step_u {
        step_u = inside(at_u + step_u) - at_u;
        step_v = quotient(v - uv * step_u, vv);
    } else if inside(at_v + step_v) != at_v + step_v {
        step_v = inside(at_v + step_v) - at_v;
        step_u = quotient(u - uv * step_v, uu);
    }
    [inside(at_u + step_u), inside(at_v + step_v)]
}

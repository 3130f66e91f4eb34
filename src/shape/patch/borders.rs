//! The sides of patches, and where two patches share one.

use super::Patches;
use super::hits::Hit;
use super::net::Pair;
use crate::scalar::{Number, Real, Scalar};
use crate::shape::Tables;

/// Some of the four sides of a patch, counterclockwise from v = 0: along u, v, −u and −v.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Sides(u8);

/// The control points of a side, counterclockwise.
type Side<S> = [<S as Scalar>::Vec3; 4];

impl Sides {
    pub(super) const NONE: Self = Self(0);

    /// The sides that a pair of parameters is within these distances of.
    pub(super) fn near<T: Real>([u, v]: Pair<T>, [out_u, out_v]: Pair<T>) -> Self {
        let one = T::ONE;
        let on = [v <= out_v, one - u <= out_u, one - v <= out_v, u <= out_u];
        Self((0..).zip(on).fold(0, |mask, (side, on)| mask | u8::from(on) << side))
    }

    pub(super) fn is_empty(self) -> bool {
        self == Self::NONE
    }

    fn iter(self) -> impl Iterator<Item = u8> {
        (0..4).filter(move |side| self.0 >> side & 1 == 1)
    }
}

/// The way along a side, counterclockwise, at a pair of parameters.
fn along<T: Real>(side: u8, [u, v]: Pair<T>) -> T {
    match side {
        0 => u,
        1 => v,
        2 => T::ONE - u,
        _ => T::ONE - v,
    }
}

/// How two patches lie to each other where they share a side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Touch {
    /// Their normals look to the same side of the surface.
    Alike,
    /// They look to different sides.
    Turned,
}

impl<S: Scalar> Patches<S> {
    fn side(&self, tables: &Tables<'_, S>, patch: u16, side: u8) -> Option<Side<S>> {
        let rows = self.control(tables, patch)?;
        let [[a, b, c, d], [e, _, _, h], [i, _, _, l], [m, n, o, p]] = rows;
        Some(match side {
            0 => [a, b, c, d],
            1 => [d, h, l, p],
            2 => [p, o, n, m],
            _ => [m, i, e, a],
        })
    }

    /// Two hits are the same point of a border that their patches share.
    pub(super) fn meet(&self, tables: &Tables<'_, S>, a: &Hit<S>, b: &Hit<S>) -> bool {
        if a.sides.is_empty() || b.sides.is_empty() {
            return false;
        }
        // Two points of one border that are both on the ray are as far apart as the border is
        // long, or nearly the same.
        let close = |a: S::Wide, b: S::Wide| (a - b).abs() <= S::Wide::from_ratio(1, 64);
        let touches = |touch: Touch, s: S::Wide, t: S::Wide| match touch {
            Touch::Alike => close(s, S::Wide::ONE - t),
            Touch::Turned => close(s, t),
        };
        for side in a.sides.iter() {
            for other in b.sides.iter() {
                let [s, t] = [along(side, a.at), along(other, b.at)];
                let pair = [(a.patch, side), (b.patch, other)];
                if self.shared(tables, pair).is_some_and(|touch| touches(touch, s, t)) {
                    return true;
                }
            }
        }
        self.corners_meet(tables, a, b)
    }

    /// A patch touches that of a hit at a side or a corner that the hit is at.
    pub(super) fn touch(&self, tables: &Tables<'_, S>, hit: &Hit<S>, patch: u16) -> bool {
        let mut pairs = hit.sides.iter().flat_map(|side| (0..4).map(move |other| (side, other)));
        let everywhere = Hit { patch, sides: Sides(15), ..*hit };
        pairs
            .any(|(side, other)| self.shared(tables, [(hit.patch, side), (patch, other)]).is_some())
            || self.corners_meet(tables, hit, &everywhere)
    }

    /// Two sides have the same control points: in opposite order where the patches are alike.
    fn shared(&self, tables: &Tables<'_, S>, sides: [(u16, u8); 2]) -> Option<Touch> {
        let [(patch, side), (other_patch, other_side)] = sides;
        if sides[0] == sides[1] {
            return None;
        }
        let one = self.side(tables, patch, side)?;
        let [a, b, c, d] = self.side(tables, other_patch, other_side)?;
        if one == [d, c, b, a] {
            Some(Touch::Alike)
        } else {
            (one == [a, b, c, d]).then_some(Touch::Turned)
        }
    }

    /// Both hits are at corners, or on sides without length, and these are in one place.
    fn corners_meet(&self, tables: &Tables<'_, S>, a: &Hit<S>, b: &Hit<S>) -> bool {
        let theirs = self.corners(tables, b);
        self.corners(tables, a).iter().flatten().any(|p| theirs.iter().flatten().any(|q| p == q))
    }

    /// The corners that a hit is at.
    fn corners(&self, tables: &Tables<'_, S>, hit: &Hit<S>) -> [Option<S::Vec3>; 4] {
        [0, 1, 2, 3].map(|side| {
            let [a, b, c, d] = self.side(tables, hit.patch, side)?;
            let before = (side + 3) % 4;
            let on = |side: u8| hit.sides.0 >> side & 1 == 1;
            let point = a == b && b == c && c == d;
            (on(side) && (on(before) || point)).then_some(a)
        })
    }
}

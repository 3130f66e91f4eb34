//! All points of one patch on a ray: subdivision until a piece has at most one, then Newton.

use super::net::{Extent, Net, Pair, Place, Way, cross, reach};
use crate::scalar::Real;

/// How often a patch may be halved.
pub(super) const LEVELS_MAX: u32 = 104;

/// How many pieces of a patch one search looks at, at most. Far more than it ever does: see the tests.
pub(super) const PIECES_MAX: u16 = 4096;

/// How many steps Newton's method may take in one piece.
pub(super) const STEPS_MAX: u32 = 12;

/// A point of the patch on the ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Root<T> {
    /// Its parameters, in 0..=1.
    pub(super) at: Pair<T>,
    /// How far rounding may have moved them.
    pub(super) slack: Pair<T>,
    /// The sign of the area of du and dv; 0 for a piece that is a point to rounding.
    pub(super) facing: i8,
}

/// The pieces that wait, as a path through halvings; one bit a level.
#[derive(Clone, Copy, Debug)]
struct Trail {
    level: u32,
    /// The halving goes along v.
    along_v: u128,
    /// The piece is the upper half.
    upper: u128,
    /// The other half waits.
    waiting: u128,
}

/// A part of the patch.
#[derive(Clone, Copy)]
struct Piece<T> {
    net: Net<T>,
    /// How far rounding may move a point of it by itself.
    error: T,
    /// How far from it a ray may pass and still meet it.
    margin: T,
}

/// A search in progress: three nets, and a path instead of a stack of them.
///
/// Source: the separation of roots by the hull of the net goes back to J. T. Kajiya, "Ray Tracing Parametric
/// Patches" (1982), and D. L. Toth, "On Ray Tracing Parametric Surfaces" (1985); the projection to two
/// dimensions is that of Nishita, Sederberg and Kakimoto, "Ray Tracing Trimmed Rational Surface Patches" (1990).
pub(super) struct Search<T> {
    whole: Piece<T>,
    piece: Piece<T>,
    /// The half that was left waiting last, while it is the next to be looked at.
    spare: Piece<T>,
    spare_level: u32,
    /// At its border a patch reaches as far as its points are certain, so that it meets its neighbour wherever that
    /// takes its points from; but not where the ray starts on it.
    border: T,
    /// To what the parameters of a root are wanted; close to the border of a piece they are as exact as can be.
    fine: T,
    /// A point that is on the ray by definition and not to be found.
    known: Option<Pair<T>>,
    trail: Trail,
    low: Pair<T>,
    size: Pair<T>,
    /// The level of a piece around this one that has at most one root, and the sign of its area.
    single: Option<(u32, i8)>,
    ready: bool,
    pieces: u16,
}

impl<T: Real> Search<T> {
    /// Begins the search of a net across the ray for parameters to within `fine`.
    #[inline]
    pub(super) fn new(net: &Net<T>, fine: T, known: Option<Pair<T>>) -> Self {
        let error = error(net);
        let whole = Piece { net: *net, error, margin: error };
        Self {
            whole,
            piece: whole,
            spare: whole,
            spare_level: 0,
            border: if known.is_some() { T::ZERO } else { error },
            fine,
            known,
            trail: Trail { level: 0, along_v: 0, upper: 0, waiting: 0 },
            low: [T::ZERO; 2],
            size: [T::ONE; 2],
            single: None,
            ready: !net.misses(error),
            pieces: 0,
        }
    }

    /// How many pieces were looked at.
    #[cfg(test)]
    pub(super) fn pieces(&self) -> u16 {
        self.pieces
    }

    /// The next root, in no order. Two pieces side by side may both give one on the line between them.
    pub(super) fn next(&mut self) -> Option<Root<T>> {
        while self.pieces < PIECES_MAX && (self.ready || self.resume()) {
            self.pieces += 1;
            self.ready = false;
            let facing = match self.single {
                Some((_, facing)) => Some(facing),
                None => self.piece.net.facing(self.piece.error),
            };
            let level = self.trail.level;
            if let Some(facing) = facing {
                self.single = self.single.or(Some((level, facing)));
                if self.holds_known() {
                    continue;
                }
                match self.newton(facing) {
                    Some(root) if self.is_known(&root) => continue,
                    Some(root) => return Some(root),
                    None => {}
                }
            }
            match (self.piece.net.extent(self.whole.error * T::from_ratio(1, 8)), facing) {
                // Edge on, or along a silhouette, as far as it can be told.
                (Extent::Line, None) => continue,
                (Extent::Point, _) if self.holds_known() => continue,
                (Extent::Point, _) => return Some(self.point()),
                _ => {}
            }
            if level < LEVELS_MAX {
                self.divide();
            }
        }
        None
    }

    /// Halves the piece along its longer way and goes on with a half that the ray may meet.
    fn divide(&mut self) {
        let way = self.piece.net.longer_way();
        // The spare was either used or is older than this one.
        self.piece.net.halve(&mut self.spare.net, way);
        self.spare_level = 0;
        let [lower, upper] = [false, true].map(|upper| {
            let (low, size) = half(self.low, self.size, way, upper);
            let piece = if upper { &mut self.spare } else { &mut self.piece };
            piece.measure(is_at_border(low, size), self.border);
            !piece.net.misses(piece.margin)
        });
        if !lower && !upper {
            return;
        }
        let bit = 1_u128 << self.trail.level;
        let set = |mask: u128, on: bool| if on { mask | bit } else { mask & !bit };
        self.trail.along_v = set(self.trail.along_v, way == Way::V);
        self.trail.upper = set(self.trail.upper, !lower);
        self.trail.waiting = set(self.trail.waiting, lower && upper);
        self.trail.level += 1;
        if !lower {
            self.piece = self.spare;
        } else if upper {
            self.spare_level = self.trail.level;
        }
        (self.low, self.size) = half(self.low, self.size, way, !lower);
        self.ready = true;
    }

    /// Takes up the half that was left waiting last; false where there is none.
    fn resume(&mut self) -> bool {
        let waiting = self.trail.waiting;
        if waiting == 0 {
            return false;
        }
        let level = 128 - waiting.leading_zeros();
        let bit = 1_u128 << (level - 1);
        self.trail.level = level;
        self.trail.upper |= bit;
        self.trail.waiting &= !bit;
        self.single = self.single.filter(|&(from, _)| from < level);
        let kept = self.spare_level == level;
        self.spare_level = 0;
        self.piece = if kept { self.spare } else { self.whole };
        (self.low, self.size) = ([T::ZERO; 2], [T::ONE; 2]);
        for passed in 0..level {
            let on = |mask: u128| mask >> passed & 1 == 1;
            let (way, upper) =
                (if on(self.trail.along_v) { Way::V } else { Way::U }, on(self.trail.upper));
            (self.low, self.size) = half(self.low, self.size, way, upper);
            if !kept {
                self.piece.net.halve(&mut self.spare.net, way);
                if upper {
                    self.piece.net = self.spare.net;
                }
            }
        }
        if !kept {
            self.piece.measure(is_at_border(self.low, self.size), self.border);
        }
        true
    }

    /// The parameters in the piece of a pair on the patch.
    fn inside(&self, at: Pair<T>) -> Pair<T> {
        let ([u, v], [low_u, low_v], [size_u, size_v]) = (at, self.low, self.size);
        [(u - low_u) / size_u, (v - low_v) / size_v]
    }

    fn outside(&self, place: Pair<T>) -> Pair<T> {
        [self.low[0] + self.size[0] * place[0], self.low[1] + self.size[1] * place[1]]
    }

    fn holds_known(&self) -> bool {
        self.known.is_some_and(|known| {
            self.inside(known).into_iter().all(|x| T::ZERO <= x && x <= T::ONE)
        })
    }

    /// The root is the known one, as far as rounding can tell.
    fn is_known(&self, root: &Root<T>) -> bool {
        let four = T::from_i32(4);
        self.known.is_some_and(|known| {
            let near = |i: (T, T, T)| (i.0 - i.1).abs() <= i.2 * four;
            let ([u, v], [ku, kv], [su, sv]) = (root.at, known, root.slack);
            near((u, ku, su)) && near((v, kv, sv))
        })
    }

    /// The one root of the piece, by Newton's method; `None` where it does not converge in or at the piece.
    fn newton(&self, facing: i8) -> Option<Root<T>> {
        let (zero, one, half) = (T::ZERO, T::ONE, T::HALF);
        let size = self.size[0].max(self.size[1]);
        let (fine, exact) = (self.fine / size, T::EPSILON * T::from_ratio(1, 4) / size);
        let aside = T::from_ratio(1, 64);
        let (mut at, mut before) = ([half; 2], one);
        for _ in 0..STEPS_MAX {
            let Place { at: off, du, dv } = self.piece.net.place(at);
            let area = cross(du, dv);
            let turned = if facing > 0 { area <= zero } else { area >= zero };
            let error = self.piece.error;
            if turned && reach(off) <= error {
                // A degenerate point, as where a side shrinks to one.
                return Some(Root { at: self.outside(at), slack: self.size, facing });
            }
            if turned {
                return None;
            }
            let inverse = one / area;
            let step = [cross(dv, off) * inverse, cross(off, du) * inverse];
            at = [at[0] + step[0], at[1] + step[1]];
            if !at.into_iter().all(|x| -half <= x && x <= one + half) {
                return None;
            }
            let slack = [dv, du].map(|side| (reach(side) * inverse).abs());
            let [moved_u, moved_v] = step.map(T::abs);
            let step = moved_u.max(moved_v);
            // What the next step would be, as quadratic convergence foretells it.
            let ratio = step / before;
            let inside = at.into_iter().all(|x| aside <= x && x <= one - aside);
            let enough = if inside && ratio < aside { fine } else { exact };
            let settled = ratio < half && step * ratio * ratio <= enough;
            if settled || moved_u <= slack[0] * error && moved_v <= slack[1] * error {
                return self.accepted(at, slack, facing);
            }
            before = step;
        }
        None
    }

    /// A root that lies in the piece, but for rounding; `slack` is by how much an error across the ray moves it.
    fn accepted(&self, place: Pair<T>, slack: Pair<T>, facing: i8) -> Option<Root<T>> {
        let (zero, one) = (T::ZERO, T::ONE);
        let fits = |x: T, slack: T| {
            let out = (slack * self.piece.margin).min(T::HALF);
            -out <= x && x <= one + out
        };
        if !(fits(place[0], slack[0]) && fits(place[1], slack[1])) {
            return None;
        }
        let error = self.whole.error;
        let at = self.outside(place).map(|x| x.clamp(zero, one));
        let slack = [slack[0] * self.size[0] * error, slack[1] * self.size[1] * error];
        Some(Root { at, slack: slack.map(|slack| slack + self.fine), facing })
    }

    /// The whole piece as a root.
    fn point(&self) -> Root<T> {
        Root { at: self.outside([T::HALF; 2]), slack: self.size, facing: 0 }
    }
}

/// How far rounding may move a point of a net. That of a piece near the ray is as small as the piece: what
/// halving rounds away in larger ones moves all that lies in them together, and neighbours that share points
/// share their halves to the bit.
fn error<T: Real>(net: &Net<T>) -> T {
    net.size() * T::EPSILON * T::from_i32(4)
}

impl<T: Real> Piece<T> {
    fn measure(&mut self, at_border: bool, border: T) {
        self.error = error(&self.net);
        self.margin = if at_border { border.max(self.error) } else { self.error };
    }
}

/// The place of a half of a piece.
fn half<T: Real>(low: Pair<T>, size: Pair<T>, way: Way, upper: bool) -> (Pair<T>, Pair<T>) {
    let ([mut low_u, mut low_v], [mut size_u, mut size_v]) = (low, size);
    let (low, size) =
        if way == Way::U { (&mut low_u, &mut size_u) } else { (&mut low_v, &mut size_v) };
    *size *= T::HALF;
    if upper {
        *low += *size;
    }
    ([low_u, low_v], [size_u, size_v])
}

fn is_at_border<T: Real>(low: Pair<T>, size: Pair<T>) -> bool {
    low.into_iter().zip(size).any(|(low, size)| low == T::ZERO || low + size == T::ONE)
}

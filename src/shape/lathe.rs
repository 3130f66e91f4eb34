//! Surfaces of revolution: a profile of lines or of cubic curves, turned about an axis.

mod check;
mod cubic;
mod level;
mod line;
mod profile;
mod sweep;

use super::crossings::{Crossings, Departure, spans_between, touches};
use super::{Flaw, Primitive, Sight, Tables, turn};
use crate::bounds::Bounds;
use crate::place::{Local, Placement, apply};
use crate::scalar::{Axis, Number, Real, Scalar, Vector};
use crate::span::Span;

use level::Level;
use line::Line;
use profile::{Foot, Piece, Profile, Spot};
use sweep::Sweep;

/// What the points of a profile are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Curve {
    /// Points to be joined by lines.
    Lines,
    /// The control points of cubic Bézier curves, each of which begins where the one before ends: one point,
    /// and three more for each curve.
    Cubics,
}

/// The side of a profile that is filled, for one who goes along it; distances from the axis count to the
/// right, heights up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Filled {
    /// None: an open surface, whose normals point to the right.
    Nowhere,
    /// The left; normals point to the right.
    Left,
    /// The right; normals point to the left.
    Right,
}

/// A surface of revolution about the local y axis. Where its profile begins and ends on the axis, or begins
/// where it ends, it is a solid, and else an open surface. Faces: the pieces of the profile in order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lathe<S: Scalar> {
    /// The origin of the profile's plane; zero if placed.
    pub center: S::Vec3,
    /// The index of the first point of the profile. Points have the distance from the axis as x, at least 0, the height
    /// as y, and 0 as z.
    pub first: u32,
    /// How many points follow, at least two.
    pub count: u32,
    /// What the points are.
    pub curve: Curve,
    /// Where the solid is: [`Lathe::filled`].
    pub filled: Filled,
}

/// Where a ray starts on a profile.
#[derive(Clone, Copy, Debug)]
struct Known<T> {
    face: u32,
    inward: bool,
    /// Where on the piece, in 0..=1.
    u: T,
    spot: Spot<T>,
    /// The outward normal in the plane of the profile, of any length.
    normal: Spot<T>,
    /// The ray is the farther beyond the curve the farther along it.
    rises: bool,
    /// How far it is beyond the ends of the piece.
    ends: [T; 2],
}

impl<T: Real> Known<T> {
    /// The slope at the start with the sign that it must have; `turned` if it is taken against the curve.
    fn fit(&self, slope: T, turned: bool) -> T {
        if self.rises == turned {
            if slope < T::ZERO { slope } else { -T::TINY }
        } else if T::ZERO < slope {
            slope
        } else {
            T::TINY
        }
    }

    /// How far the ray is beyond an end of the piece, if `value` is what was computed: next to the
    /// start what the slope tells, and on the axis never less than 0.
    fn end(&self, [rho, value]: [T; 2], at_last: bool) -> T {
        let value = if value == T::ZERO { self.fit(value, !at_last) } else { value };
        if rho == T::ZERO { value.max(T::ZERO) } else { value }
    }
}

impl<S: Scalar> Lathe<S> {
    /// The side of a profile that is filled. A profile that is not closed, or goes around no area, has none.
    pub fn filled(points: &[S::Vec3], curve: Curve) -> Filled {
        check::filled::<S>(&Profile { points, curve })
    }

    /// How many pieces the profile has.
    const fn pieces(&self) -> u32 {
        let steps = self.count.saturating_sub(1);
        match self.curve {
            Curve::Lines => steps,
            Curve::Cubics => steps / 3,
        }
    }

    /// A surface without an inside.
    pub(super) const fn is_open(&self) -> bool {
        matches!(self.filled, Filled::Nowhere)
    }

    /// The greatest number of spans along any ray: a line is met twice at most, a cubic six times.
    pub(super) const fn spans_max(&self) -> u16 {
        let crossings = match self.curve {
            Curve::Lines => 2,
            Curve::Cubics => 6,
        };
        let spans = if self.is_open() { crossings } else { crossings / 2 };
        let most = self.pieces().saturating_mul(spans);
        if most < u16::MAX as u32 { most as u16 } else { u16::MAX }
    }

    fn profile<'a>(&self, tables: &Tables<'a, S>) -> Profile<'a, S> {
        let first = self.first as usize;
        let points = tables.points.get(first..first.saturating_add(self.count as usize));
        Profile { points: points.unwrap_or(&[]), curve: self.curve }
    }

    /// The outward normal for a direction of the profile.
    fn outward(&self, [rho, y]: Spot<S::Wide>) -> Spot<S::Wide> {
        if self.filled == Filled::Right { [-y, rho] } else { [y, -rho] }
    }

    /// The point of a face nearest to a local point close to it.
    fn foot(&self, local: S::WideVec, face: u32, tables: &Tables<'_, S>) -> Option<Foot<S::Wide>> {
        let distance = local.with(Axis::Y, S::Wide::ZERO).length();
        Some(self.profile(tables).piece(face)?.foot([distance, local.y()]))
    }

    /// What is known of a ray that starts on a face.
    fn known(
        &self,
        sweep: &Sweep<S::Wide>,
        departure: &Departure<S::Wide>,
        local: S::Vec3,
        tables: &Tables<'_, S>,
    ) -> Option<Known<S::Wide>> {
        let Departure { face, inward, .. } = *departure;
        let piece = self.profile(tables).piece(face)?;
        let foot = self.foot(S::widen_vec(local), face, tables)?;
        let upward = sweep.dy > S::Wide::ZERO;
        let rises = (upward == inward) == (self.filled == Filled::Right);
        let normal = self.outward(foot.tangent);
        let ends = [S::Wide::ZERO; 2];
        let mut known = Known { face, inward, u: foot.u, spot: foot.spot, normal, rises, ends };
        let [[first, _], [last, _]] = piece.ends();
        let [before, after] = beyond_ends(sweep, &piece, &known);
        known.ends = [known.end([first, before], false), known.end([last, after], true)];
        Some(known)
    }

    /// Offers all crossings of a ray.
    #[inline(never)]
    fn gather(
        &self,
        sweep: &Sweep<S::Wide>,
        known: Option<&Known<S::Wide>>,
        profile: &Profile<'_, S>,
        out: &mut Crossings<S::Wide>,
    ) {
        if sweep.level {
            let level = Level::new(sweep, known);
            for (face, piece) in (0..).zip(profile.pieces()) {
                level.cross(&piece, known.filter(|known| known.face == face), face, out);
            }
            return;
        }
        let (last, ring) = (self.pieces(), profile.is_ring());
        let around = |vertex: u32| if ring && vertex == last { 0 } else { vertex };
        // How far the ray is beyond a vertex: the same for the pieces on both sides.
        let beyond = |[rho, y]: Spot<S::Wide>, vertex: u32| {
            let start = known.and_then(|known| {
                let (face, [first, second]) = (known.face, known.ends);
                let next = around(vertex) == around(face + 1);
                if around(vertex) == face { Some(first) } else { next.then_some(second) }
            });
            start.unwrap_or_else(|| sweep.beyond(rho, sweep.at_height(y)))
        };
        let mut from = None;
        for (face, piece) in (0_u32..).zip(profile.pieces()) {
            let [first, second] = piece.ends();
            let begin = from.unwrap_or_else(|| beyond(first, 0));
            let end = beyond(second, face + 1);
            let known = known.filter(|known| known.face == face);
            match (piece, known) {
                (Piece::Cubic(cubic), _) => cubic.cross(sweep, [begin, end], known, face, out),
                (Piece::Line([from, to]), None) => {
                    Line { from, to, beyond: [begin, end] }.cross(sweep, face, out);
                }
                (Piece::Line([from, to]), Some(known)) => {
                    Line { from, to, beyond: [begin, end] }.cross_again(sweep, known, face, out);
                }
            }
            from = Some(end);
        }
    }
}

/// How far a ray that starts on a piece is beyond its ends, as seen from the start.
fn beyond_ends<T: Real>(sweep: &Sweep<T>, piece: &Piece<T>, known: &Known<T>) -> [T; 2] {
    match piece {
        Piece::Line([from, to]) => {
            let line = Line { from: *from, to: *to, beyond: [T::ZERO; 2] };
            let departing = line.depart(sweep, known);
            [departing.at(-known.u), departing.at(T::ONE - known.u)]
        }
        Piece::Cubic(cubic) => [T::ZERO, T::ONE].map(|end| {
            let [[.., rho], [.., y]] = cubic.way(known.u, end);
            let t = sweep.above(y);
            let linear = (t * sweep.along - known.spot[0] * rho) * T::TWO;
            linear + (t.squared() * sweep.across - rho.squared())
        }),
    }
}

impl<S: Scalar> Primitive<S> for Lathe<S> {
    fn centre(&self) -> S::Vec3 {
        self.center
    }

    fn check(&self, placed: bool, tables: &Tables<'_, S>) -> Result<(), Flaw> {
        super::check_centre::<S>(self.center, placed)?;
        check::check(self, &self.profile(tables))
    }

    fn bounds(&self, place: Option<&Placement<S>>, tables: &Tables<'_, S>) -> Bounds<S> {
        let (zero, far) = (S::Wide::ZERO, S::Wide::FAR);
        let (mut reach, mut low, mut high) = (zero, far, -far);
        for piece in self.profile(tables).pieces() {
            let [below, above] = piece.heights();
            (reach, low, high) = (reach.max(piece.reach()), low.min(below), high.max(above));
        }
        let Some(place) = place else {
            let corner = |reach: S::Wide, y: S::Wide| {
                self.center + S::narrow_vec(S::WideVec::new(reach, y, reach))
            };
            return Bounds::between(corner(-reach, low), corner(reach, high));
        };
        let half = (high - low) * S::Wide::HALF;
        let middle = S::WideVec::ZERO.with(Axis::Y, low + half);
        let [x, y, z] = place.to_world.map(|row| {
            let across = row.with(Axis::Y, zero).length();
            S::narrow(row.y().abs() * half + across * reach)
        });
        let centre =
            S::narrow_vec(apply::<S>(&place.to_world, middle) + S::widen_vec(place.anchor));
        Bounds::about(centre, S::Vec3::new(x, y, z))
    }

    /// Seen from the axis the ray is a branch of a hyperbola. Vertices of the profile lie on one side of it or
    /// on the other, which is decided once for each, so each piece is known to be crossed an odd number of times or an
    /// even one before any crossing is computed, and a closed profile always an even number.
    // Out of line: what it keeps on the stack is there for such solids only.
    #[inline(never)]
    fn spans(&self, sight: &Sight<'_, S>, emit: impl FnMut(Span<S>)) {
        let (ray, departure) = match sight.start {
            None => (Local::recentred(sight.line, sight.place, self.center), None),
            Some(start) => {
                let ray = Local::from_surface(sight.line, sight.place, start.local);
                // So near to the start others cannot be told from it.
                let reach = S::rounding(ray.origin.max_abs()) * S::Wide::from_i32(8);
                let within = reach / ray.dd.sqrt();
                (ray, Some(Departure { face: start.face, inward: start.inward, within }))
            }
        };
        let sweep = Sweep::new(&ray);
        let known = departure.as_ref().zip(sight.start).and_then(|(departure, start)| {
            self.known(&sweep, departure, start.local, sight.tables)
        });
        let profile = self.profile(sight.tables);
        let gather = |out: &mut Crossings<S::Wide>| {
            self.gather(&sweep, known.as_ref(), &profile, out);
        };
        if self.is_open() {
            touches(&ray, departure, self.spans_max(), gather, emit);
        } else {
            spans_between(&ray, departure, &Span::whole(), self.spans_max(), gather, emit);
        }
    }

    fn snap(&self, local: S::WideVec, face: u32, tables: &Tables<'_, S>) -> S::Vec3 {
        let Some(Foot { spot: [rho, y], .. }) = self.foot(local, face, tables) else {
            return S::narrow_vec(local);
        };
        let flat = local.with(Axis::Y, S::Wide::ZERO);
        let distance = flat.length();
        let flat = if distance > S::Wide::ZERO {
            flat * (rho / distance)
        } else {
            S::WideVec::ZERO.with(Axis::X, rho)
        };
        S::narrow_vec(flat.with(Axis::Y, y))
    }

    fn normal(&self, local: S::Vec3, face: u32, tables: &Tables<'_, S>) -> S::WideVec {
        let local = S::widen_vec(local);
        let flat = local.with(Axis::Y, S::Wide::ZERO);
        let distance = flat.length();
        let foot = self.foot(local, face, tables);
        let tangent = foot.map_or([S::Wide::ZERO, S::Wide::ONE], |foot| foot.tangent);
        let [rho, y] = self.outward(tangent);
        if distance > S::Wide::ZERO {
            (flat * (rho / distance)).with(Axis::Y, y)
        } else if y == S::Wide::ZERO {
            S::WideVec::ZERO.with(Axis::X, rho)
        } else {
            // A tip looks along the axis.
            S::WideVec::ZERO.with(Axis::Y, y)
        }
    }

    /// The angle as u; as v how far along the profile, by the lengths of its pieces; both in 0..=1.
    fn uv(&self, local: S::Vec3, face: u32, tables: &Tables<'_, S>) -> [S; 2] {
        let foot = self.foot(S::widen_vec(local), face, tables);
        let share = foot.map_or(S::Wide::ZERO, |foot| foot.u);
        let (mut before, mut whole) = (S::Wide::ZERO, S::Wide::ZERO);
        for (index, piece) in (0_u32..).zip(self.profile(tables).pieces()) {
            let length = piece.length();
            if index < face {
                before += length;
            } else if index == face {
                before += length * share;
            }
            whole += length;
        }
        [turn(local.x(), local.z()), S::narrow((before / whole).clamp(S::Wide::ZERO, S::Wide::ONE))]
    }
}

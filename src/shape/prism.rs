//! The prism: a polygon, convex or not, drawn out along an axis.

mod check;
mod plan;

use super::crossings::{Crossings, Departure, LOWER, UPPER, spans_between};
use super::cylinder::{BASE, TOP, caps, is_axial};
use super::{Flaw, Primitive, Sight, Tables, check_centre, check_length};
use crate::bounds::Bounds;
use crate::place::{Local, Placement, apply};
use crate::scalar::{Axis, Number, Real, Scalar, Vector};
use crate::span::Span;

use plan::{Plan, Spot, crossing, edges, rules_of, share_of, spot};

/// The face of the first edge.
const SIDES: u32 = 3;

/// Which way around a polygon goes, where x points to the right and z up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Winding {
    /// The inside is on the left.
    Counterclockwise,
    /// The inside is on the right.
    Clockwise,
    /// The polygon crosses itself; the even-odd rule decides what is inside.
    Crossed,
}

/// A prism about the local y axis, closed by caps. Its polygon may be concave; where it crosses itself, the even-odd
/// rule decides what is inside. Faces: 1 the base (−y), 2 the top, from 3 on the sides as the edges come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prism<S: Scalar> {
    /// The middle of the axis; zero for a placed prism.
    pub center: S::Vec3,
    /// Half the distance between the caps, greater than 0.
    pub half_height: S,
    /// The index of the first vertex. Vertices lie in the plane of x and z, with 0 as y.
    pub first: u32,
    /// How many vertices follow, at least three.
    pub count: u32,
    /// Which way around they go: [`Prism::winding`].
    pub winding: Winding,
}

/// The edge on which a ray starts.
struct Known<T> {
    edge: u32,
    /// On which sides of the ray the two ends of the edge lie.
    sides: [T; 2],
}

impl<S: Scalar> Prism<S> {
    /// Which way around these vertices go, in the plane of x and z.
    pub fn winding(vertices: &[S::Vec3]) -> Winding {
        check::winding::<S>(vertices)
    }

    /// The greatest number of spans along any ray.
    pub(super) const fn spans_max(&self) -> u16 {
        let most = self.count / 2;
        if most >= u16::MAX as u32 {
            u16::MAX
        } else if most > 1 {
            most as u16
        } else {
            1
        }
    }

    fn vertices<'a>(&self, tables: &Tables<'a, S>) -> &'a [S::Vec3] {
        let first = self.first as usize;
        tables.points.get(first..first.saturating_add(self.count as usize)).unwrap_or(&[])
    }

    /// The ends of an edge.
    fn edge(&self, index: u32, tables: &Tables<'_, S>) -> Option<[Spot<S::Wide>; 2]> {
        let vertices = self.vertices(tables);
        let from = vertices.get(index as usize)?;
        let to = vertices.get(index as usize + 1).or_else(|| vertices.first())?;
        Some([*from, *to].map(spot::<S>))
    }

    /// The outward normal of an edge at a point of it.
    fn outward(
        &self,
        edge: u32,
        at: Spot<S::Wide>,
        tables: &Tables<'_, S>,
    ) -> Option<Spot<S::Wide>> {
        let [from, to] = self.edge(edge, tables)?;
        let (x, z) = (to[0] - from[0], to[1] - from[1]);
        let scale = x.abs().max(z.abs());
        let right = [z / scale, -(x / scale)];
        let inside_left = match self.winding {
            Winding::Counterclockwise => true,
            Winding::Clockwise => false,
            Winding::Crossed => {
                let across = right[0].squared() + right[1].squared();
                let plan = Plan { at, dir: right, across };
                !self.is_inside_ahead(&plan, edge, tables)
            }
        };
        Some(if inside_left { right } else { right.map(|part| -part) })
    }

    /// A ray from a point of an edge goes inside.
    fn is_inside_ahead(&self, plan: &Plan<S::Wide>, edge: u32, tables: &Tables<'_, S>) -> bool {
        let zero = S::Wide::ZERO;
        let mut inside = false;
        for ([from, to], index) in edges::<S>(self.vertices(tables)).zip(0..) {
            let [from, to] = [from, to].map(|vertex| plan.see::<S>(vertex));
            let crosses = (from.side < zero) != (to.side < zero);
            inside ^= index != edge && crosses && crossing(&from, &to) > zero;
        }
        inside
    }

    /// What is known of a ray that starts on a side.
    fn known(
        &self,
        plan: &Plan<S::Wide>,
        departure: &Departure<S::Wide>,
        tables: &Tables<'_, S>,
    ) -> Option<Known<S::Wide>> {
        let edge = departure.face.checked_sub(SIDES)?;
        let [from, to] = self.edge(edge, tables)?;
        let normal = self.outward(edge, plan.at, tables)?;
        let (x, z) = (to[0] - from[0], to[1] - from[1]);
        let (zero, one, tiny) = (S::Wide::ZERO, S::Wide::ONE, S::Wide::TINY);
        let share = share_of([from, to], plan.at);
        // The far end lies to the side to which the ray goes inward if the normal is on the right.
        let right = normal[0] * z - normal[1] * x > zero;
        let sign = if right == departure.inward { one } else { -one };
        let turn = S::det2(x, plan.dir[1], z, plan.dir[0]).abs();
        let turn = if turn > zero { turn } else { tiny };
        let at_least = |side: S::Wide| side.max(tiny) * sign;
        let sides = [-at_least(turn * share), at_least(turn * (one - share))];
        Some(Known { edge, sides })
    }

    /// Offers all crossings of a ray with the sides.
    #[inline(never)]
    fn gather(
        &self,
        plan: &Plan<S::Wide>,
        known: Option<&Known<S::Wide>>,
        departs: bool,
        tables: &Tables<'_, S>,
        out: &mut Crossings<S::Wide>,
    ) {
        let vertices = self.vertices(tables);
        let count = vertices.len() as u32;
        let see = |vertex: S::Vec3, index: u32| {
            let mut seen = plan.see::<S>(spot::<S>(vertex));
            if let Some(Known { edge, sides: [first, second] }) = known {
                let next = if edge + 1 == count { 0 } else { edge + 1 };
                if index == *edge {
                    seen.side = *first;
                } else if index == next {
                    seen.side = *second;
                }
            }
            seen
        };
        let Some(last) = vertices.last() else {
            return;
        };
        let mut from = see(*last, count - 1);
        // The edge that ends with each vertex.
        let mut edge = count - 1;
        for (index, vertex) in (0..).zip(vertices) {
            let to = see(*vertex, index);
            let rules = rules_of([from.side, to.side], departs);
            if rules != 0 && known.is_none_or(|known| known.edge != edge) {
                out.offer(crossing(&from, &to), SIDES.saturating_add(edge), rules);
            }
            (from, edge) = (to, index);
        }
    }

    /// What lies between the caps ahead of a ray that starts on the prism and goes inside.
    fn window(&self, ray: &Local<S>, face: u32) -> Span<S::Wide> {
        let (y, dy, half_height) = (ray.origin.y(), ray.dir.y(), self.half_height.widen());
        let mut window = Span::whole();
        let mut end = |t: S::Wide, face: u32| {
            window.exit.t = t.max(S::Wide::TINY);
            window.exit.face = face;
        };
        if dy > S::Wide::ZERO && face != TOP {
            end((half_height - y) / dy, TOP);
        } else if dy < S::Wide::ZERO && face != BASE {
            end((-half_height - y) / dy, BASE);
        }
        window
    }

    /// A ray along the axis is inside between the caps.
    fn contains(&self, at: Spot<S::Wide>, tables: &Tables<'_, S>) -> bool {
        let (zero, one) = (S::Wide::ZERO, S::Wide::ONE);
        let plan = Plan { at, dir: [one, zero], across: one };
        let mut inside = [false; 2];
        for [from, to] in edges::<S>(self.vertices(tables)) {
            let [from, to] = [from, to].map(|vertex| plan.see::<S>(vertex));
            let rules = rules_of([from.side, to.side], false);
            if rules == 0 {
                // Along the edge, or beside it.
                let on_edge = from.side == zero
                    && to.side == zero
                    && from.t.min(to.t) <= zero
                    && zero <= from.t.max(to.t);
                if on_edge {
                    return true;
                }
                continue;
            }
            let t = crossing(&from, &to);
            if t == zero {
                return true;
            }
            for (inside, rule) in inside.iter_mut().zip([LOWER, UPPER]) {
                *inside ^= t > zero && rules & rule != 0;
            }
        }
        inside.contains(&true)
    }
}

impl<S: Scalar> Primitive<S> for Prism<S> {
    fn centre(&self) -> S::Vec3 {
        self.center
    }

    fn check(&self, placed: bool, tables: &Tables<'_, S>) -> Result<(), Flaw> {
        check_centre::<S>(self.center, placed)?;
        check_length(self.half_height, "half_height")?;
        check::check(self, tables)
    }

    fn bounds(&self, place: Option<&Placement<S>>, tables: &Tables<'_, S>) -> Bounds<S> {
        let flat = Bounds::<S>::around(self.vertices(tables));
        let up = S::Vec3::ZERO.with(Axis::Y, self.half_height);
        let Some(place) = place else {
            let moved = |corner: S::Vec3, up: S::Vec3| corner + up + self.center;
            return Bounds::between(moved(flat.min, -up), moved(flat.max, up));
        };
        let [low, high] = [flat.min, flat.max].map(S::widen_vec);
        let half = ((high - low) * S::Wide::HALF).with(Axis::Y, self.half_height.widen());
        let middle = apply::<S>(&place.to_world, (high + low) * S::Wide::HALF);
        let [x, y, z] = place.to_world.map(|row| S::narrow(row.map(Number::abs).dot(half)));
        Bounds::about(S::narrow_vec(middle + S::widen_vec(place.anchor)), S::Vec3::new(x, y, z))
    }

    /// Seen along the axis, a ray is a line that leaves each vertex on one of its sides, which is decided once for each:
    /// so it crosses the polygon an even number of times. What it crosses is clipped by the caps. A ray in a side or along
    /// an edge is inside if what lies beside it on either side is.
    // Out of line: what it keeps on the stack is there for such solids only.
    #[inline(never)]
    fn spans(&self, sight: &Sight<'_, S>, mut emit: impl FnMut(Span<S>)) {
        let tables = sight.tables;
        let (ray, departure, window) = match sight.start {
            None => {
                let ray = Local::recentred(sight.line, sight.place, self.center);
                let Some(window) = caps(&ray, self.half_height) else {
                    return;
                };
                (ray, None, window)
            }
            Some(start) => {
                let on_cap = start.face < SIDES;
                if on_cap && !start.inward {
                    return;
                }
                let ray = Local::from_surface(sight.line, sight.place, start.local);
                // So near to the start others cannot be told from it.
                let reach = S::rounding(ray.origin.max_abs()) * S::Wide::from_i32(8);
                let within = reach / ray.dd.sqrt();
                let departure = Departure { face: start.face, inward: start.inward, within };
                (ray, Some(departure), self.window(&ray, start.face))
            }
        };
        let plan = Plan::new(&ray);
        if is_axial(plan.across, ray.dd) {
            let mut window = window;
            if let Some(departure) = departure {
                window.enter.t = S::Wide::ZERO;
                window.enter.face = departure.face;
            }
            if departure
                .map_or_else(|| self.contains(plan.at, tables), |departure| departure.inward)
            {
                emit(window.map(|t| ray.arrive(t)));
            }
            return;
        }
        let known = departure.as_ref().and_then(|departure| self.known(&plan, departure, tables));
        let gather = |out: &mut Crossings<S::Wide>| {
            self.gather(&plan, known.as_ref(), departure.is_some(), tables, out);
        };
        spans_between(&ray, departure, &window, self.spans_max(), gather, emit);
    }

    fn snap(&self, local: S::WideVec, face: u32, tables: &Tables<'_, S>) -> S::Vec3 {
        let half_height = self.half_height;
        let height = match face {
            BASE => -half_height,
            TOP => half_height,
            _ => S::narrow(local.y()).clamp(-half_height, half_height),
        };
        let mut at = [local.x(), local.z()];
        let edge = face.checked_sub(SIDES).and_then(|edge| self.edge(edge, tables));
        if let Some([from, to]) = edge {
            let share = share_of([from, to], at);
            let mix = |a: S::Wide, b: S::Wide| a * (S::Wide::ONE - share) + b * share;
            at = [mix(from[0], to[0]), mix(from[1], to[1])];
        }
        S::Vec3::new(S::narrow(at[0]), height, S::narrow(at[1]))
    }

    fn normal(&self, local: S::Vec3, face: u32, tables: &Tables<'_, S>) -> S::WideVec {
        let (zero, one) = (S::Wide::ZERO, S::Wide::ONE);
        match face {
            BASE => S::WideVec::new(zero, -one, zero),
            TOP => S::WideVec::new(zero, one, zero),
            _ => {
                let (edge, at) = (face.saturating_sub(SIDES), spot::<S>(local));
                let [x, z] = self.outward(edge, at, tables).unwrap_or([one, zero]);
                S::WideVec::new(x, zero, z)
            }
        }
    }

    /// A side: how far along the polygon as u, by the lengths of its edges, and the height as v. A cap: the rectangle around
    /// it. All in 0..=1.
    fn uv(&self, local: S::Vec3, face: u32, tables: &Tables<'_, S>) -> [S; 2] {
        let (zero, one) = (S::Wide::ZERO, S::Wide::ONE);
        let vertices = self.vertices(tables);
        let Some(edge) = face.checked_sub(SIDES) else {
            let around = Bounds::<S>::around(vertices);
            let share = |v: S, low: S, high: S| {
                let share = (v.widen() - low.widen()) / (high.widen() - low.widen());
                S::narrow(share.clamp(zero, one))
            };
            return [
                share(local.x(), around.min.x(), around.max.x()),
                share(local.z(), around.min.z(), around.max.z()),
            ];
        };
        let (mut before, mut whole) = (zero, zero);
        for (ends, index) in edges::<S>(vertices).zip(0..) {
            let [[a, b], [c, d]] = ends;
            let length = S::WideVec::new(c - a, zero, d - b).length();
            if index < edge {
                before += length;
            } else if index == edge {
                before += length * share_of(ends, spot::<S>(local));
            }
            whole += length;
        }
        let height = (local.y().widen() / self.half_height.widen() + one) * S::Wide::HALF;
        [before / whole, height].map(|share| S::narrow(share.clamp(zero, one)))
    }
}

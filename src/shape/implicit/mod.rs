//! The solid where a formula is less than 0, within a box.

mod isolate;
pub mod program;

use isolate::{Along, Crossings};
pub use program::ProgramFlaw;

use super::{Cuboid, Flaw, Primitive, Sight, Tables, check_centre, turn};
use crate::bounds::Bounds;
use crate::interval::Dual;
use crate::place::{Local, Placement};
use crate::ray::Start;
use crate::scalar::{Axis, Number, Real, Scalar, Vector};
use crate::span::{End, Span};

/// The face where the formula is 0; those of the box follow it.
const SURFACE: u32 = 0;

/// The points of a box where a formula F(x, y, z) is less than 0.
///
/// The formula and its coordinates are given as a [program]. Precision is that of the formula at
/// these coordinates: a box about their origin, moved by a placement, keeps more of it than one far away.
///
/// Along a ray F and its slope are evaluated by intervals that hold every value, rounding included, so
/// that it is proved where there is no boundary and where there is one. Two boundaries that are nearer
/// to one another than about the square root of the precision, as where a ray grazes, may be told as
/// none; never is there one without its counterpart.
///
/// Faces: 0 where F is 0; 1 to 6 those of the box: −x, +x, −y, +y, −z, +z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Implicit<S: Scalar> {
    /// The origin of the coordinates of formula and box; zero for a placed solid.
    pub center: S::Vec3,
    /// The least corner of the box, as an index of a point; the greatest is the next one.
    pub corners: u32,
    /// The first byte of the [program](program).
    pub code: u32,
    /// The first number of the program.
    pub numbers: u32,
    /// How many bytes the program has.
    pub code_len: u16,
    /// How many numbers the program has.
    pub numbers_len: u16,
    /// The most spans along a ray, at least 1. Where there would be more, the last one goes on to
    /// the last exit: what lies between is filled.
    pub spans: u16,
}

/// The part of a ray within the box, or ahead of its start.
struct Reach<S: Scalar> {
    ray: Local<S>,
    span: Span<S::Wide>,
    /// The side that a ray from the surface goes to.
    inward: Option<bool>,
}

impl<S: Scalar> Implicit<S> {
    /// The entries of a table from the first on, if there are so many.
    fn run<'a, T>(
        table: &'a [T],
        name: &'static str,
        first: u32,
        len: u32,
    ) -> Result<&'a [T], Flaw> {
        let end = first.saturating_add(len);
        let missing =
            Flaw::Beyond { table: name, index: end.saturating_sub(1), len: table.len() as u32 };
        table.get(first as usize..end as usize).ok_or(missing)
    }

    fn code<'a>(&self, tables: &Tables<'a, S>) -> &'a [u8] {
        Self::run(tables.code, "code", self.code, self.code_len.into()).unwrap_or(&[])
    }

    fn numbers<'a>(&self, tables: &Tables<'a, S>) -> &'a [S] {
        Self::run(tables.numbers, "numbers", self.numbers, self.numbers_len.into()).unwrap_or(&[])
    }

    fn cuboid(&self, tables: &Tables<'_, S>) -> Cuboid<S> {
        match Self::run(tables.points, "points", self.corners, 2) {
            Ok(&[min, max]) => Cuboid { min, max },
            _ => Cuboid { min: S::Vec3::ZERO, max: S::Vec3::ZERO },
        }
    }

    /// The part of a ray that is looked at; `None` beside the box, or outward from a face of it.
    fn reach(&self, sight: &Sight<'_, S>) -> Option<Reach<S>> {
        let cuboid = self.cuboid(sight.tables);
        let Some(start) = sight.start else {
            let ray = Local::recentred(sight.line, sight.place, self.center);
            let span = cuboid.placed_crossing(&ray).filter(Span::is_open)?;
            return Some(Reach { ray, span, inward: None });
        };
        let &Start { face, inward, local, .. } = start;
        if face != SURFACE && !inward {
            return None;
        }
        let ray = Local::from_surface(sight.line, sight.place, local);
        let exit = cuboid.way_out(&ray, face.checked_sub(1));
        let enter = End { t: S::Wide::ZERO, face: face.wrapping_sub(1) };
        Some(Reach { ray, span: Span { enter, exit }, inward: Some(inward) })
    }

    fn middle(&self, tables: &Tables<'_, S>) -> S::Vec3 {
        let Cuboid { min, max } = self.cuboid(tables);
        (min + max) * S::HALF
    }

    /// F and its slopes along the three axes, at a local point.
    fn gradient(&self, p: S::WideVec, tables: &Tables<'_, S>) -> (S::Wide, S::WideVec) {
        let (code, numbers) = (self.code(tables), self.numbers(tables));
        let along = |axis: Axis| {
            let at = Axis::ALL.map(|other| {
                let slope = if other == axis { S::Wide::ONE } else { S::Wide::ZERO };
                Dual { value: p.get(other), slope }
            });
            program::run::<S, S::Wide>(code, numbers, at)
        };
        let [x, y, z] = Axis::ALL.map(along);
        (x.value, S::WideVec::new(x.slope, y.slope, z.slope))
    }
}

/// Spans on their way out: one waits until it is known that it does not go on.
struct Outlet<S, E> {
    emit: E,
    waiting: Option<Span<S>>,
    /// How many more may be given.
    left: u16,
}

impl<S: Scalar, E: FnMut(Span<S>)> Outlet<S, E> {
    fn give(&mut self, span: Span<S>) {
        let span = span.solid();
        match &mut self.waiting {
            // Rounding closed the gap, or there is no room for another span.
            Some(last) if self.left <= 1 || span.enter.t <= last.exit.t => last.exit = span.exit,
            waiting => {
                if let Some(last) = waiting.replace(span) {
                    self.left -= 1;
                    (self.emit)(last);
                }
            }
        }
    }

    fn finish(mut self) {
        if let Some(last) = self.waiting {
            (self.emit)(last);
        }
    }
}

impl<S: Scalar> Primitive<S> for Implicit<S> {
    fn centre(&self) -> S::Vec3 {
        self.center
    }

    fn check(&self, placed: bool, tables: &Tables<'_, S>) -> Result<(), Flaw> {
        check_centre::<S>(self.center, placed)?;
        Self::run(tables.points, "points", self.corners, 2)?;
        self.cuboid(tables).check(placed, tables)?;
        let code = Self::run(tables.code, "code", self.code, self.code_len.into())?;
        let numbers = Self::run(tables.numbers, "numbers", self.numbers, self.numbers_len.into())?;
        if !numbers.iter().all(|number| number.is_finite()) {
            return Err(Flaw::NotFinite("numbers"));
        }
        if self.spans == 0 {
            return Err(Flaw::NotPositive("spans"));
        }
        program::check(code, numbers).map_err(Flaw::Program)
    }

    fn bounds(&self, place: Option<&Placement<S>>, tables: &Tables<'_, S>) -> Bounds<S> {
        let Cuboid { min, max } = self.cuboid(tables);
        let (min, max) = (min + self.center, max + self.center);
        Cuboid { min, max }.bounds(place, tables)
    }

    /// The part of the ray within the box is halved until intervals prove of each piece that it
    /// has no boundary, or at most one.
    fn spans(&self, sight: &Sight<'_, S>, emit: impl FnMut(Span<S>)) {
        self.spans_until(sight, S::FAR, emit);
    }

    // Out of line: what it keeps on the stack is there for such solids only.
    #[inline(never)]
    fn spans_until(&self, sight: &Sight<'_, S>, until: S, emit: impl FnMut(Span<S>)) {
        let Some(Reach { ray, span, inward }) = self.reach(sight) else {
            return;
        };
        let (code, numbers) = (self.code(sight.tables), self.numbers(sight.tables));
        let none = Dual { value: S::Wide::ZERO, slope: S::Wide::ZERO };
        let mut along = Along { code, numbers, ray, start: none };
        let on_surface = sight.start.is_some_and(|start| start.face == SURFACE);
        let inside = match inward {
            None => along.is_inside(span.enter.t),
            Some(inward) => inward,
        };
        if on_surface {
            along.start = along.at(span.enter.t).deflated(inside);
        }
        let face = |end: End<S::Wide>| End { t: end.t, face: end.face.wrapping_add(1) };
        // What lies ahead of a start on the surface lies beyond it.
        let least = if inward.is_some() { S::TINY } else { -S::FAR };
        let arrive = |end: End<S::Wide>| End { t: ray.arrive(end.t).max(least), face: end.face };
        let mut outlet = Outlet { emit, waiting: None, left: self.spans };
        let mut crossings = Crossings::new(&along, [span.enter.t, span.exit.t], on_surface, inside);
        let mut enter = inside.then(|| {
            let End { t, face } = face(span.enter);
            End { t: ray.arrive(t), face }
        });
        while let Some(t) = crossings.next(until) {
            let end = arrive(End { t, face: SURFACE });
            enter = match enter {
                None => Some(end),
                Some(enter) => {
                    outlet.give(Span { enter, exit: end });
                    None
                }
            };
        }
        if let Some(enter) = enter {
            outlet.give(Span { enter, exit: arrive(face(span.exit)) });
        }
        outlet.finish();
    }

    /// One step of Newton's along the gradient, kept in the box.
    fn snap(&self, local: S::WideVec, face: u32, tables: &Tables<'_, S>) -> S::Vec3 {
        let cuboid = self.cuboid(tables);
        let Some(side) = face.checked_sub(1) else {
            let (value, gradient) = self.gradient(local, tables);
            let shift = gradient * (value / gradient.length_squared());
            let extent = S::widen_vec(cuboid.max - cuboid.min).max_abs();
            let near = shift.max_abs() <= extent * S::EPSILON_ROOT.widen();
            let snapped = S::narrow_vec(if near { local - shift } else { local });
            return snapped.zip(cuboid.min, S::max).zip(cuboid.max, S::min);
        };
        cuboid.snap(local, side, tables)
    }

    /// The gradient; where it is 0, away from the middle of the box.
    fn normal(&self, local: S::Vec3, face: u32, tables: &Tables<'_, S>) -> S::WideVec {
        if let Some(side) = face.checked_sub(1) {
            return self.cuboid(tables).normal(local, side, tables);
        }
        let (_, gradient) = self.gradient(S::widen_vec(local), tables);
        if gradient.is_finite() && gradient != S::WideVec::ZERO {
            return gradient;
        }
        let away = S::widen_vec(local - self.middle(tables));
        if away == S::WideVec::ZERO { away.with(Axis::Y, S::Wide::ONE) } else { away }
    }

    /// On the surface longitude and latitude about the middle of the box, on a face of the box the
    /// place on it; each in 0..=1.
    fn uv(&self, local: S::Vec3, face: u32, tables: &Tables<'_, S>) -> [S; 2] {
        if let Some(side) = face.checked_sub(1) {
            return self.cuboid(tables).uv(local, side, tables);
        }
        let away = local - self.middle(tables);
        let height = S::widen_vec(away).normalize().y();
        [turn(away.x(), away.z()), S::narrow(S::Wide::ONE - height.acos() / S::Wide::PI)]
    }
}

#[cfg(test)]
mod tests;

//! A ray's way through a blob: from breakpoint to breakpoint, none of which is kept.
//!
//! A component is there on an interval of the ray and is the square of a quadratic there, so between two
//! neighbouring ends of such intervals the field is a quartic. Its coefficients in Bernstein's basis are sums of
//! products that are not greater than the strengths, and where they have one sign there is no boundary. What
//! the field is at the end of a piece is computed once and taken over by the next one, so no boundary there is lost
//! or met twice; before the first breakpoint and after the last one there is no field, so there is an even number.

use super::part::{Part, Path};
use super::{Blob, field};
use crate::place::Local;
use crate::roots::bernstein_crossings;
use crate::scalar::{Number, Real, Scalar, Vector};
use crate::shape::{Sight, Tables};
use crate::span::Span;

/// How many parts of components are kept; where a ray meets more, all are worked out again for each piece.
pub(super) const ROOM: usize = 8;

/// The boundaries along a ray, in ascending order.
pub(super) struct Course<'a, S: Scalar> {
    blob: &'a Blob<S>,
    tables: &'a Tables<'a, S>,
    path: Path<S>,
    /// The parts that the ray meets, if there is room for them.
    kept: [Part<S::Wide>; ROOM],
    pub(super) met: u32,
    /// The parameter of the path's origin, and how much it grows along a unit of the path.
    shift: S,
    pace: S::Wide,
    threshold: S::Wide,
    /// The ray starts on the surface, at the origin of the path.
    departs: bool,
    /// Where the next piece begins, and what the field is there beyond the threshold.
    from: S::Wide,
    value: S::Wide,
    /// Where it ends; none after the last one.
    to: Option<S::Wide>,
    /// The boundaries of the last piece, those that are given and those to come.
    found: [S::Wide; 4],
    given: u32,
    left: u32,
    /// The ray is inside at the last boundary that was given.
    inside: bool,
    #[cfg(test)]
    pub(super) pieces: u32,
}

impl<'a, S: Scalar> Course<'a, S> {
    /// The boundaries from a place of the ray on; `None` beside all components.
    #[inline(never)]
    pub(super) fn new(blob: &'a Blob<S>, sight: &Sight<'a, S>, low: S) -> Option<Self> {
        let ray = match sight.start {
            None => Local::recentred(sight.line, sight.place, blob.center),
            Some(start) => Local::from_surface(sight.line, sight.place, start.local),
        };
        let pace = ray.inv_dd.sqrt();
        let threshold = blob.threshold(sight.tables);
        let mut course = Self {
            blob,
            tables: sight.tables,
            path: Path { origin: ray.origin, dir: ray.dir * pace },
            kept: [Part::NONE; ROOM],
            met: 0,
            shift: ray.shift,
            pace,
            threshold,
            departs: sight.start.is_some(),
            from: S::Wide::ZERO,
            value: S::Wide::ZERO,
            to: None,
            found: [S::Wide::ZERO; 4],
            given: 0,
            left: 0,
            inside: sight.start.is_some_and(|start| start.inward),
            #[cfg(test)]
            pieces: 0,
        };
        course.keep();
        if course.departs {
            // A component that begins or ends this near to the start changes nothing that can be told.
            let near = S::EPSILON_ROOT.widen() * S::Wide::from_ratio(1, 8);
            course.to = course.breakpoint(|radius| radius * near);
        } else {
            course.from = course.breakpoint(|_| -S::Wide::FAR)?;
            course.value = -threshold;
            let from = course.from;
            course.to = course.breakpoint(|_| from);
        }
        while let Some(to) = course.to {
            if !(course.arrive(to) < low) {
                break;
            }
            let coefficients = course.piece(to);
            course.inside = !(coefficients[4] < S::Wide::ZERO);
        }
        Some(course)
    }

    /// The ray's own parameter for a way along the path.
    #[inline]
    fn arrive(&self, s: S::Wide) -> S {
        S::narrow(self.shift.widen() + s * self.pace)
    }

    #[inline(never)]
    fn keep(&mut self) {
        let (kept, met) = (&mut self.kept, &mut self.met);
        for component in self.blob.components(self.tables) {
            component.parts(&self.path, |part| {
                if let Some(slot) = kept.get_mut(*met as usize) {
                    *slot = *part;
                }
                *met += 1;
            });
        }
    }

    /// Gives the parts that the ray meets, component by component.
    #[inline]
    fn each(&self, mut each: impl FnMut(&Part<S::Wide>)) {
        if let Some(kept) = self.kept.get(..self.met as usize) {
            return kept.iter().for_each(each);
        }
        for component in self.blob.components(self.tables) {
            component.parts(&self.path, &mut each);
        }
    }

    /// The first breakpoint after a place that depends on the radius of the component.
    #[inline(never)]
    fn breakpoint(&self, after: impl Fn(S::Wide) -> S::Wide) -> Option<S::Wide> {
        let mut first = None;
        self.each(|part| {
            let after = after(part.radius);
            for at in [part.from, part.to] {
                if at > after && first.is_none_or(|first| at < first) {
                    first = Some(at);
                }
            }
        });
        first
    }

    /// The coefficients of the field beyond the threshold from here to the end of the piece, and goes there.
    ///
    /// Of a ray that starts on the surface, where the field is the threshold, its change since the start is
    /// summed, so that what is near the start does not drown in what is there.
    #[inline(never)]
    fn piece(&mut self, to: S::Wide) -> [S::Wide; 5] {
        let ends = [self.from, to];
        let middle = self.from + (to - self.from) * S::Wide::HALF;
        let base = if self.departs { S::Wide::ZERO } else { -self.threshold };
        let mut sum = [base; 5];
        let mut next = None;
        self.each(|part| {
            for at in [part.from, part.to] {
                if at > to && next.is_none_or(|next| at < next) {
                    next = Some(at);
                }
            }
            let at_start = self.departs && part.contains(S::Wide::ZERO);
            if part.contains(middle) {
                part.add(&mut sum, ends, at_start);
            } else if at_start {
                let gone = part.value(S::Wide::ZERO).squared() * part.strength;
                sum = sum.map(|sum| sum - gone);
            }
        });
        let [first, .., last] = &mut sum;
        *first = self.value;
        if next.is_none() {
            *last = -self.threshold;
        }
        (self.value, self.from, self.to) = (*last, to, next);
        #[cfg(test)]
        {
            self.pieces += 1;
        }
        sum
    }

    /// Finds the boundaries of the next piece.
    #[inline(never)]
    fn solve(&mut self, to: S::Wide) {
        let (from, at_start) = (self.from, self.departs && self.from == S::Wide::ZERO);
        let coefficients = self.piece(to);
        (self.given, self.left) = (0, 0);
        let found = |u: S::Wide| {
            if let Some(slot) = self.found.get_mut(self.left as usize) {
                *slot = from + (to - from) * u;
                self.left += 1;
            }
        };
        if at_start {
            bernstein_crossings(&deflated(&coefficients, self.inside), found);
        } else {
            bernstein_crossings(&coefficients, found);
        }
    }

    /// The next boundary, if it may lie up to `until`; `inside` is then as it is beyond it.
    fn next(&mut self, until: S) -> Option<S::Wide> {
        // One piece after the other, at most as many as there are breakpoints.
        loop {
            if self.given < self.left {
                let at = self.found.get(self.given as usize).copied();
                self.given += 1;
                self.inside = !self.inside;
                return at;
            }
            let to = self.to?;
            if self.arrive(self.from) > until {
                return None;
            }
            self.solve(to);
        }
    }
}

/// A quartic that is 0 at its beginning, divided by its parameter. What it is at the beginning then is its slope,
/// whose sign is known.
///
/// `Σ cᵢ·C(4,i)·uⁱ⁻¹·(1−u)⁴⁻ⁱ = Σ (cᵢ·4/i)·C(3,i−1)·uⁱ⁻¹·(1−u)⁴⁻ⁱ`.
fn deflated<T: Real>([_, a, b, c, d]: &[T; 5], inward: bool) -> [T; 4] {
    let four = T::TWO + T::TWO;
    let slope = *a * four;
    let slope = if inward { slope.max(T::TINY) } else { slope.min(-T::TINY) };
    [slope, *b * T::TWO, *c * T::from_ratio(4, 3), *d]
}

/// The spans along a ray, in ascending order.
pub(super) struct Spans<'a, S: Scalar> {
    pub(super) course: Course<'a, S>,
    until: S,
    /// A span that the next one may still join.
    waiting: Option<Span<S>>,
    /// How many more may be given.
    left: u32,
    begun: bool,
}

impl<'a, S: Scalar> Spans<'a, S> {
    /// Those that have to do with a part of the ray.
    pub(super) fn new(
        blob: &'a Blob<S>,
        sight: &Sight<'a, S>,
        [low, until]: [S; 2],
    ) -> Option<Self> {
        let course = Course::new(blob, sight, low)?;
        Some(Self { course, until, waiting: None, left: blob.spans_max(), begun: false })
    }

    /// The next span; of those beyond the part of the ray not all are given.
    pub(super) fn next(&mut self) -> Option<Span<S>> {
        while let Some(span) = self.find() {
            match &mut self.waiting {
                // Rounding closed the gap, or made one where there can be none.
                Some(last) if self.left <= 1 || span.enter.t <= last.exit.t => {
                    last.exit.t = span.exit.t.max(last.exit.t);
                }
                waiting => {
                    if let Some(last) = waiting.replace(span) {
                        self.left -= 1;
                        return Some(last);
                    }
                }
            }
        }
        self.waiting.take()
    }

    /// The next stretch inside, as long as there is one.
    fn find(&mut self) -> Option<Span<S>> {
        let course = &mut self.course;
        let least = if course.departs { S::TINY } else { -S::FAR };
        if course.inside && !self.begun {
            self.begun = true;
            let enter = course.arrive(course.from);
            let exit = course.next(self.until).unwrap_or(course.from);
            return Some(Span::of_face(0, enter, course.arrive(exit).max(least)).solid());
        }
        self.begun = true;
        loop {
            let enter = course.next(self.until)?;
            let exit = course.next(self.until).unwrap_or(course.from);
            if enter < exit {
                let [enter, exit] = [enter, exit].map(|at| course.arrive(at).max(least));
                return Some(Span::of_face(0, enter, exit).solid());
            }
        }
    }
}

/// The field at a point and how steeply it falls, of all components.
pub(super) fn sample<S: Scalar>(
    blob: &Blob<S>,
    tables: &Tables<'_, S>,
    p: S::WideVec,
) -> (S::Wide, S::WideVec) {
    let (mut sum, mut fall) = (S::Wide::ZERO, S::WideVec::ZERO);
    for component in blob.components(tables) {
        let (value, slope) = field(&component, p);
        sum += value;
        fall += slope;
    }
    (sum, fall)
}

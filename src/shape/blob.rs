//! The blob: metaballs and metacylinders whose fields add up.

mod check;
mod course;
mod part;
#[cfg(test)]
mod tests;

use super::{Flaw, Primitive, Sight, Tables, turn};
use crate::bounds::Bounds;
use crate::place::{Placement, apply};
use crate::scalar::{Axis, Number, Real, Scalar, Vector};
use crate::span::{End, Passage, Span};
use course::{Spans, sample};

/// Where the fields of some components add up to more than a threshold.
///
/// The field of a component is `strength·(1 − r²/R²)²` up to its radius R and 0 beyond, in the distance r from
/// its centre, or from a segment, which makes a cylinder with round ends. A negative strength takes
/// away. The surface is smooth wherever the field is.
///
/// Along a ray the field is made of quartics between the breakpoints of the components: two of a ball and four of a
/// cylinder. All roots of each are isolated, so nothing is stepped over, however thin it is; their precision is that
/// of the sum of the strengths.
///
/// Source: J. F. Blinn, "A generalization of algebraic surface drawing" (1982), for surfaces of summed fields; G.
/// Wyvill, C. McPheeters and B. Wyvill, "Data structure for soft objects" (1986), for fields of finite radius; the field
/// and its name are those of POV-Ray (its documentation, under "Blob").
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blob<S: Scalar> {
    /// The origin of the components' coordinates; zero for a placed solid.
    pub center: S::Vec3,
    /// The index of the first of two points for each component: the ends of its segment, which are equal for a ball.
    pub points: u32,
    /// The index of the threshold in the table of numbers, which is greater than 0; two follow for each component,
    /// its radius and its strength.
    pub numbers: u32,
    /// How many components there are.
    pub count: u16,
    /// How many of them are cylinders.
    pub cylinders: u16,
}

/// A component of a blob, for long formulas.
#[derive(Clone, Copy)]
struct Component<S: Scalar> {
    ends: [S::WideVec; 2],
    radius: S::Wide,
    strength: S::Wide,
}

impl<S: Scalar> Blob<S> {
    /// The breakpoints that its components may have on a ray: two of each ball, where it begins and ends, and two
    /// more of each cylinder, where its round ends begin.
    const fn breakpoints(&self) -> u32 {
        2 * (self.count as u32 + self.cylinders as u32)
    }

    /// The greatest number of spans along any ray.
    ///
    /// The slope of the field is continuous and 0 before the first breakpoint and after the last. By Rolle's theorem the
    /// curvature changes its sign at least as often as the field goes through the threshold. It does so twice at most between two of B
    /// breakpoints, for it is of the second degree there, and once more at each but the first and the last: 3B − 4 times.
    pub(super) const fn spans_max(&self) -> u32 {
        (3 * self.breakpoints() / 2).saturating_sub(2)
    }

    fn points<'a>(&self, tables: &Tables<'a, S>) -> &'a [S::Vec3] {
        let first = self.points as usize;
        tables.points.get(first..first.saturating_add(2 * usize::from(self.count))).unwrap_or(&[])
    }

    fn numbers<'a>(&self, tables: &Tables<'a, S>) -> &'a [S] {
        let first = (self.numbers as usize).saturating_add(1);
        tables.numbers.get(first..first.saturating_add(2 * usize::from(self.count))).unwrap_or(&[])
    }

    fn threshold(&self, tables: &Tables<'_, S>) -> S::Wide {
        tables.numbers.get(self.numbers as usize).map_or(S::Wide::ONE, |number| number.widen())
    }

    fn components<'a>(
        &self,
        tables: &Tables<'a, S>,
    ) -> impl Iterator<Item = Component<S>> + use<'a, S> {
        let numbers = self.numbers(tables).chunks_exact(2);
        self.points(tables).chunks_exact(2).zip(numbers).filter_map(|(ends, numbers)| {
            let (&[from, to], &[radius, strength]) = (ends, numbers) else {
                return None;
            };
            let ends = [from, to].map(S::widen_vec);
            Some(Component { ends, radius: radius.widen(), strength: strength.widen() })
        })
    }
}

/// The field of a component at a point, and how steeply it falls.
fn field<S: Scalar>(component: &Component<S>, p: S::WideVec) -> (S::Wide, S::WideVec) {
    let Component { ends: [from, to], radius, strength } = *component;
    let axis = to - from;
    let square = axis.length_squared();
    let share = if square > S::Wide::ZERO { axis.dot(p - from) / square } else { S::Wide::ZERO };
    let near = if share < S::Wide::ONE { from + axis * share.max(S::Wide::ZERO) } else { to };
    let inverse = S::Wide::ONE / radius;
    let away = (p - near) * inverse;
    let height = S::Wide::ONE - away.length_squared();
    if !(height > S::Wide::ZERO) {
        return (S::Wide::ZERO, S::WideVec::ZERO);
    }
    let fall = away * (strength * height * inverse * S::Wide::from_i32(4));
    (strength * height.squared(), fall)
}

impl<S: Scalar> Primitive<S> for Blob<S> {
    fn centre(&self) -> S::Vec3 {
        self.center
    }

    fn check(&self, placed: bool, tables: &Tables<'_, S>) -> Result<(), Flaw> {
        check::check(self, placed, tables)
    }

    /// Around the components that add to the field.
    fn bounds(&self, place: Option<&Placement<S>>, tables: &Tables<'_, S>) -> Bounds<S> {
        let mut bounds = Bounds::nothing();
        for Component { ends: [from, to], radius, strength } in self.components(tables) {
            if !(strength > S::Wide::ZERO) {
                continue;
            }
            let (middle, half) = ((from + to) * S::Wide::HALF, (to - from) * S::Wide::HALF);
            let (middle, half, reach) = match place {
                None => {
                    let reach = S::WideVec::splat(radius);
                    (middle + S::widen_vec(self.center), half, reach)
                }
                Some(place) => {
                    let [x, y, z] = place.to_world.map(|row| row.length() * radius);
                    let middle = apply::<S>(&place.to_world, middle) + S::widen_vec(place.anchor);
                    (middle, apply::<S>(&place.to_world, half), S::WideVec::new(x, y, z))
                }
            };
            let extent = S::narrow_vec(half.map(Number::abs) + reach);
            bounds = bounds.union(&Bounds::about(S::narrow_vec(middle), extent));
        }
        bounds
    }

    fn spans(&self, sight: &Sight<'_, S>, emit: impl FnMut(Span<S>)) {
        self.spans_within(sight, [-S::FAR, S::FAR], emit);
    }

    fn spans_until(&self, sight: &Sight<'_, S>, until: S, emit: impl FnMut(Span<S>)) {
        self.spans_within(sight, [-S::FAR, until], emit);
    }

    // Out of line: what it keeps on the stack is there for such solids only.
    #[inline(never)]
    fn spans_within(&self, sight: &Sight<'_, S>, window: [S; 2], mut emit: impl FnMut(Span<S>)) {
        let Some(mut spans) = Spans::new(self, sight, window) else {
            return;
        };
        while let Some(span) = spans.next() {
            emit(span);
        }
    }

    /// Pieces beyond the boundary are not looked at.
    // Out of line: what it keeps on the stack is there for such solids only.
    #[inline(never)]
    fn first(
        &self,
        sight: &Sight<'_, S>,
        window: [S; 2],
        _: bool,
    ) -> (bool, Option<(End<S>, Passage)>) {
        let Some(mut spans) = Spans::new(self, sight, window) else {
            return (false, None);
        };
        let [after, before] = window;
        let mut inside = false;
        while let Some(Span { enter, exit }) = spans.next() {
            inside |= enter.t <= after && after < exit.t;
            for (end, passage) in [(enter, Passage::Enter), (exit, Passage::Leave)] {
                if end.t > after {
                    return (inside, (end.t < before).then_some((end, passage)));
                }
            }
        }
        (inside, None)
    }

    /// One step of Newton's along the gradient.
    fn snap(&self, local: S::WideVec, _: u32, tables: &Tables<'_, S>) -> S::Vec3 {
        let (value, fall) = sample(self, tables, local);
        let shift = fall * ((value - self.threshold(tables)) / fall.length_squared());
        let extent = self.components(tables).fold(S::Wide::ZERO, |extent, component| {
            let near = component.ends[0].max_abs() + component.radius;
            extent.max(near)
        });
        let near = shift.max_abs() <= extent * S::EPSILON_ROOT.widen();
        S::narrow_vec(if near { local + shift } else { local })
    }

    /// The way in which the field falls; where it does not, away from the middle.
    fn normal(&self, local: S::Vec3, _: u32, tables: &Tables<'_, S>) -> S::WideVec {
        let away = S::widen_vec(local);
        let (_, fall) = sample(self, tables, away);
        if fall.is_finite() && fall != S::WideVec::ZERO {
            fall
        } else if away == S::WideVec::ZERO {
            away.with(Axis::Y, S::Wide::ONE)
        } else {
            away
        }
    }

    /// Longitude and latitude about the origin of the components' coordinates, each in 0..=1.
    fn uv(&self, local: S::Vec3, _: u32, _: &Tables<'_, S>) -> [S; 2] {
        let height = S::widen_vec(local).normalize().y();
        [turn(local.x(), local.z()), S::narrow(S::Wide::ONE - height.acos() / S::Wide::PI)]
    }
}

//! The general quadric: ellipsoids, hyperboloids, paraboloids, elliptic cylinders and cones, by
//! coefficients.

use super::{Flaw, Primitive, Sight, Tables, check_centre, turn};
use crate::bounds::Bounds;
use crate::place::{Local, Placement};
use crate::scalar::{Axis, Number, Real, Scalar, Vector};
use crate::span::Span;

/// Where a polynomial of the second degree is not positive: `Q(p) ≤ 0`, in coordinates from the
/// centre. It may go on for ever, and it may have two parts; an intersection with a box makes an end of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quadric<S: Scalar> {
    /// The origin of the polynomial's coordinates; zero for a placed quadric.
    pub center: S::Vec3,
    /// The first of its ten coefficients among the numbers: of x², y², z², xy, yz, zx, x, y, z, and 1.
    pub first: u32,
}

/// How many coefficients a quadric has.
const COEFFICIENTS: u32 = 10;

/// `p·M·p + g·p + constant` with a symmetric matrix by its rows.
#[derive(Clone, Copy)]
struct Polynomial<S: Scalar> {
    rows: [S::WideVec; 3],
    linear: S::WideVec,
    constant: S::Wide,
}

impl<S: Scalar> Polynomial<S> {
    fn new(coefficients: [S; COEFFICIENTS as usize]) -> Self {
        let [xx, yy, zz, xy, yz, zx, x, y, z, constant] = coefficients.map(S::widen);
        let [xy, yz, zx] = [xy, yz, zx].map(|v| v * S::Wide::HALF);
        Self {
            rows: [
                S::WideVec::new(xx, xy, zx),
                S::WideVec::new(xy, yy, yz),
                S::WideVec::new(zx, yz, zz),
            ],
            linear: S::WideVec::new(x, y, z),
            constant,
        }
    }

    /// `M·v`.
    #[inline]
    fn bent(&self, v: S::WideVec) -> S::WideVec {
        let [x, y, z] = self.rows.map(|row| row.dot(v));
        S::WideVec::new(x, y, z)
    }

    #[inline]
    fn value(&self, p: S::WideVec) -> S::Wide {
        (self.bent(p) + self.linear).dot(p) + self.constant
    }

    #[inline]
    fn gradient(&self, p: S::WideVec) -> S::WideVec {
        self.bent(p) * S::Wide::TWO + self.linear
    }

    fn negated(&self) -> Self {
        Self { rows: self.rows.map(|row| -row), linear: -self.linear, constant: -self.constant }
    }

    /// It is negative nowhere: completing squares from the greatest on leaves nothing but a constant
    /// that is not negative.
    fn is_nowhere_negative(mut self) -> bool {
        for _ in 0..3 {
            let (mut axis, mut pivot, mut row) = (Axis::X, S::Wide::ZERO, S::WideVec::ZERO);
            for (candidate, of) in self.rows.into_iter().zip(Axis::ALL) {
                let square = candidate.get(of);
                if square < S::Wide::ZERO {
                    return false;
                }
                if square > pivot {
                    (axis, pivot, row) = (of, square, candidate);
                }
            }
            if pivot == S::Wide::ZERO {
                break;
            }
            // Without the square of (row·p + g/2)/√pivot.
            let along = self.linear.get(axis);
            let share = row.map(|v| v / pivot);
            for (rest, of) in self.rows.iter_mut().zip(Axis::ALL) {
                *rest = (*rest - share * row.get(of)).with(axis, S::Wide::ZERO);
                if of == axis {
                    *rest = S::WideVec::ZERO;
                }
            }
            self.linear = (self.linear - share * along).with(axis, S::Wide::ZERO);
            let quarter = S::Wide::HALF * S::Wide::HALF;
            self.constant -= along / pivot * along * quarter;
        }
        let rest = self.rows.iter().chain([&self.linear]);
        rest.fold(S::Wide::ZERO, |most, row| most.max(row.max_abs())) == S::Wide::ZERO
            && self.constant >= S::Wide::ZERO
    }
}

impl<S: Scalar> Quadric<S> {
    fn polynomial(&self, tables: &Tables<'_, S>) -> Polynomial<S> {
        let mut from = tables.numbers.iter().skip(self.first as usize);
        Polynomial::new([S::ZERO; COEFFICIENTS as usize].map(|zero| *from.next().unwrap_or(&zero)))
    }

    /// The spans of a ray that starts on the surface: the polynomial along it has lost its constant
    /// term, and the sign just after the start is known.
    fn later_spans(&self, sight: &Sight<'_, S>, local: S::Vec3, inward: bool) -> Option<Span<S>> {
        let polynomial = self.polynomial(sight.tables);
        let ray = Local::from_surface(sight.line, sight.place, local);
        let a = polynomial.bent(ray.dir).dot(ray.dir);
        let slope = polynomial.gradient(ray.origin).dot(ray.dir).abs();
        let turns_back = if inward { a > S::Wide::ZERO } else { a < S::Wide::ZERO };
        let other = if turns_back { S::narrow(slope / a.abs()).max(S::TINY) } else { S::FAR };
        if inward {
            Some(Span::of_face(0, S::ZERO, other))
        } else {
            (other < S::FAR).then(|| Span::of_face(0, other, S::FAR))
        }
    }

    /// The spans of a ray from elsewhere: `a·t² + 2·b·t + c ≤ 0`.
    #[inline(never)]
    fn all_spans(&self, sight: &Sight<'_, S>) -> [Option<Span<S>>; 2] {
        let polynomial = self.polynomial(sight.tables);
        let ray = Local::recentred(sight.line, sight.place, self.center);
        let bent = polynomial.bent(ray.dir);
        let a = bent.dot(ray.dir);
        let b = bent.dot(ray.origin) + polynomial.linear.dot(ray.dir) * S::Wide::HALF;
        let c = polynomial.value(ray.origin);
        let (zero, far) = (S::Wide::ZERO, S::Wide::FAR);
        let size = a.abs().max(b.abs()).max(c.abs());
        if !(size > zero && size.is_finite()) {
            // In the surface, where it has straight lines.
            return [None, None];
        }
        // Divided by the greatest only where the squares leave the range: division rounds.
        let square = b.squared().max((a * c).abs());
        let sound = square.is_finite() && square > S::Wide::TINY;
        let [a, b, c] = if sound { [a, b, c] } else { [a / size, b / size, c / size] };
        let span = |from: S::Wide, to: S::Wide| {
            let end = |t: S::Wide| if t.abs() < far { ray.arrive(t) } else { S::narrow(t) };
            let (enter, exit) = (end(from), end(to));
            // Not beyond the ends of what the format can tell.
            (enter < S::FAR && -S::FAR < exit).then(|| Span::of_face(0, enter, exit))
        };
        if a == zero {
            let root = -c / (b * S::Wide::TWO);
            return match (b > zero, b < zero) {
                (true, _) => [span(-far, root), None],
                (_, true) => [span(root, far), None],
                _ => [if c < zero { span(-far, far) } else { None }, None],
            };
        }
        let discriminant = S::det2(b, b, a, c);
        if !(discriminant > zero) {
            return [if a < zero { span(-far, far) } else { None }, None];
        }
        // Both roots without cancellation: q/a and c/q.
        let root = discriminant.sqrt();
        let q = if b < zero { root - b } else { -(root + b) };
        let (first, second) = (q / a, c / q);
        let (low, high) = (first.min(second), first.max(second));
        if a > zero {
            return [span(low, high), None];
        }
        let pair = [span(-far, low), span(high, far)];
        match pair {
            // No number in the gap.
            [Some(left), Some(right)] if !(left.exit.t < right.enter.t) => [span(-far, far), None],
            pair => pair,
        }
    }
}

impl<S: Scalar> Primitive<S> for Quadric<S> {
    fn centre(&self) -> S::Vec3 {
        self.center
    }

    fn check(&self, placed: bool, tables: &Tables<'_, S>) -> Result<(), Flaw> {
        check_centre::<S>(self.center, placed)?;
        let last = self.first.saturating_add(COEFFICIENTS - 1);
        if last as usize >= tables.numbers.len() {
            let len = tables.numbers.len() as u32;
            return Err(Flaw::Beyond { table: "numbers", index: last, len });
        }
        let all = tables.numbers.iter().skip(self.first as usize).take(COEFFICIENTS as usize);
        for &coefficient in all {
            if !coefficient.is_finite() {
                return Err(Flaw::NotFinite("coefficients"));
            } else if coefficient.abs() > S::COORD_MAX {
                return Err(Flaw::TooLarge("coefficients"));
            }
        }
        // A polynomial without a change of sign bounds nothing.
        let polynomial = self.polynomial(tables);
        if polynomial.is_nowhere_negative() || polynomial.negated().is_nowhere_negative() {
            return Err(Flaw::Empty("coefficients"));
        }
        Ok(())
    }

    /// Everything: where a quadric ends is not worked out.
    fn bounds(&self, _: Option<&Placement<S>>, _: &Tables<'_, S>) -> Bounds<S> {
        Bounds::everywhere()
    }

    /// The polynomial along the ray, recentred; its two roots without cancellation, its
    /// discriminant with the exact sign of the terms. A ray from the surface has its other root at −2b/a.
    // Out of line: what it keeps on the stack is there for such solids only.
    #[inline(never)]
    fn spans(&self, sight: &Sight<'_, S>, emit: impl FnMut(Span<S>)) {
        let spans = match sight.start {
            Some(start) => [self.later_spans(sight, start.local, start.inward), None],
            None => self.all_spans(sight),
        };
        spans.into_iter().flatten().for_each(emit);
    }

    fn snap(&self, local: S::WideVec, _: u32, tables: &Tables<'_, S>) -> S::Vec3 {
        let polynomial = self.polynomial(tables);
        let gradient = polynomial.gradient(local);
        let steepness = gradient.max_abs();
        if steepness > S::Wide::ZERO && steepness.is_finite() {
            // One step down the slope; at the tip of a cone there is none.
            let slope = gradient.scaled_down(steepness);
            let step = slope * (polynomial.value(local) / steepness / slope.length_squared());
            if step.max_abs() <= local.max_abs() * S::EPSILON_ROOT.widen() {
                return S::narrow_vec(local - step);
            }
        }
        S::narrow_vec(local)
    }

    fn normal(&self, local: S::Vec3, _: u32, tables: &Tables<'_, S>) -> S::WideVec {
        let normal = self.polynomial(tables).gradient(S::widen_vec(local));
        if normal.max_abs() > S::Wide::ZERO {
            normal
        } else {
            S::WideVec::ZERO.with(Axis::Y, S::Wide::ONE)
        }
    }

    /// The angle around the local y axis as u, in 0..=1, and the height along it as v.
    fn uv(&self, local: S::Vec3, _: u32, _: &Tables<'_, S>) -> [S; 2] {
        [turn(local.x(), local.z()), local.y()]
    }
}

//! Programs: formulas of x, y and z in bytes, for a machine with a stack.
//!
//! A byte is an operation; some are followed by one byte more. Operands are taken from the stack
//! and the result is put there; at the end it holds one number.
//!
//! | operation | then | from the stack | result |
//! | --- | --- | --- | --- |
//! | [`X`], [`Y`], [`Z`] | | | a coordinate of the point |
//! | [`NUMBER`] | i | | the i-th number of the program |
//! | [`COPY`] | i | | the entry i below the top: 0 is the top itself |
//! | [`ADD`], [`SUB`], [`MUL`] | | a, b | a + b, a − b, a · b |
//! | [`DIV`] | | a, b | a / b; where b may be 0 nothing is known of it |
//! | [`NEG`], [`ABS`] | | a | −a, \|a\| |
//! | [`SQUARE`] | | a | a² |
//! | [`POWER`] | n | a | aⁿ, for n from 1 to 255 |
//! | [`REAL_POWER`] | i | a | \|a\|ᵉ, where e is the i-th number |
//! | [`ROOT`] | | a | √a; 0 where a is negative |
//! | [`MIN`], [`MAX`] | | a, b | the lesser, the greater |
//! | [`SMOOTH_MIN`] | i | a, b | the lesser, rounded off where they differ by less than the i-th number |
//! | [`SIN`], [`COS`] | | a | of an angle in radians |
//!
//! Programs and numbers may lie in flash. A ball of radius 1, within a box that cuts its top:
//!
//! ```
//! use nostray::glam::Vec3;
//! use nostray::shape::program::*;
//! use nostray::*;
//!
//! static BALL: [u8; 11] = [X, SQUARE, Y, SQUARE, ADD, Z, SQUARE, ADD, NUMBER, 0, SUB];
//!
//! static TABLES: Tables<f32> = Tables {
//!     points: &[Vec3::new(-1.1, -1.1, -1.1), Vec3::new(1.1, 0.5, 1.1)],
//!     numbers: &[1.0],
//!     code: &BALL,
//!     ..Tables::EMPTY
//! };
//!
//! const CUT: Implicit<f32> = Implicit {
//!     center: Vec3::ZERO,
//!     corners: 0,
//!     code: 0,
//!     numbers: 0,
//!     code_len: BALL.len() as u16,
//!     numbers_len: 1,
//!     spans: 1,
//! };
//!
//! assert_eq!(Shape::Implicit(CUT).check(false, &TABLES), Ok(()));
//! assert_eq!(spans_bound(&BALL), Some(2));
//! ```

use crate::interval::{Algebra, Digits, Dual};
use crate::scalar::{Number, Scalar};

/// Pushes the first coordinate.
pub const X: u8 = 0;
/// Pushes the second coordinate.
pub const Y: u8 = 1;
/// Pushes the third coordinate.
pub const Z: u8 = 2;
/// Pushes a number of the program.
pub const NUMBER: u8 = 3;
/// Pushes an entry of the stack once more.
pub const COPY: u8 = 4;
/// The sum of two.
pub const ADD: u8 = 5;
/// The difference of two.
pub const SUB: u8 = 6;
/// The product of two.
pub const MUL: u8 = 7;
/// The quotient of two.
pub const DIV: u8 = 8;
/// The negative.
pub const NEG: u8 = 9;
/// The magnitude.
pub const ABS: u8 = 10;
/// The square.
pub const SQUARE: u8 = 11;
/// A whole power.
pub const POWER: u8 = 12;
/// A power of the magnitude.
pub const REAL_POWER: u8 = 13;
/// The square root.
pub const ROOT: u8 = 14;
/// The lesser of two.
pub const MIN: u8 = 15;
/// The greater of two.
pub const MAX: u8 = 16;
/// The lesser of two, rounded off.
pub const SMOOTH_MIN: u8 = 17;
/// The sine.
pub const SIN: u8 = 18;
/// The cosine.
pub const COS: u8 = 19;

/// The most entries that the stack may hold.
pub const STACK_MAX: usize = 8;

/// What is wrong with a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ProgramFlaw {
    /// The operation, by its place among the bytes; the length of the program for its end.
    pub byte: u32,
    /// What is wrong there.
    pub what: &'static str,
}

/// An operation with the byte that follows it, if it has one.
#[derive(Clone, Copy, Debug)]
struct Step {
    operation: u8,
    operand: u8,
}

impl Step {
    /// Takes the next step from what is left of a program; `None` at its end.
    #[inline]
    fn next(code: &mut core::slice::Iter<'_, u8>) -> Option<Self> {
        let operation = *code.next()?;
        let operand = if Self::has_operand(operation) { *code.next()? } else { 0 };
        Some(Self { operation, operand })
    }

    const fn has_operand(operation: u8) -> bool {
        matches!(operation, NUMBER | COPY | POWER | REAL_POWER | SMOOTH_MIN)
    }

    /// How many entries it takes from the stack; it puts one there.
    const fn takes(self) -> u32 {
        match self.operation {
            X | Y | Z | NUMBER | COPY => 0,
            ADD | SUB | MUL | DIV | MIN | MAX | SMOOTH_MIN => 2,
            _ => 1,
        }
    }
}

/// Checks that a program is one formula of these numbers.
///
/// # Errors
/// The first operation that is not legal.
pub fn check<S: Scalar>(code: &[u8], numbers: &[S]) -> Result<(), ProgramFlaw> {
    let mut rest = code.iter();
    let mut depth = 0_u32;
    loop {
        let byte = (code.len() - rest.len()) as u32;
        let flaw = |what| Err(ProgramFlaw { byte, what });
        let left = !rest.as_slice().is_empty();
        let Some(step) = Step::next(&mut rest) else {
            return match depth {
                _ if left => flaw("lacks the byte that belongs to it"),
                1 => Ok(()),
                0 => flaw("leaves no result"),
                _ => flaw("leaves more than one result"),
            };
        };
        if step.operation > COS {
            return flaw("is not an operation");
        }
        if depth < step.takes() {
            return flaw("takes more from the stack than there is");
        }
        let number = numbers.get(usize::from(step.operand)).copied();
        match (step.operation, number) {
            (NUMBER | REAL_POWER | SMOOTH_MIN, None) => {
                return flaw("names a number beyond those of the program");
            }
            (REAL_POWER | SMOOTH_MIN, Some(number)) if !(number > S::ZERO) => {
                return flaw("needs a number greater than 0");
            }
            (COPY, _) if u32::from(step.operand) >= depth => {
                return flaw("copies an entry that is not there");
            }
            (POWER, _) if step.operand == 0 => return flaw("needs an exponent of at least 1"),
            _ => {}
        }
        depth = depth + 1 - step.takes();
        if depth as usize > STACK_MAX {
            return flaw("needs more room than the stack has");
        }
    }
}

/// The entries of the machine.
struct Stack<A> {
    entries: [Dual<A>; STACK_MAX],
    len: u8,
}

impl<A: Algebra> Stack<A> {
    #[inline]
    fn push(&mut self, entry: Dual<A>) {
        if let Some(slot) = self.entries.get_mut(usize::from(self.len)) {
            *slot = entry;
            self.len += 1;
        }
    }

    /// The entry so far below the top; in a checked program it is there.
    #[inline]
    fn peek(&self, below: u8) -> Dual<A> {
        let at = usize::from(self.len).wrapping_sub(usize::from(below) + 1);
        self.entries.get(at).copied().unwrap_or_else(|| Dual::constant(A::Number::ONE))
    }

    #[inline]
    fn pop(&mut self) -> Dual<A> {
        let top = self.peek(0);
        self.len = self.len.saturating_sub(1);
        top
    }
}

/// The sines and cosines of the angles that were last met: formulas come back to them.
struct Waves<A> {
    known: [Option<(A, [A; 2])>; 3],
    next: u8,
}

impl<A: Algebra> Waves<A> {
    #[inline(never)]
    fn of(&mut self, angle: A, digits: Digits) -> [A; 2] {
        if let Some((_, found)) = self.known.iter().flatten().find(|(known, _)| *known == angle) {
            return *found;
        }
        let found = angle.sin_cos(digits);
        if let Some(slot) = self.known.get_mut(usize::from(self.next)) {
            *slot = Some((angle, found));
        }
        self.next = if self.next == 2 { 0 } else { self.next + 1 };
        found
    }
}

/// The value of a checked program and its slope, for coordinates and theirs.
pub(super) fn run<S: Scalar, A: Algebra<Number = S::Wide>>(
    code: &[u8],
    numbers: &[S],
    [x, y, z]: [Dual<A>; 3],
) -> Dual<A> {
    let mut stack = Stack { entries: [Dual::constant(S::Wide::ZERO); STACK_MAX], len: 0 };
    let mut waves = Waves { known: [None; 3], next: 0 };
    let mut rest = code.iter();
    while let Some(step) = Step::next(&mut rest) {
        let number = || {
            let number = numbers.get(usize::from(step.operand)).copied();
            number.unwrap_or(S::ONE).widen()
        };
        let result = match step.operation {
            X => x,
            Y => y,
            Z => z,
            NUMBER => Dual::constant(number()),
            COPY => stack.peek(step.operand),
            ADD | SUB | MUL | DIV | MIN | MAX | SMOOTH_MIN => {
                let b = stack.pop();
                let a = stack.pop();
                match step.operation {
                    ADD => a + b,
                    SUB => a - b,
                    MUL => a * b,
                    DIV => a.over(b),
                    MIN => a.lesser(b),
                    MAX => -((-a).lesser(-b)),
                    _ => a.smooth_lesser(b, number()),
                }
            }
            operation => {
                let a = stack.pop();
                match operation {
                    NEG => -a,
                    ABS => a.magnitude(),
                    SQUARE => a.square(),
                    POWER => a.whole_power(u32::from(step.operand)),
                    REAL_POWER => a.real_power(number()),
                    ROOT => a.root(),
                    SIN => a.sine(waves.of(a.value, Digits::of::<S>())),
                    _ => a.cosine(waves.of(a.value, Digits::of::<S>())),
                }
            }
        };
        stack.push(result);
    }
    stack.pop()
}

/// A bound on the roots of a formula along any line, where one is known.
///
/// Along a line it is made of so many pieces, each a polynomial of at most this degree: a root of
/// the difference of two formulas is where the lesser of them changes from one to the other.
#[derive(Clone, Copy)]
struct Piecewise {
    pieces: u32,
    degree: u32,
}

impl Piecewise {
    const NUMBER: Self = Self { pieces: 1, degree: 0 };
    const COORDINATE: Self = Self { pieces: 1, degree: 1 };

    /// Of two formulas together, with the degree that comes of it.
    fn with(self, other: Self, degree: u32) -> Self {
        Self { pieces: self.pieces.saturating_add(other.pieces - 1), degree }
    }

    /// Each piece is cut at the roots of a polynomial of this degree.
    fn cut(self, degree: u32) -> Self {
        Self { pieces: self.pieces.saturating_mul(degree.saturating_add(1)), ..self }
    }

    /// How many roots it may have.
    fn roots(self) -> u32 {
        self.pieces.saturating_mul(self.degree)
    }
}

/// The most spans along any ray of what a checked program describes within a box; `None` where no bound
/// is known, because the program is not made of polynomials alone.
pub fn spans_bound(code: &[u8]) -> Option<u32> {
    let mut stack: heapless::Vec<Piecewise, STACK_MAX> = heapless::Vec::new();
    let mut rest = code.iter();
    while let Some(step) = Step::next(&mut rest) {
        let result = match step.operation {
            X | Y | Z => Piecewise::COORDINATE,
            NUMBER => Piecewise::NUMBER,
            COPY => *stack.iter().rev().nth(usize::from(step.operand))?,
            ADD | SUB | MUL | DIV | MIN | MAX | SMOOTH_MIN => {
                let (b, a) = (stack.pop()?, stack.pop()?);
                let greater = a.degree.max(b.degree);
                match step.operation {
                    ADD | SUB => a.with(b, greater),
                    MUL => a.with(b, a.degree.saturating_add(b.degree)),
                    DIV if b.roots() == 0 => a.with(b, greater),
                    DIV => return None,
                    MIN | MAX => a.with(b, greater).cut(greater),
                    // Where they differ by the width, to either side, the parabola begins.
                    _ => {
                        let twice = greater.saturating_mul(2);
                        Piecewise { degree: twice, ..a.with(b, greater).cut(twice) }
                    }
                }
            }
            operation => {
                let a = stack.pop()?;
                let times = |n: u32| Piecewise { degree: a.degree.saturating_mul(n), ..a };
                match operation {
                    NEG => a,
                    ABS => a.cut(a.degree),
                    SQUARE => times(2),
                    POWER => times(u32::from(step.operand)),
                    _ => return None,
                }
            }
        };
        stack.push(result).ok()?;
    }
    // Between two roots it is inside or outside, and at the ends of the box it may be inside.
    Some(stack.pop()?.roots() / 2 + 1)
}

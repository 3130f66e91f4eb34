//! Formulas as people write them, made into programs for the core.
//!
//! `x`, `y`, `z`, `pi` and numbers; `+ − * /`, `^` with a whole exponent, brackets; and the functions
//! `sqrt`, `abs`, `sin`, `cos`, `length` (of one or more), `min` and `max` (of two or more),
//! `smin(a, b, k)` and `smax(a, b, k)` (rounded off where the two differ by less than k),
//! `pow(a, e)` (the magnitude of a to the power e).

mod compile;
mod parse;

use std::fmt;

pub(crate) use compile::{Program, compile};

/// A formula, taken apart.
#[derive(Clone, Debug, PartialEq)]
enum Formula {
    Number(f64),
    /// The operation that pushes a coordinate.
    Coordinate(u8),
    /// An operation on one operand.
    Unary(u8, Box<Self>),
    /// An operation on one operand, with the byte that follows it.
    Power(u8, Box<Self>),
    /// An operation on one operand with a number.
    RealPower(Box<Self>, f64),
    /// An operation on two operands.
    Binary(u8, Box<[Self; 2]>),
    /// The lesser of two, rounded off.
    SmoothMin(Box<[Self; 2]>, f64),
}

/// Why a text is not a formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct NoFormula {
    /// The line within the text, from 1.
    line: usize,
    /// The column within the line, from 1.
    column: usize,
    message: String,
}

impl fmt::Display for NoFormula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Most formulas are of one line.
        if self.line > 1 {
            write!(f, "line {}, ", self.line)?;
        }
        write!(f, "column {} of the formula: {}", self.column, self.message)
    }
}

#[cfg(test)]
mod tests;

//! From a formula to a program: the operand that needs more of the stack goes first.
//!
//! Source: R. Sethi and J. D. Ullman, "The Generation of Optimal Code for Arithmetic Expressions" (1970).

use nostray::shape::program::{
    ADD, DIV, NEG, NUMBER, POWER, REAL_POWER, SMOOTH_MIN, STACK_MAX, SUB,
};

use super::parse::parse;
use super::{Formula, NoFormula};

/// A program and the numbers that it names.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Program {
    pub(crate) code: Vec<u8>,
    pub(crate) numbers: Vec<f64>,
}

/// Makes a program of a formula.
///
/// # Errors
/// Where the text is not a formula, or if it is too large for a program.
pub(crate) fn compile(text: &str) -> Result<Program, NoFormula> {
    let formula = parse(text)?;
    let large = |message: &str| NoFormula { line: 1, column: 1, message: message.to_owned() };
    if needs(&formula) > STACK_MAX {
        return Err(large("too much of it is nested on both sides of an operator"));
    }
    let mut program = Program::default();
    program.emit(&formula);
    if program.numbers.len() > usize::from(u8::MAX) + 1 {
        return Err(large("it has more than 256 different numbers"));
    }
    if program.code.len() > usize::from(u16::MAX) {
        return Err(large("it has more than 65535 bytes as a program"));
    }
    Ok(program)
}

/// The entries of the stack that a formula needs.
fn needs(formula: &Formula) -> usize {
    match formula {
        Formula::Number(_) | Formula::Coordinate(_) => 1,
        Formula::Unary(_, a) | Formula::Power(_, a) | Formula::RealPower(a, _) => needs(a),
        // The order of a quotient stays.
        Formula::Binary(DIV, pair) => needs(&pair[0]).max(needs(&pair[1]) + 1),
        Formula::Binary(_, pair) | Formula::SmoothMin(pair, _) => {
            let [a, b] = [needs(&pair[0]), needs(&pair[1])];
            if a == b { a + 1 } else { a.max(b) }
        }
    }
}

impl Program {
    fn number(&mut self, number: f64) -> u8 {
        let known = self.numbers.iter().position(|known| known.to_bits() == number.to_bits());
        let index = known.unwrap_or_else(|| {
            self.numbers.push(number);
            self.numbers.len() - 1
        });
        // Where there are more, the program is refused as a whole.
        index as u8
    }

    fn emit(&mut self, formula: &Formula) {
        match formula {
            &Formula::Number(number) => {
                let index = self.number(number);
                self.code.extend([NUMBER, index]);
            }
            &Formula::Coordinate(operation) => self.code.push(operation),
            Formula::Unary(operation, a) => {
                self.emit(a);
                self.code.push(*operation);
            }
            Formula::Power(n, a) => {
                self.emit(a);
                self.code.extend([POWER, *n]);
            }
            Formula::RealPower(a, e) => {
                self.emit(a);
                let index = self.number(*e);
                self.code.extend([REAL_POWER, index]);
            }
            Formula::Binary(DIV, pair) => {
                self.emit(&pair[0]);
                self.emit(&pair[1]);
                self.code.push(DIV);
            }
            Formula::Binary(SUB, pair) if needs(&pair[1]) > needs(&pair[0]) => {
                // a − b = −b + a, to the bit.
                self.emit(&pair[1]);
                self.code.push(NEG);
                self.emit(&pair[0]);
                self.code.push(ADD);
            }
            Formula::Binary(operation, pair) => {
                self.emit_pair(pair);
                self.code.push(*operation);
            }
            Formula::SmoothMin(pair, width) => {
                self.emit_pair(pair);
                let index = self.number(*width);
                self.code.extend([SMOOTH_MIN, index]);
            }
        }
    }

    /// Two operands of which either may be the first.
    fn emit_pair(&mut self, [a, b]: &[Formula; 2]) {
        let [first, second] = if needs(b) > needs(a) { [b, a] } else { [a, b] };
        self.emit(first);
        self.emit(second);
    }
}

//! From a text to a formula, by descent through the ranks of the operators.

use nostray::shape::program::{
    ABS, ADD, COS, DIV, MAX, MIN, MUL, NEG, ROOT, SIN, SQUARE, SUB, X, Y, Z,
};
use nostray::{Number, Real};

use super::{Formula, NoFormula};

/// How deep brackets and signs may be nested.
const NESTING_MAX: u32 = 64;

/// Reads a formula.
///
/// # Errors
/// The first place where it is not one.
pub(super) fn parse(text: &str) -> Result<Formula, NoFormula> {
    let mut reader = Reader { text, at: 0, nesting: 0 };
    let formula = reader.sum()?;
    reader.skip_space();
    if reader.at < text.len() {
        return Err(reader.flaw(reader.at, "an operator is missing"));
    }
    Ok(formula)
}

struct Reader<'a> {
    text: &'a str,
    /// How many bytes are read.
    at: usize,
    nesting: u32,
}

impl<'a> Reader<'a> {
    fn rest(&self) -> &'a str {
        self.text.get(self.at..).unwrap_or("")
    }

    fn flaw(&self, at: usize, message: impl Into<String>) -> NoFormula {
        let before = self.text.get(..at).unwrap_or(self.text);
        let line = 1 + before.matches('\n').count();
        let column = 1 + before.rsplit('\n').next().unwrap_or(before).chars().count();
        NoFormula { line, column, message: message.into() }
    }

    fn skip_space(&mut self) {
        self.at += self.rest().len() - self.rest().trim_start().len();
    }

    /// Takes one of these characters, if it comes next.
    fn take(&mut self, among: &[char]) -> Option<char> {
        self.skip_space();
        let next = self.rest().chars().next().filter(|next| among.contains(next))?;
        self.at += next.len_utf8();
        Some(next)
    }

    fn expect(&mut self, what: char) -> Result<(), NoFormula> {
        match self.take(&[what]) {
            Some(_) => Ok(()),
            None => Err(self.flaw(self.at, format!("'{what}' is missing"))),
        }
    }

    fn sum(&mut self) -> Result<Formula, NoFormula> {
        let mut left = self.product()?;
        while let Some(sign) = self.take(&['+', '-']) {
            let operation = if sign == '+' { ADD } else { SUB };
            left = Formula::binary(operation, left, self.product()?);
        }
        Ok(left)
    }

    fn product(&mut self) -> Result<Formula, NoFormula> {
        let mut left = self.signed()?;
        while let Some(sign) = self.take(&['*', '/']) {
            let operation = if sign == '*' { MUL } else { DIV };
            left = Formula::binary(operation, left, self.signed()?);
        }
        Ok(left)
    }

    /// A sign binds less than a power: −x^2 is −(x^2).
    fn signed(&mut self) -> Result<Formula, NoFormula> {
        let at = self.at;
        self.nesting += 1;
        if self.nesting > NESTING_MAX {
            return Err(self.flaw(at, "is nested too deeply"));
        }
        let formula = match self.take(&['-', '+']) {
            Some('-') => Formula::unary(NEG, self.signed()?),
            Some(_) => self.signed()?,
            None => self.power()?,
        };
        self.nesting -= 1;
        Ok(formula)
    }

    fn power(&mut self) -> Result<Formula, NoFormula> {
        let base = self.atom()?;
        if self.take(&['^']).is_none() {
            return Ok(base);
        }
        self.skip_space();
        let at = self.at;
        let exponent = self.number()?.filter(|e| *e >= 1.0 && f64::from(*e as u8) == *e);
        match exponent {
            Some(exponent) => Ok(Formula::power(base, exponent as u8)),
            None => {
                let message =
                    "an exponent is a whole number from 1 to 255; for others there is pow(a, e)";
                Err(self.flaw(at, message))
            }
        }
    }

    fn atom(&mut self) -> Result<Formula, NoFormula> {
        self.skip_space();
        let at = self.at;
        if let Some(number) = self.number()? {
            return Ok(Formula::Number(number));
        }
        if self.take(&['(']).is_some() {
            let inside = self.sum()?;
            self.expect(')')?;
            return Ok(inside);
        }
        let rest = self.rest();
        let word = |c: char| c.is_alphanumeric() || c == '_';
        let name = rest.get(..rest.find(|c| !word(c)).unwrap_or(rest.len())).unwrap_or("");
        self.at += name.len();
        match name {
            "" => Err(self.flaw(
                at,
                match rest.chars().next() {
                    None => "it ends where a number, a name or a bracket is missing".to_owned(),
                    Some(found) => {
                        format!("{found:?} stands where a number, a name or a bracket is missing")
                    }
                },
            )),
            "x" => Ok(Formula::Coordinate(X)),
            "y" => Ok(Formula::Coordinate(Y)),
            "z" => Ok(Formula::Coordinate(Z)),
            "pi" => Ok(Formula::Number(std::f64::consts::PI)),
            _ if self.take(&['(']).is_some() => {
                let arguments = self.arguments()?;
                self.call(at, name, arguments)
            }
            _ => Err(self.flaw(at, format!("there is no {name:?}; there are x, y, z and pi"))),
        }
    }

    /// What follows the bracket of a function, and that which closes it.
    fn arguments(&mut self) -> Result<Vec<Formula>, NoFormula> {
        let mut list = vec![self.sum()?];
        while self.take(&[',']).is_some() {
            list.push(self.sum()?);
        }
        self.expect(')')?;
        Ok(list)
    }

    fn call(&self, at: usize, name: &str, list: Vec<Formula>) -> Result<Formula, NoFormula> {
        let takes = |what: &str| Err(self.flaw(at, format!("{name} takes {what}")));
        let unary = |operation: u8, list: Vec<Formula>| match <[Formula; 1]>::try_from(list) {
            Ok([a]) => Ok(Formula::unary(operation, a)),
            Err(_) => takes("one operand"),
        };
        let several = |operation: u8, list: Vec<Formula>| match list.len() {
            0 | 1 => takes("two operands or more"),
            _ => {
                let together = |a, b| Formula::binary(operation, a, b);
                list.into_iter().reduce(together).map_or_else(|| takes("operands"), Ok)
            }
        };
        let smooth = |sign: f64, list: Vec<Formula>| match <[Formula; 3]>::try_from(list) {
            Ok([a, b, Formula::Number(width)]) if width > 0.0 => {
                let turned = |f: Formula| if sign < 0.0 { Formula::unary(NEG, f) } else { f };
                let pair = Box::new([turned(a), turned(b)]);
                Ok(turned(Formula::SmoothMin(pair, width)))
            }
            _ => takes("two operands and a number greater than 0"),
        };
        match name {
            "sqrt" => unary(ROOT, list),
            "abs" => unary(ABS, list),
            "sin" => unary(SIN, list),
            "cos" => unary(COS, list),
            "min" => several(MIN, list),
            "max" => several(MAX, list),
            "smin" => smooth(1.0, list),
            "smax" => smooth(-1.0, list),
            "length" => {
                let squares = list.into_iter().map(|a| Formula::unary(SQUARE, a));
                let sum = squares.reduce(|a, b| Formula::binary(ADD, a, b));
                sum.map_or_else(|| takes("operands"), |sum| Ok(Formula::unary(ROOT, sum)))
            }
            "pow" => match <[Formula; 2]>::try_from(list) {
                Ok([a, Formula::Number(e)]) if e > 0.0 => Ok(Formula::real_power(a, e)),
                _ => takes("an operand and a number greater than 0"),
            },
            _ => Err(self.flaw(at, format!(
                "there is no function {name:?}; there are sqrt, abs, sin, cos, length, min, max, smin, smax and pow"
            ))),
        }
    }

    /// A number, if one comes next.
    fn number(&mut self) -> Result<Option<f64>, NoFormula> {
        self.skip_space();
        let rest = self.rest();
        let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
        let mut length = digits(rest);
        if rest.get(length..).is_some_and(|rest| rest.starts_with('.')) {
            length += 1 + digits(rest.get(length + 1..).unwrap_or(""));
        }
        let number = |length: usize| rest.get(..length).and_then(|text| text.parse::<f64>().ok());
        if number(length).is_none() {
            return Ok(None);
        }
        if rest.get(length..).is_some_and(|rest| rest.starts_with(['e', 'E'])) {
            let sign = rest.get(length + 1..).is_some_and(|rest| rest.starts_with(['+', '-']));
            let power = length + 1 + usize::from(sign);
            let count = digits(rest.get(power..).unwrap_or(""));
            length = if count > 0 { power + count } else { length };
        }
        match number(length).filter(|number| number.is_finite()) {
            Some(found) => {
                self.at += length;
                Ok(Some(found))
            }
            None => Err(self.flaw(self.at, "is beyond the range of numbers")),
        }
    }
}

impl Formula {
    fn unary(operation: u8, a: Self) -> Self {
        match (operation, a) {
            (NEG, Self::Number(a)) => Self::Number(-a),
            (NEG, Self::Unary(NEG, a)) => *a,
            (ABS, Self::Number(a)) => Self::Number(a.abs()),
            (SQUARE, Self::Number(a)) => Self::Number(a * a),
            (ROOT, Self::Number(a)) => Self::Number(Real::sqrt(a)),
            (SIN, Self::Number(a)) => Self::Number(Real::sin_cos(a).0),
            (COS, Self::Number(a)) => Self::Number(Real::sin_cos(a).1),
            (_, a) => Self::Unary(operation, Box::new(a)),
        }
    }

    fn binary(operation: u8, a: Self, b: Self) -> Self {
        match (operation, a, b) {
            (ADD, Self::Number(a), Self::Number(b)) => Self::Number(a + b),
            (SUB, Self::Number(a), Self::Number(b)) => Self::Number(a - b),
            (MUL, Self::Number(a), Self::Number(b)) => Self::Number(a * b),
            (DIV, Self::Number(a), Self::Number(b)) if b != 0.0 => Self::Number(a / b),
            (MIN, Self::Number(a), Self::Number(b)) => Self::Number(Number::min(a, b)),
            (MAX, Self::Number(a), Self::Number(b)) => Self::Number(Number::max(a, b)),
            // Whose square is never negative, which a product does not know.
            (MUL, a, b) if a == b => Self::unary(SQUARE, a),
            (_, a, b) => Self::Binary(operation, Box::new([a, b])),
        }
    }

    fn power(a: Self, n: u8) -> Self {
        match (a, n) {
            (a, 1) => a,
            (a, 2) => Self::unary(SQUARE, a),
            (Self::Number(a), n) => Self::Number(Number::powi(a, n.into())),
            (a, n) => Self::Power(n, Box::new(a)),
        }
    }

    fn real_power(a: Self, e: f64) -> Self {
        match a {
            Self::Number(a) => Self::Number(Real::pow(a.abs(), e)),
            a => Self::RealPower(Box::new(a), e),
        }
    }
}

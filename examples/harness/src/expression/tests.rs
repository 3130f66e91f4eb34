//! Formulas become the programs that they say, or errors that tell where.
#![allow(clippy::disallowed_methods, reason = "a test of values need not be the same to the bit")]

use nostray::shape::program::{
    ABS, ADD, COPY, COS, DIV, MAX, MIN, MUL, NEG, NUMBER, POWER, REAL_POWER, ROOT, SIN, SMOOTH_MIN,
    SQUARE, SUB, X, Y, Z, check,
};

use super::compile;

fn code(text: &str) -> Vec<u8> {
    let program = compile(text).unwrap();
    assert_eq!(check(&program.code, &program.numbers), Ok(()), "{text}");
    program.code
}

fn flaw(text: &str) -> String {
    compile(text).unwrap_err().to_string()
}

/// The value of a formula by a machine of its own.
fn value(text: &str, [x, y, z]: [f64; 3]) -> f64 {
    let program = compile(text).unwrap();
    let mut stack: Vec<f64> = Vec::new();
    let mut bytes = program.code.iter().copied();
    while let Some(operation) = bytes.next() {
        let mut number = || program.numbers[usize::from(bytes.next().unwrap())];
        let result = match operation {
            X => x,
            Y => y,
            Z => z,
            NUMBER => number(),
            NEG | ABS | SQUARE | ROOT | SIN | COS | REAL_POWER | POWER => {
                let a = stack.pop().unwrap();
                match operation {
                    NEG => -a,
                    ABS => a.abs(),
                    SQUARE => a * a,
                    ROOT => a.max(0.0).sqrt(),
                    SIN => a.sin(),
                    COS => a.cos(),
                    REAL_POWER => a.abs().powf(number()),
                    _ => a.powi(bytes.next().unwrap().into()),
                }
            }
            COPY => panic!("no formula is copied"),
            _ => {
                let (b, a) = (stack.pop().unwrap(), stack.pop().unwrap());
                match operation {
                    ADD => a + b,
                    SUB => a - b,
                    MUL => a * b,
                    DIV => a / b,
                    MIN => a.min(b),
                    MAX => a.max(b),
                    _ => {
                        let k = number();
                        let h = (1.0 - (a - b).abs() / k).max(0.0);
                        a.min(b) - h * h * k / 4.0
                    }
                }
            }
        };
        stack.push(result);
    }
    stack.pop().unwrap()
}

#[test]
fn operators_have_their_ranks() {
    let p = [3.0, -2.0, 0.5];
    assert_eq!(value("x + y * z", p), 2.0);
    assert_eq!(value("(x + y) * z", p), 0.5);
    assert_eq!(value("x - y - z", p), 4.5);
    assert_eq!(value("x / y / z", p), -3.0);
    assert_eq!(value("-x^2", p), -9.0);
    assert_eq!(value("2*-y^3", p), 16.0);
    assert_eq!(value("-(-x) - +y", p), 5.0);
    assert_eq!(value(" 1.5e1*z + .5 - 2.\n", p), 6.0);
    assert_eq!(value("min(x, y, z, 7) + max(x, y)", p), 1.0);
    assert_eq!(value("length(x, 4)", p), 5.0);
    assert_eq!(value("smin(x, x + 1, 4)", p), 3.0 - 0.5625);
    assert_eq!(value("smax(x, x - 1, 4)", p), 3.0 + 0.5625);
    assert_eq!(value("pow(y, 3)", p), 8.0);
    assert_eq!(value("abs(y) + sqrt(4) + sin(0*x) + cos(x-x)", p), 5.0);
    assert_eq!(value("sin(pi/2)", p), 1.0);
}

#[test]
fn programs_are_short() {
    assert_eq!(code("x*x + y^2 - 1"), [X, SQUARE, Y, SQUARE, ADD, NUMBER, 0, SUB]);
    assert_eq!(code("x^1 - 2*3"), [X, NUMBER, 0, SUB]);
    assert_eq!(code("z^7 / 2"), [Z, POWER, 7, NUMBER, 0, DIV]);
    assert_eq!(code("smin(x, y, 1) - 1"), [X, Y, SMOOTH_MIN, 0, NUMBER, 0, SUB]);
    // What needs more of the stack goes first.
    assert_eq!(code("x - (y + z)"), [Y, Z, ADD, NEG, X, ADD]);
    assert_eq!(code("x * (y + z)"), [Y, Z, ADD, X, MUL]);
    assert_eq!(code("x / (y + z)"), [X, Y, Z, ADD, DIV]);
    let long = "x-(y-(z-(x-(y-(z-(x-(y-(z-(x-y)))))))))";
    assert_eq!(value(long, [1.0, 2.0, 4.0]), 4.0);
    assert_eq!(compile("x + 1 + y*1").unwrap().numbers, [1.0]);
}

#[test]
fn what_is_no_formula_is_told_by_its_place() {
    let starts = |text: &str, start: &str| {
        let told = flaw(text);
        assert!(told.starts_with(start), "{text:?}: {told}");
    };
    starts("", "column 1 of the formula: it ends where");
    starts("x +", "column 4 of the formula: it ends where");
    starts("x + * y", "column 5 of the formula: '*' stands where");
    starts("x y", "column 3 of the formula: an operator is missing");
    starts("(x", "column 3 of the formula: ')' is missing");
    starts("x + w", "column 5 of the formula: there is no \"w\"");
    starts("x +\n tan(y)", "line 2, column 2 of the formula: there is no function \"tan\"");
    starts("sin(x, y)", "column 1 of the formula: sin takes one operand");
    starts("min(x)", "column 1 of the formula: min takes two operands or more");
    starts("smin(x, y)", "column 1 of the formula: smin takes two operands and a number");
    starts("smin(x, y, z)", "column 1 of the formula: smin takes");
    starts("smax(x, y, -1)", "column 1 of the formula: smax takes");
    starts("pow(x, y)", "column 1 of the formula: pow takes");
    starts("x^y", "column 3 of the formula: an exponent is a whole number");
    starts("x^0.5", "column 3 of the formula: an exponent");
    starts("x^256", "column 3 of the formula: an exponent");
    starts("1e999*x", "column 1 of the formula: is beyond the range of numbers");
    starts("x ? y", "column 3 of the formula: an operator is missing");
    starts("é", "column 1 of the formula: there is no \"é\"");
    starts("∂x", "column 1 of the formula: '∂' stands where");
    starts(&"(".repeat(100), "column 65 of the formula: is nested too deeply");
    starts(&"-".repeat(1000), "column 65 of the formula: is nested too deeply");
    // A full tree of nine levels.
    let mut tree = "x".to_owned();
    for _ in 0..8 {
        tree = format!("({tree}+2*{tree})");
    }
    starts(&tree, "column 1 of the formula: too much of it is nested");
    let many: Vec<String> = (0..300).map(|n| format!("{n}*x")).collect();
    starts(&many.join("+"), "column 1 of the formula: it has more than 256");
}

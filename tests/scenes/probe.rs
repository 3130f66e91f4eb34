//! The command `probe`: spans of solids along rays, as JSON lines.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    reason = "a test may fail loudly"
)]

use std::ffi::OsString;

use nostray_harness::probe_command;

/// The answers to some lines.
fn ask(scalar: &str, lines: &str) -> Vec<String> {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let args = ["probe", "--scalar", scalar].map(OsString::from);
    let code = probe_command(args, &mut lines.as_bytes(), &mut out, &mut err);
    assert_eq!((code, err.as_slice()), (0, &b""[..]));
    String::from_utf8(out).unwrap().lines().map(str::to_owned).collect()
}

fn question(solid: &str, origin: &str, dir: &str) -> String {
    format!("{{\"solid\": {solid}, \"ray\": {{\"origin\": {origin}, \"dir\": {dir}}}}}")
}

/// The answer to one question.
fn spans(scalar: &str, solid: &str, origin: &str, dir: &str) -> String {
    let answers = ask(scalar, &question(solid, origin, dir));
    assert_eq!(answers.len(), 1);
    answers[0].clone()
}

const BALL: &str = r#"{"Sphere": {"center": [0, 0, 0], "radius": 1}}"#;
const CUBE: &str = r#"{"Box": {"min": [-1, -1, -1], "max": [1, 1, 1]}}"#;
const GROUND: &str = r#"{"Plane": {"normal": [0, 1, 0], "offset": 0}}"#;
const SHEET: &str = r#"{"Triangle": {"a": [0, 0, 0], "b": [1, 0, 0], "c": [0, 1, 0]}}"#;

#[test]
fn spans_are_as_promised() {
    let shell = format!(
        r#"{{"Difference": [{CUBE}, {{"With": {{"solid": {BALL}, "material": "any",
        "place": [{{"Scale": 0.5}}, {{"Translate": [0, 0, 0.25]}}]}}}}]}}"#
    )
    .replace('\n', "");
    let outside = format!(r#"{{"Complement": {BALL}}}"#);
    let both = format!(r#"{{"Union": [{BALL}, {SHEET}]}}"#);
    for (solid, origin, dir, expected) in [
        (BALL, "[0, 0, -3]", "[0, 0, 1]", "[[2.0, 4.0]]"),
        (BALL, "[0, 0, -3]", "[0, 0, -1]", "[]"),
        (BALL, "[0, 0, 0]", "[0, 0, 2]", "[[0.0, 0.5]]"),
        (BALL, "[0, 0, -3]", "[0, 0, 4]", "[[0.5, 1.0]]"),
        (BALL, "[0, 2, -3]", "[0, 0, 1]", "[]"),
        (&outside, "[0, 0, -3]", "[0, 0, 1]", "[[0.0, 2.0], [4.0, null]]"),
        (&outside, "[0, 0, 0]", "[0, 0, 1]", "[[1.0, null]]"),
        (GROUND, "[0, 1, 0]", "[0, 1, 0]", "[]"),
        (GROUND, "[0, 1, 0]", "[0, -2, 0]", "[[0.5, null]]"),
        (GROUND, "[0, -1, 0]", "[1, 0, 0]", "[[0.0, null]]"),
        (SHEET, "[0.25, 0.25, -1]", "[0, 0, 1]", "[[1.0, 1.0]]"),
        (&shell, "[0, 0, -3]", "[0, 0, 1]", "[[2.0, 2.75], [3.75, 4.0]]"),
        (&both, "[0.25, 0.25, 2]", "[0, 0, -1]", "[[1.0645857, 2.9354143]]"),
    ] {
        let answer = spans("f32", solid, origin, dir);
        assert_eq!(answer, format!("{{\"spans\": {expected}}}"), "{solid} from {origin} to {dir}");
    }
}

#[test]
fn numbers_are_the_shortest_of_their_format() {
    let ball = r#"{"Sphere": {"center": [0, 0, 0], "radius": 0.1}}"#;
    let (origin, dir) = ("[0, 0, -0.3]", "[0, 0, 1]");
    let of = |scalar: &str| -> Vec<f64> {
        let answer = spans(scalar, ball, origin, dir);
        let value: serde_json::Value = serde_json::from_str(&answer).unwrap();
        value["spans"][0].as_array().unwrap().iter().map(|t| t.as_f64().unwrap()).collect()
    };
    let wide = of("f64");
    assert!((wide[0] - 0.2).abs() < 1e-15 && (wide[1] - 0.4).abs() < 1e-15, "{wide:?}");
    // No more digits than an f32 needs to be read back.
    for t in of("f32") {
        assert!(format!("{t}").len() <= 11, "{t}");
        assert_eq!(format!("{}", t as f32), format!("{t}"));
    }
}

/// The square of such directions is far out of range, and t is exact all the same.
#[test]
fn directions_of_any_length_scale_t_by_powers_of_two() {
    for (scalar, powers) in [("f32", -120_i32..=120), ("f64", -1000..=1000)] {
        for power in powers.step_by(40) {
            let factor = f64::from_bits(((power + 1023) as u64) << 52);
            let dir = format!("[{:e}, {:e}, {:e}]", 0.25 * factor, 0.5 * factor, 3.0 * factor);
            let answer = spans(scalar, BALL, "[-0.125, 0.25, -3]", &dir);
            let value: serde_json::Value = serde_json::from_str(&answer).unwrap();
            let unit = spans(scalar, BALL, "[-0.125, 0.25, -3]", "[0.25, 0.5, 3]");
            let unit: serde_json::Value = serde_json::from_str(&unit).unwrap();
            for index in 0..2 {
                let (t, of_unit) = (&value["spans"][0][index], &unit["spans"][0][index]);
                let (t, of_unit) = (t.as_f64().expect(&answer), of_unit.as_f64().unwrap());
                let scaled = of_unit / factor;
                assert!((t - scaled).abs() <= scaled * 1e-7, "{scalar} {power}: {t} for {scaled}");
                if scalar == "f64" {
                    assert_eq!(t, scaled, "2^{power}");
                }
            }
        }
    }
    let answer = spans("f32", BALL, "[0, 0, -3]", "[0, 0, 1e-39]");
    assert!(answer.contains("error") && answer.contains("beyond the range"), "{answer}");
}

#[test]
fn bad_lines_are_answered_and_the_next_ones_too() {
    let torus = r#"{"Torus": {"center": [0, 0, 0]}}"#;
    let negative = r#"{"Sphere": {"center": [0, 0, 0], "radius": -1}}"#;
    let nested = |inner: &str| format!(r#"{{"Union": [{BALL}, {inner}]}}"#);
    let open = format!(r#"{{"Intersection": [{BALL}, {SHEET}]}}"#);
    let (origin, dir) = ("[0, 0, -3]", "[0, 0, 1]");
    let deep = format!("{}{BALL}{}", "{\"Complement\": ".repeat(5000), "}".repeat(5000));
    let cases = [
        (String::new(), "EOF"),
        ("nonsense".to_owned(), "line 1"),
        ("[]".to_owned(), ""),
        ("{\"solid\": 1}".to_owned(), "solid"),
        (question(BALL, origin, "[0, 0, 0]"), "ray.dir: must not be zero"),
        (question(BALL, origin, "[0, 0, 1e39]"), "ray.dir: is beyond the range"),
        (question(BALL, "[0, 0, 2e15]", dir), "ray.origin: is beyond the range"),
        (question(BALL, origin, "[0, 1]"), "ray.dir"),
        (question(BALL, origin, dir) + " {}", "trailing"),
        (question(torus, origin, dir), "Torus"),
        (question(negative, origin, dir), "solid.Sphere.radius: must be greater than 0"),
        (question(&nested(negative), origin, dir), "solid.Union[1].Sphere.radius: must be"),
        (question(&open, origin, dir), "solid.Intersection[1].Triangle: an open surface"),
        (question(&nested(&deep), origin, dir), "recursion"),
    ];
    let lines: String = cases
        .iter()
        .map(|(line, _)| format!("{line}\n{}\n", question(BALL, origin, dir)))
        .collect();
    let answers = ask("f32", &lines);
    assert_eq!(answers.len(), 2 * cases.len());
    for ((line, part), pair) in cases.iter().zip(answers.chunks(2)) {
        let told: serde_json::Value = serde_json::from_str(&pair[0]).unwrap();
        let message = told["error"].as_str().unwrap_or_else(|| panic!("{line}: {told}"));
        assert!(message.contains(part), "{part:?} in {message:?}");
        assert_eq!(pair[1], r#"{"spans": [[2.0, 4.0]]}"#);
    }
    // A line that is not text is one bad line.
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let mut input = &b"\xff\n"[..];
    assert_eq!(probe_command(["probe".into()], &mut input, &mut out, &mut err), 0);
    assert!(out.starts_with(b"{\"error\":"));
}

#[test]
fn bad_usage_is_refused_by_code_2() {
    for args in [&["--scalar", "q8"][..], &["--scalar", "double"], &["solid.json"]] {
        let (mut out, mut err) = (Vec::new(), Vec::new());
        let args = std::iter::once("probe").chain(args.iter().copied()).map(OsString::from);
        assert_eq!(probe_command(args, &mut &b""[..], &mut out, &mut err), 2);
        assert!(out.is_empty());
        assert_eq!(err.iter().filter(|byte| **byte == b'\n').count(), 1);
    }
}

//! The rules of the house that no lint knows: short functions, one subject a file, a reason
//! for every exception, and nothing in stored state whose size depends on the target.
#![allow(clippy::expect_used, reason = "that is how a test fails")]

use std::fs;
use std::path::{Path, PathBuf};

/// The most lines of a function, from its `fn` to its closing brace.
const FUNCTION_LINES_MAX: usize = 70;

/// The most lines of a file.
const FILE_LINES_MAX: usize = 450;

/// Types that may hold a `usize`, and why.
const USIZE_HOLDERS: &[(&str, &str)] = &[
    ("Frame", "lives during one call of the evaluator; positions in its buffer"),
    ("Nest", "lives during one check of a solid; how many operators are open"),
];

/// Programs that meet a kernel's C or a board's registers, which Rust cannot check.
const MEETS_THE_MACHINE: &[&str] =
    &["examples/kernel/src/lib.rs", "examples/firmware/src/bin/firmware.rs"];

/// A source file and where it lies.
struct Source {
    path: String,
    text: String,
}

impl Source {
    fn lines(&self) -> impl Iterator<Item = (usize, &str)> {
        (1..).zip(self.text.lines())
    }
}

/// All Rust files below these folders of the package.
fn sources(folders: &[&str]) -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut waiting: Vec<PathBuf> = folders.iter().map(|folder| root.join(folder)).collect();
    let mut found = Vec::new();
    while let Some(folder) = waiting.pop() {
        for entry in fs::read_dir(&folder).expect("a folder of the package") {
            let path = entry.expect("an entry of a folder of the package").path();
            if path.is_dir() && path.file_name().is_none_or(|name| name != "target") {
                waiting.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let text = fs::read_to_string(&path).expect("a source file in UTF-8");
                let path = path.strip_prefix(root).expect("a path below the package");
                found.push(Source { path: path.display().to_string(), text });
            }
        }
    }
    found.sort_by(|a, b| a.path.cmp(&b.path));
    found
}

fn everything() -> Vec<Source> {
    sources(&["src", "tests", "examples"])
}

fn indent(line: &str) -> usize {
    line.len() - line.trim_start().len()
}

/// The line begins a function.
fn begins_function(line: &str) -> bool {
    const BEFORE: [&str; 6] = ["pub", "pub(crate)", "pub(super)", "const", "async", "default"];
    line.split_whitespace().find(|word| !BEFORE.contains(word)) == Some("fn")
}

/// The functions of a source in rustfmt's layout: the first line and how many lines.
fn functions(source: &Source) -> Vec<(usize, usize)> {
    let lines: Vec<&str> = source.text.lines().collect();
    let mut found = Vec::new();
    for (index, line) in lines.iter().enumerate().filter(|(_, line)| begins_function(line)) {
        let ends = |other: &&str| {
            let ending = other.ends_with(['}', ';']);
            indent(other) == indent(line) && ending && !other.trim().is_empty()
        };
        let rest = lines.get(index..).unwrap_or(&[]);
        let last = rest.iter().position(ends).expect("every function ends");
        found.push((index + 1, last + 1));
    }
    found
}

/// Fails with all complaints at once.
fn complain(rule: &str, complaints: &[String]) {
    assert!(complaints.is_empty(), "{rule}:\n{}", complaints.join("\n"));
}

#[test]
fn functions_fit_on_a_screen() {
    let mut complaints = Vec::new();
    let mut seen = 0;
    for source in everything() {
        for (line, length) in functions(&source) {
            seen += 1;
            if length > FUNCTION_LINES_MAX {
                complaints.push(format!("{}:{line}: {length} lines", source.path));
            }
        }
    }
    assert!(seen > 200, "only {seen} functions were recognised");
    complain("a function has at most 70 lines", &complaints);
}

#[test]
fn a_file_has_one_subject() {
    let mut complaints = Vec::new();
    for source in everything() {
        let length = source.text.lines().count();
        if length > FILE_LINES_MAX {
            complaints.push(format!("{}: {length} lines", source.path));
        }
    }
    complain("a file has at most 450 lines", &complaints);
}

#[test]
fn there_is_no_unsafe_code() {
    let mut complaints = Vec::new();
    let mut excused = 0;
    for source in sources(&["src", "examples"]) {
        if MEETS_THE_MACHINE.contains(&source.path.as_str()) {
            excused += 1;
            continue;
        }
        for (number, line) in source.lines() {
            let code = line.split("//").next().unwrap_or_default();
            let mut words = code.split(|c: char| !c.is_alphanumeric() && c != '_');
            if words.any(|word| word == "unsafe") {
                complaints.push(format!("{}:{number}: {}", source.path, line.trim()));
            }
        }
    }
    complain("no unsafe code", &complaints);
    assert_eq!(excused, MEETS_THE_MACHINE.len(), "an excuse names a file that is there");
}

#[test]
fn every_exception_has_a_reason() {
    let mut complaints = Vec::new();
    for source in everything() {
        for lint in ["allow", "expect"] {
            for opening in [format!("#[{lint}("), format!("#![{lint}(")] {
                for (at, _) in source.text.match_indices(&opening) {
                    let line = source.text.get(..at).unwrap_or_default().lines().count();
                    let rest = source.text.get(at..).unwrap_or_default();
                    let attribute = rest.split(")]").next().unwrap_or_default();
                    // A mention in a string of this very file is no attribute.
                    let is_code = source.text.get(..at).is_some_and(|before| {
                        before.rsplit('\n').next().is_some_and(|start| start.trim().is_empty())
                    });
                    if is_code && !attribute.contains("reason = \"") {
                        complaints.push(format!("{}:{line}: {attribute})]", source.path));
                    }
                }
            }
        }
    }
    complain("an allowed lint says why", &complaints);
}

/// The fields of structs and enums that hold a `usize`, as (type, line number, line).
fn usize_fields(source: &Source) -> Vec<(&str, usize, &str)> {
    let mut found = Vec::new();
    let mut holder: Option<(&str, usize)> = None;
    for (number, line) in source.lines() {
        let code = line.split("//").next().unwrap_or_default().trim_end();
        let words: Vec<&str> = code.split(|c: char| !c.is_alphanumeric() && c != '_').collect();
        let named = words.iter().position(|word| *word == "struct" || *word == "enum");
        if let Some(name) = named.and_then(|at| words.get(at + 1)) {
            holder = Some((name, indent(line)));
        }
        let Some((name, margin)) = holder else {
            continue;
        };
        // A const parameter is a size, but not state.
        let parameter = code.trim_start().starts_with("const ")
            || code.contains("<const ")
            || code.contains(", const ");
        if words.contains(&"usize") && !parameter {
            found.push((name, number, line));
        }
        if indent(line) == margin && code.ends_with(['}', ';']) {
            holder = None;
        }
    }
    found
}

#[test]
fn stored_state_has_the_same_size_everywhere() {
    let mut complaints = Vec::new();
    let mut excused = Vec::new();
    for source in sources(&["src"]) {
        for (name, number, line) in usize_fields(&source) {
            if USIZE_HOLDERS.iter().any(|(holder, _)| *holder == name) {
                excused.push(name.to_owned());
            } else {
                complaints.push(format!("{}:{number}: {}", source.path, line.trim()));
            }
        }
    }
    complain("no usize in a struct or an enum", &complaints);
    for (holder, _) in USIZE_HOLDERS {
        assert!(excused.iter().any(|name| name == holder), "{holder} needs no excuse any more");
    }
}

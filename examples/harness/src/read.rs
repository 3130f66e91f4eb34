//! The text of a scene file, read.

use std::fmt;

use crate::document::Document;

/// How a scene file is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Syntax {
    /// Rusty Object Notation.
    Ron,
    /// JavaScript Object Notation.
    Json,
}

/// Why a text is not a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unreadable {
    /// The line, from 1.
    pub line: usize,
    /// The column, from 1.
    pub column: usize,
    /// The way to the field that was being read; empty at the top.
    pub path: String,
    /// What is wrong there, in one line.
    pub message: String,
}

impl fmt::Display for Unreadable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: ", self.line, self.column)?;
        if !self.path.is_empty() {
            write!(f, "{}: ", self.path)?;
        }
        f.write_str(&self.message)
    }
}

impl std::error::Error for Unreadable {}

/// Reads a scene file. Values nested more than some forty solids deep are refused.
///
/// # Errors
/// The first thing that is not as a scene file has it, with its line, column and field.
pub fn read(text: &str, syntax: Syntax) -> Result<Document, Unreadable> {
    // Some editors put a mark before the text.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    match syntax {
        Syntax::Ron => read_ron(text),
        Syntax::Json => read_json(text),
    }
}

fn read_ron(text: &str) -> Result<Document, Unreadable> {
    let unreadable = |error: ron::error::SpannedError, path: String| Unreadable {
        line: error.span.start.line,
        column: error.span.start.col,
        path,
        message: match error.code {
            ron::Error::ExceededRecursionLimit => "is nested too deeply".to_owned(),
            code => one_line(&code.to_string()),
        },
    };
    let mut from =
        ron::Deserializer::from_str(text).map_err(|error| unreadable(error, String::new()))?;
    let document = match serde_path_to_error::deserialize(&mut from) {
        Ok(document) => document,
        Err(error) => {
            let path = path_of(error.path());
            return Err(unreadable(from.span_error(error.into_inner()), path));
        }
    };
    from.end().map_err(|error| unreadable(from.span_error(error), String::new()))?;
    Ok(document)
}

fn read_json(text: &str) -> Result<Document, Unreadable> {
    let unreadable = |error: serde_json::Error, path: String| {
        let told = error.to_string();
        // The place stands in front of the message instead.
        let place = format!(" at line {} column {}", error.line(), error.column());
        let message = one_line(told.strip_suffix(&place).unwrap_or(&told));
        Unreadable { line: error.line(), column: error.column().max(1), path, message }
    };
    let mut from = serde_json::Deserializer::from_str(text);
    let document = match serde_path_to_error::deserialize(&mut from) {
        Ok(document) => document,
        Err(error) => {
            let path = path_of(error.path());
            return Err(unreadable(error.into_inner(), path));
        }
    };
    from.end().map_err(|error| unreadable(error, String::new()))?;
    Ok(document)
}

fn path_of(path: &serde_path_to_error::Path) -> String {
    let path = path.to_string();
    // What it does not know it writes as a question mark.
    let known = path.trim_end_matches('?').trim_end_matches('.');
    known.to_owned()
}

/// A message without its line breaks.
pub(crate) fn one_line(message: &str) -> String {
    message.split_whitespace().collect::<Vec<_>>().join(" ")
}

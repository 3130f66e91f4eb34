//! How commands end: one line on stderr, and a code for whoever called.

use std::ffi::OsString;
use std::io::{self, Write};

use clap::error::ErrorKind;

use crate::read::one_line;

/// Why a command could not do its work.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Failure {
    message: String,
    code: u8,
}

impl Failure {
    /// It was called in a way that cannot be.
    pub(crate) fn usage(message: impl Into<String>) -> Self {
        Self { message: message.into(), code: 2 }
    }

    /// A scene or a file is bad.
    pub(crate) fn scene(message: impl Into<String>) -> Self {
        Self { message: message.into(), code: 1 }
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self::scene(format!("cannot write the output: {error}"))
    }
}

/// Tells how a command ended, and gives its exit code.
pub(crate) fn report(result: Result<(), Failure>, err: &mut dyn Write) -> u8 {
    match result {
        Ok(()) => 0,
        Err(Failure { message, code }) => {
            // Where nobody can be told, the code must do.
            let _ = writeln!(err, "error: {}", one_line(&message));
            code
        }
    }
}

/// The options of a command, or `None` if all that was asked for was help.
pub(crate) fn parse<T: clap::Parser>(
    args: Vec<OsString>,
    out: &mut dyn Write,
) -> Result<Option<T>, Failure> {
    match T::try_parse_from(args) {
        Ok(options) => Ok(Some(options)),
        Err(error) if error.kind() == ErrorKind::DisplayHelp => {
            write!(out, "{error}")?;
            Ok(None)
        }
        Err(error) => {
            // The first paragraph says what is wrong; how to call it is what --help is for.
            let told = error.to_string();
            let first = told.split("\n\n").next().unwrap_or(&told);
            Err(Failure::usage(first.strip_prefix("error: ").unwrap_or(first)))
        }
    }
}

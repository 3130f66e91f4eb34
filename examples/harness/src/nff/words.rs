//! The words of a file, with the lines that they stand on.

use super::NffError;

/// A word and its line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Word<'a> {
    pub(super) text: &'a str,
    pub(super) line: usize,
}

/// The words of a text, one after another, without comments.
pub(super) struct Words<'a> {
    words: std::vec::IntoIter<Word<'a>>,
    /// The line of the last word that was taken, or the last line of the text at its end.
    line: usize,
    last_line: usize,
}

impl<'a> Words<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        let text = text.trim_start_matches('\u{feff}');
        let mut words = Vec::new();
        let mut last_line = 1;
        for (line, content) in (1..).zip(text.lines()) {
            let content = content.split('#').next().unwrap_or_default();
            words.extend(content.split_whitespace().map(|text| Word { text, line }));
            last_line = line;
        }
        Self { words: words.into_iter(), line: 1, last_line }
    }

    /// The next word, taken.
    pub(super) fn take(&mut self) -> Option<Word<'a>> {
        let word = self.words.next();
        self.line = word.map_or(self.last_line, |word| word.line);
        word
    }

    /// The next word, left where it is.
    pub(super) fn peek(&self) -> Option<Word<'a>> {
        self.words.as_slice().first().copied()
    }

    /// The line of the last word that was taken; at the end of the text, its last line.
    pub(super) fn line(&self) -> usize {
        self.line
    }

    /// The next word is meant to be a number.
    pub(super) fn number_follows(&self) -> bool {
        self.peek().is_some_and(|word| is_number(word.text))
    }

    /// The next number, which must be finite. `of` tells what it is a part of.
    pub(super) fn number(&mut self, of: &str) -> Result<f64, NffError> {
        let word = self.expect(of)?;
        match word.text.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            Ok(_) => Err(NffError::new(word.line, format!("{of}: `{}` is not finite", word.text))),
            Err(_) => {
                let message = format!("{of}: expected a number, found `{}`", word.text);
                Err(NffError::new(word.line, message))
            }
        }
    }

    /// The next three numbers.
    pub(super) fn numbers(&mut self, of: &str) -> Result<[f64; 3], NffError> {
        Ok([self.number(of)?, self.number(of)?, self.number(of)?])
    }

    /// The next whole number, at least 0.
    pub(super) fn count(&mut self, of: &str) -> Result<u64, NffError> {
        let word = self.expect(of)?;
        word.text.parse().map_err(|_| {
            let message = format!("{of}: expected a whole number from 0 on, found `{}`", word.text);
            NffError::new(word.line, message)
        })
    }

    fn expect(&mut self, of: &str) -> Result<Word<'a>, NffError> {
        let word = self.take();
        word.ok_or_else(|| NffError::new(self.line, format!("{of}: the file ends within it")))
    }
}

/// The word is meant to be a number, though it may be misspelt.
pub(super) fn is_number(word: &str) -> bool {
    word.starts_with(|first: char| first.is_ascii_digit() || "+-.".contains(first))
        || word.parse::<f64>().is_ok()
}

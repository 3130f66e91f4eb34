//! A picture in a terminal that grows while it is rendered: two pixels a character, one above
//! the other.

use std::fmt::Write;

/// A small copy of a picture for a terminal.
#[derive(Clone, Debug)]
pub struct Canvas {
    columns: usize,
    /// Of characters.
    lines: usize,
    /// Of the picture, in pixels.
    width: usize,
    height: usize,
    /// Row by row, two rows a line; what is not there yet is black.
    cells: Vec<[u8; 3]>,
    drawn: bool,
}

impl Canvas {
    /// For a picture of so many pixels, as large as a terminal of so many columns and lines lets it be;
    /// a pixel is as wide as a character and half as high.
    pub fn fitting(width: u32, height: u32, columns: u16, lines: u16) -> Self {
        let (width, height) = (width.max(1) as usize, height.max(1) as usize);
        // The last line is the cursor's.
        let lines = usize::from(lines.saturating_sub(1)).max(1);
        let widest = (lines * 2 * width / height).max(1);
        let columns = usize::from(columns).clamp(1, widest.min(width).max(1));
        let lines = (columns * height).div_ceil(width * 2).clamp(1, lines);
        let cells = vec![[0; 3]; columns * lines * 2];
        Self { columns, lines, width, height, cells, drawn: false }
    }

    /// Takes row `y` of the picture; whether anything of it shows.
    pub fn put(&mut self, y: u32, pixel: impl Fn(usize) -> [u8; 3]) -> bool {
        let rows = self.lines * 2;
        // The row of the picture in the middle of a row of cells.
        let source = |row: usize| (2 * row + 1) * self.height / (2 * rows);
        let mut shows = false;
        for (row, cells) in self.cells.chunks_mut(self.columns).enumerate() {
            if source(row) != y as usize {
                continue;
            }
            shows = true;
            for (column, cell) in cells.iter_mut().enumerate() {
                *cell = pixel((2 * column + 1) * self.width / (2 * self.columns));
            }
        }
        shows
    }

    /// What to write to show it, over what was shown before.
    pub fn draw(&mut self) -> String {
        let mut text = String::new();
        if self.drawn {
            // Writing into a string cannot fail.
            let _ = write!(text, "\x1b[{}A\r", self.lines);
        }
        self.drawn = true;
        for pair in self.cells.chunks(self.columns * 2) {
            let (upper, lower) = pair.split_at(self.columns.min(pair.len()));
            for ([r, g, b], [x, y, z]) in upper.iter().zip(lower) {
                let _ = write!(text, "\x1b[38;2;{r};{g};{b};48;2;{x};{y};{z}m\u{2580}");
            }
            text.push_str("\x1b[0m\n");
        }
        text
    }
}

/// Whether a terminal says that it shows colours of 24 bits, by the variables `COLORTERM` and `TERM`.
pub fn shows_colors(colorterm: Option<&str>, term: Option<&str>) -> bool {
    let direct = term.is_some_and(|term| term.ends_with("-direct"));
    term != Some("dumb") && (direct || matches!(colorterm, Some("truecolor" | "24bit")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_pixels_share_a_character() {
        let mut canvas = Canvas::fitting(2, 2, 80, 24);
        assert!(canvas.put(0, |x| [[1, 2, 3], [4, 5, 6]][x]));
        assert!(canvas.put(1, |x| [[7, 8, 9], [0, 10, 255]][x]));
        let expected = "\x1b[38;2;1;2;3;48;2;7;8;9m\u{2580}\x1b[38;2;4;5;6;48;2;0;10;255m\u{2580}\x1b[0m\n";
        assert_eq!(canvas.draw(), expected);
        assert_eq!(canvas.draw(), format!("\x1b[1A\r{expected}"), "over itself");
    }

    #[test]
    fn it_fits_and_keeps_its_shape() {
        for (width, height) in [(640, 480), (480, 640), (1, 5000), (5000, 1), (3, 3), (1 << 24, 7)] {
            for (columns, lines) in [(80, 24), (200, 50), (1, 1), (0, 0), (300, 9)] {
                let mut canvas = Canvas::fitting(width, height, columns, lines);
                assert!(canvas.columns <= usize::from(columns).max(1));
                assert!(canvas.lines <= usize::from(lines).saturating_sub(1).max(1));
                let seen = (0..height.min(5000)).filter(|&y| canvas.put(y, |_| [9; 3])).count();
                assert!(seen > 0 && seen <= canvas.lines * 2);
                assert_eq!(canvas.draw().matches('\n').count(), canvas.lines);
            }
        }
        let canvas = Canvas::fitting(640, 480, 80, 40);
        assert_eq!((canvas.columns, canvas.lines), (80, 30));
        let canvas = Canvas::fitting(640, 480, 200, 25);
        assert_eq!((canvas.columns, canvas.lines), (64, 24));
    }

    #[test]
    fn every_cell_is_filled_when_all_rows_are_there() {
        for (width, height) in [(37, 23), (100, 300), (9, 1)] {
            let mut canvas = Canvas::fitting(width, height, 60, 20);
            (0..height).for_each(|y| {
                canvas.put(y, |x| [x as u8 + 1, y as u8, 200]);
            });
            assert!(canvas.cells.iter().all(|cell| cell[2] == 200));
        }
    }

    #[test]
    fn terminals_say_what_they_can() {
        assert!(shows_colors(Some("truecolor"), Some("xterm")));
        assert!(shows_colors(Some("24bit"), None));
        assert!(shows_colors(None, Some("xterm-direct")));
        assert!(!shows_colors(None, Some("xterm-256color")));
        assert!(!shows_colors(Some("truecolor"), Some("dumb")));
        assert!(!shows_colors(Some("yes"), Some("xterm")));
    }
}

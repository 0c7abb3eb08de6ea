//! A sheet of characters, each with its ink, and how it becomes lines of text.

use super::{Colours, TerminalStyle};
use crate::output::width::columns_of;

/// The colour in which a character is drawn in a terminal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TerminalColour {
    /// The character is drawn as the terminal writes.
    #[default]
    Plain,
    /// The character is drawn dimmer.
    Faint,
    /// The character is drawn in the colour of a series, by its number.
    Series(usize),
}

/// Colours of series that a dark and a light terminal both show: cyan, yellow, magenta, green, blue, red.
const HUES: [u8; 6] = [36, 33, 35, 32, 34, 31];

/// The place behind a character that takes two columns.
const COVERED: char = '\0';

/// A sheet of characters in lines and columns; what is written beyond them is lost.
#[derive(Clone, Debug)]
pub struct CharacterGrid {
    style: TerminalStyle,
    cells: Vec<(char, TerminalColour)>,
}

impl CharacterGrid {
    /// A blank sheet of the size of a style.
    pub fn new(style: &TerminalStyle) -> Self {
        Self {
            style: *style,
            cells: vec![(' ', TerminalColour::Plain); style.width * style.height],
        }
    }

    /// Puts a character at a place of the sheet.
    pub fn put(&mut self, column: usize, row: usize, letter: char, ink: TerminalColour) {
        if column < self.style.width && row < self.style.height {
            self.cells[row * self.style.width + column] = (letter, ink);
        }
    }

    /// Writes a text on the sheet from a place to the right, typeset in the characters of the style.
    pub fn write(&mut self, column: usize, row: usize, text: &str, ink: TerminalColour) {
        let mut column = column;
        for letter in self.style.glyphs.typeset(text).chars() {
            match columns_of(letter) {
                // A place holds one character: an accent of its own would need another.
                0 => continue,
                // Half a character cannot be seen.
                wide if column + wide > self.style.width => return,
                wide => {
                    self.put(column, row, letter, ink);
                    (1..wide).for_each(|beside| self.put(column + beside, row, COVERED, ink));
                    column += wide;
                }
            }
        }
    }

    /// The lines of the sheet, joined by line breaks, without blanks at their ends.
    pub fn render(&self) -> String {
        if self.style.width == 0 {
            return String::new();
        }
        let rows = self.cells.chunks_exact(self.style.width);
        rows.map(|row| line(row, self.style.colours)).collect::<Vec<_>>().join("\n")
    }
}

fn line(row: &[(char, TerminalColour)], colours: Colours) -> String {
    let end = row.iter().rposition(|(letter, _)| *letter != ' ').map_or(0, |last| last + 1);
    let mut line = String::new();
    for run in row[..end].chunk_by(|(_, a), (_, b)| a == b) {
        let text: String =
            run.iter().map(|(letter, _)| letter).filter(|l| **l != COVERED).collect();
        match (colours, run[0].1) {
            (Colours::None, _) | (_, TerminalColour::Plain) => line.push_str(&text),
            (Colours::Ansi, TerminalColour::Faint) => {
                line.push_str(&format!("\x1b[2m{text}\x1b[0m"))
            }
            (Colours::Ansi, TerminalColour::Series(index)) => {
                let hue = HUES[index % HUES.len()];
                line.push_str(&format!("\x1b[{hue}m{text}\x1b[0m"));
            }
        }
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::terminal::Glyphs;

    #[test]
    fn wide_characters_take_two_places() {
        let style =
            TerminalStyle { glyphs: Glyphs::Braille, colours: Colours::None, width: 6, height: 2 };
        let mut sheet = CharacterGrid::new(&style);
        sheet.write(0, 0, "梁a長い", TerminalColour::Plain);
        sheet.write(0, 1, "cafe\u{301}!", TerminalColour::Plain);
        assert_eq!(sheet.render(), "梁a長\ncafe!");
    }

    #[test]
    fn inks_are_colours_only_where_there_are_some() {
        let plain =
            TerminalStyle { glyphs: Glyphs::Braille, colours: Colours::None, width: 6, height: 2 };
        let written = |style: &TerminalStyle| {
            let mut sheet = CharacterGrid::new(style);
            sheet.write(1, 0, "ab", TerminalColour::Series(0));
            sheet.write(3, 0, "c and what is lost", TerminalColour::Faint);
            sheet.write(0, 5, "lost", TerminalColour::Plain);
            sheet.render()
        };
        assert_eq!(written(&plain), " abc a\n");
        let coloured = TerminalStyle { colours: Colours::Ansi, ..plain };
        assert_eq!(written(&coloured), " \x1b[36mab\x1b[0m\x1b[2mc a\x1b[0m\n");
    }
}

//! Grid of coloured characters, converted to lines of text.

use super::{Colours, TerminalStyle};
use crate::output::width::columns_of;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TerminalColour {
    #[default]
    Plain,
    Faint,
    Series(usize),
}

const HUES: [u8; 6] = [36, 33, 35, 32, 34, 31];

const WIDE_PLACEHOLDER: char = '\0';

#[derive(Clone, Debug)]
pub struct CharacterGrid {
    style: TerminalStyle,
    cells: Vec<(char, TerminalColour)>,
}

impl CharacterGrid {
    pub fn new(style: &TerminalStyle) -> Self {
        Self {
            style: *style,
            cells: vec![(' ', TerminalColour::Plain); style.width * style.height],
        }
    }

    pub fn put(&mut self, column: usize, row: usize, letter: char, ink: TerminalColour) {
        if column < self.style.width && row < self.style.height {
            self.cells[row * self.style.width + column] = (letter, ink);
        }
    }

    pub fn write(&mut self, column: usize, row: usize, text: &str, ink: TerminalColour) {
        let mut column = column;
        for letter in self.style.glyphs.typeset(text).chars() {
            match columns_of(letter) {
                // Combining accents are omitted, because a cell contains one character.
                0 => continue,
                // A wide character is written only if both of its columns are inside the grid.
                wide if column + wide > self.style.width => return,
                wide => {
                    self.put(column, row, letter, ink);
                    (1..wide)
                        .for_each(|beside| self.put(column + beside, row, WIDE_PLACEHOLDER, ink));
                    column += wide;
                }
            }
        }
    }

    /// Lines of the grid without trailing blanks, joined by line breaks.
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
            run.iter().map(|(letter, _)| letter).filter(|l| **l != WIDE_PLACEHOLDER).collect();
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
    fn wide_characters_occupy_two_grid_cells() {
        let style =
            TerminalStyle { glyphs: Glyphs::Braille, colours: Colours::None, width: 6, height: 2 };
        let mut sheet = CharacterGrid::new(&style);
        sheet.write(0, 0, "梁a長い", TerminalColour::Plain);
        sheet.write(0, 1, "cafe\u{301}!", TerminalColour::Plain);
        assert_eq!(sheet.render(), "梁a長\ncafe!");
    }

    #[test]
    fn text_is_coloured_only_if_colours_are_enabled() {
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

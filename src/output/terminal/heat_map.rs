//! Heat maps as text. Each cell starts with a block character, which is darker for larger numbers.

use super::character_grid::{CharacterGrid, TerminalColour};
use super::{Glyphs, TerminalStyle};
use crate::output::heat_map::{HeatCell, HeatMap};
use crate::output::width::columns;

const BETWEEN: usize = 2;
const BLOCK: usize = 3;

impl HeatMap {
    /// Text of the heat map for a terminal, at most as wide as `style` allows. The height is not limited.
    pub fn text(&self, style: &TerminalStyle) -> String {
        let glyphs = style.glyphs;
        let cells: Vec<Vec<(char, TerminalColour, String)>> = self
            .cells
            .iter()
            .map(|row| row.iter().map(|cell| self.set(cell, glyphs)).collect())
            .collect();
        let names = self.rows.1.iter().map(|name| columns(&glyphs.typeset(name)));
        let gutter = names.chain([columns(&glyphs.typeset(&self.rows.0))]).max().unwrap_or(0);
        let width_of = |(column, name): (usize, &String)| {
            let texts = cells.iter().filter_map(|row| row.get(column));
            let widest = texts.map(|(_, _, text)| BLOCK + columns(text)).max().unwrap_or(0);
            widest.max(columns(&glyphs.typeset(name)))
        };
        let widths: Vec<usize> = self.columns.1.iter().enumerate().map(width_of).collect();
        let mut sheet = CharacterGrid::new(&style.sized(style.width, self.rows.1.len() + 4));
        sheet.write(0, 0, self.title(), TerminalColour::Plain);
        sheet.write(0, 1, &self.key(glyphs), TerminalColour::Faint);
        sheet.write(gutter + BETWEEN, 2, &self.columns.0, TerminalColour::Faint);
        sheet.write(0, 3, &self.rows.0, TerminalColour::Faint);
        let mut left = gutter + BETWEEN;
        for (column, name) in self.columns.1.iter().enumerate() {
            sheet.write(left, 3, name, TerminalColour::Plain);
            for (row, cells) in cells.iter().enumerate() {
                if let Some((block, ink, text)) = cells.get(column) {
                    (0..BLOCK - 1).for_each(|at| sheet.put(left + at, row + 4, *block, *ink));
                    sheet.write(left + BLOCK, row + 4, text, *ink);
                }
            }
            left += widths[column] + BETWEEN;
        }
        for (row, name) in self.rows.1.iter().enumerate() {
            sheet.write(0, row + 4, name, TerminalColour::Plain);
        }
        sheet.render()
    }

    fn set(&self, cell: &HeatCell, glyphs: Glyphs) -> (char, TerminalColour, String) {
        let text = glyphs.typeset(&cell.text.lines().collect::<Vec<_>>().join(" "));
        match cell.value.and_then(|value| self.part(value)) {
            None => (glyphs.choose('╳', 'X'), TerminalColour::Series(5), text),
            Some(part) => {
                let level = (part * 4.0).ceil() as usize;
                let ink = [
                    TerminalColour::Plain,
                    TerminalColour::Series(0),
                    TerminalColour::Series(1),
                    TerminalColour::Series(2),
                ];
                (blocks(glyphs)[level], ink[level.min(3)], text)
            }
        }
    }

    fn key(&self, glyphs: Glyphs) -> String {
        let (low, high) = self.ends();
        let ramp: String = blocks(glyphs).iter().collect();
        let has_hatched = self.cells.iter().flatten().any(|cell| cell.value.is_none());
        let cross = glyphs.choose('╳', 'X');
        let hatched =
            if has_hatched { format!("   {cross} {}", self.hatched) } else { String::new() };
        format!("{}: {low} {ramp} {high}{hatched}", self.scale.0)
    }
}

fn blocks(glyphs: Glyphs) -> [char; 5] {
    glyphs.choose(['·', '░', '▒', '▓', '█'], ['.', ':', '+', '%', '#'])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::terminal::Colours;

    fn map() -> HeatMap {
        let cell = |value, text: &str| HeatCell { value, text: text.into() };
        HeatMap::new("trapezoidal", "energy growth", (-12, 0))
            .columns("dt", vec!["0.1".into(), "0.25".into()])
            .rows("EA")
            .hatched("failed")
            .row("10⁴", vec![cell(Some(0.0), "0"), cell(Some(2e-3), "2e-3")])
            .row("10¹⁰", vec![cell(Some(4.0), "4"), cell(None, "t = 2")])
    }

    #[test]
    fn terminal_heat_map_equals_the_reference() {
        let style =
            TerminalStyle { glyphs: Glyphs::Ascii, colours: Colours::None, width: 60, height: 1 };
        let expected = "trapezoidal\n\
                        energy growth: <= 1e-12 .:+%# >= 1e0   X failed\n\
                        \u{20}     dt\n\
                        EA    0.1   0.25\n\
                        1e4   .. 0  ## 2e-3\n\
                        1e10  ## 4  XX t = 2";
        assert_eq!(map().text(&style), expected);
        let narrow = map().text(&style.sized(11, 1));
        assert!(narrow.lines().all(|line| line.chars().count() <= 11), "{narrow}");
    }

    #[test]
    fn terminal_heat_map_is_coloured_if_enabled() {
        let style =
            TerminalStyle { glyphs: Glyphs::Braille, colours: Colours::Ansi, width: 60, height: 1 };
        let text = map().text(&style);
        assert!(text.contains("\x1b[31m╳╳ t = 2\x1b[0m") || text.contains("\x1b[31m╳╳"), "{text}");
        assert!(text.contains("\x1b[35m██"), "{text}");
    }
}

//! Text tables with aligned columns, for the terminal and for logs.

use std::fmt;

use super::number::format_number;
use super::printable::printable_line;
use super::width::{columns, padded};

#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    Text(String),
    Number(String),
}

impl Cell {
    fn text(&self) -> &str {
        match self {
            Cell::Text(text) | Cell::Number(text) => text,
        }
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Cell::Text(text.into())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Cell::Text(text)
    }
}

impl From<f64> for Cell {
    fn from(x: f64) -> Self {
        Cell::Number(format_number(x))
    }
}

impl From<usize> for Cell {
    fn from(n: usize) -> Self {
        Cell::Number(n.to_string())
    }
}

impl From<i64> for Cell {
    fn from(n: i64) -> Self {
        Cell::Number(n.to_string())
    }
}

#[derive(Clone, Debug, Default)]
pub struct TextTable {
    title: String,
    header: Vec<String>,
    rows: Vec<Vec<Cell>>,
}

impl TextTable {
    pub fn new(header: &[&str]) -> Self {
        Self { header: header.iter().map(|head| (*head).to_string()).collect(), ..Self::default() }
    }

    pub fn title(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    pub fn row<C: Into<Cell>>(&mut self, cells: impl IntoIterator<Item = C>) -> &mut Self {
        self.rows.push(cells.into_iter().map(Into::into).collect());
        self
    }

    fn columns(&self) -> usize {
        self.rows.iter().map(Vec::len).chain([self.header.len()]).max().unwrap_or(0)
    }

    fn width(&self, column: usize) -> usize {
        let heads = self.header.get(column).map(|head| width_of(head));
        let cells =
            self.rows.iter().filter_map(|row| row.get(column)).map(|cell| width_of(cell.text()));
        cells.chain(heads).max().unwrap_or(0)
    }

    fn is_numeric(&self, column: usize) -> bool {
        self.rows.iter().any(|row| matches!(row.get(column), Some(Cell::Number(_))))
    }
}

impl fmt::Display for TextTable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let widths: Vec<usize> = (0..self.columns()).map(|column| self.width(column)).collect();
        if !self.title.is_empty() {
            writeln!(f, "{}", one_line(&self.title).trim_end())?;
        }
        let heads = self
            .header
            .iter()
            .enumerate()
            .map(|(column, head)| (head.as_str(), self.is_numeric(column)));
        write_line(f, heads, &widths)?;
        writeln!(
            f,
            "{}",
            widths.iter().map(|&width| "─".repeat(width)).collect::<Vec<_>>().join("  ")
        )?;
        for row in &self.rows {
            write_line(
                f,
                row.iter().map(|cell| (cell.text(), matches!(cell, Cell::Number(_)))),
                &widths,
            )?;
        }
        Ok(())
    }
}

fn write_line<'a>(
    f: &mut fmt::Formatter<'_>,
    cells: impl Iterator<Item = (&'a str, bool)>,
    widths: &[usize],
) -> fmt::Result {
    let padded = cells.zip(widths).map(|((text, right), &width)| {
        let text = one_line(text);
        match right {
            true => format!("{}{text}", " ".repeat(width.saturating_sub(columns(&text)))),
            false => padded(&text, width),
        }
    });
    writeln!(f, "{}", padded.collect::<Vec<_>>().join("  ").trim_end())
}

fn width_of(text: &str) -> usize {
    columns(&one_line(text))
}

fn one_line(text: &str) -> String {
    printable_line(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn table_aligns_text_left_and_numbers_right() {
        let mut table = TextTable::new(&["method", "dt [s]", "drift"]).title("Energy drift");
        table.row::<Cell>(["midpoint".into(), 0.05.into(), 3e-3.into()]);
        table.row::<Cell>(["energy_momentum".into(), 0.1.into(), 1e-15.into()]);
        let expected = "Energy drift\n\
                        method           dt [s]  drift\n\
                        ───────────────  ──────  ─────\n\
                        midpoint           0.05  0.003\n\
                        energy_momentum     0.1  1e-15\n";
        assert_eq!(table.to_string(), expected);
    }

    #[test]
    fn wide_characters_occupy_two_table_columns() {
        let mut table = TextTable::new(&["梁", "EI"]);
        table.row::<Cell>(["長い梁".into(), 1.0.into()]).row::<Cell>(["arm".into(), 10.0.into()]);
        let expected = "梁      EI\n──────  ──\n長い梁   1\narm     10\n";
        assert_eq!(table.to_string(), expected);
    }

    #[test]
    fn table_accepts_cells_of_any_length() {
        let mut table = TextTable::new(&["a", "b"]);
        table.row(["x".repeat(70_000).as_str(), "y"]).row(["z", "w"]);
        let text = table.to_string();
        assert!(text.lines().all(|line| line.chars().count() <= 70_003), "{}", text.len());
        assert_eq!(text.lines().nth(3).map(|line| line.len()), Some(70_003));
    }

    #[test]
    fn table_accepts_uneven_rows_and_line_breaks() {
        let mut table = TextTable::new(&["a"]);
        table.row(["x\ny", "beyond"]).row::<Cell>([]);
        let text = table.to_string();
        assert_eq!(text, "a\n───  ──────\nx y  beyond\n\n");
        assert!(text.lines().all(|line| line.trim_end() == line));
        assert_eq!(TextTable::new(&[]).to_string(), "\n\n");
    }
}

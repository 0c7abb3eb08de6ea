//! CSV tables of numbers: columns of equal length, with `#` comment lines above.

use std::borrow::Cow;
use std::io::{self, Write};

use super::OutputError;

#[derive(Clone, Debug, Default, PartialEq)]
pub struct CsvTable {
    /// Comment lines above the table, such as title and units, written after `#`.
    pub comments: Vec<String>,
    pub columns: Vec<(String, Vec<f64>)>,
}

impl CsvTable {
    pub fn new() -> Self {
        Self::default()
    }

    pub fn comment(mut self, text: impl Into<String>) -> Self {
        self.comments.push(text.into());
        self
    }

    pub fn column(mut self, name: impl Into<String>, values: Vec<f64>) -> Self {
        self.columns.push((name.into(), values));
        self
    }

    /// Keeps every n-th row and the last row, so that about `numbers` values remain, and states n in a comment line.
    #[must_use]
    pub fn thinned(mut self, numbers: usize) -> Self {
        let rows = self.columns.iter().map(|(_, values)| values.len()).max().unwrap_or(0);
        let most = (numbers / self.columns.len().max(1)).max(1);
        let every = rows.div_ceil(most);
        if every > 1 {
            for (_, values) in &mut self.columns {
                let is_last = |at: usize| at + 1 == values.len();
                let kept = (0..values.len()).filter(|at| at.is_multiple_of(every) || is_last(*at));
                *values = kept.map(|at| values[at]).collect();
            }
            self.comments.push(format!("rows: one in {every} of {rows}, and the last one"));
        }
        self
    }

    pub fn to_text(&self) -> Result<String, OutputError> {
        self.common_length()?;
        let mut bytes = Vec::new();
        self.write(&mut bytes).map_err(::csv::Error::from)?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }

    /// Writes the CSV file in pieces. An error of `file` ends the writing, so that a long table can be interrupted.
    pub fn write(&self, mut file: &mut dyn Write) -> io::Result<()> {
        let rows = self.common_length().map_err(io::Error::other)?;
        for line in self.comments.iter().flat_map(|comment| comment.lines()) {
            file.write_all(comment_line(line).as_bytes())?;
        }
        if !self.columns.is_empty() {
            let mut writer = ::csv::Writer::from_writer(&mut file);
            writer
                .write_record(self.columns.iter().map(|(name, _)| csv_cell(name).into_owned()))?;
            for row in 0..rows {
                writer.write_record(self.columns.iter().map(|(_, values)| exact(values[row])))?;
            }
            writer.flush()?;
        }
        Ok(())
    }

    fn common_length(&self) -> Result<usize, OutputError> {
        let Some((first, values)) = self.columns.first() else { return Ok(0) };
        let expected = values.len();
        match self.columns.iter().find(|(_, values)| values.len() != expected) {
            None => Ok(expected),
            Some((name, values)) => Err(OutputError::RaggedColumns {
                name: name.clone(),
                length: values.len(),
                first: first.clone(),
                expected,
            }),
        }
    }
}

pub fn csv_cell(text: &str) -> Cow<'_, str> {
    let is_formula = text.starts_with(['=', '+', '-', '@', '\t', '\r']);
    if is_formula && text.parse::<f64>().is_err() {
        Cow::Owned(format!("'{text}"))
    } else {
        Cow::Borrowed(text)
    }
}

pub(super) fn comment_line(text: &str) -> String {
    const CUTS: [char; 3] = [',', ';', '\t'];
    let mut line = "#".to_owned();
    for (at, piece) in text.split_inclusive(CUTS).enumerate() {
        let cell = piece.strip_suffix(CUTS).unwrap_or(piece);
        match at {
            0 => line.extend([" ", cell]),
            _ => line.push_str(&csv_cell(cell)),
        }
        line.push_str(&piece[cell.len()..]);
    }
    line.truncate(line.trim_end().len());
    line.push('\n');
    line
}

pub(super) fn exact(x: f64) -> String {
    if x.is_finite() { format!("{x:.16e}") } else { super::number::format_number(x) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn csv_contains_comments_then_names_then_rows() {
        let table = CsvTable::new()
            .comment("flight\nunits: SI")
            .column("t", vec![0.0, 0.1])
            .column("a, b", vec![-1.0, f64::NAN]);
        let expected = "# flight\n# units: SI\nt,\"a, b\"\n\
                        0.0000000000000000e0,-1.0000000000000000e0\n1.0000000000000001e-1,nan\n";
        assert_eq!(table.to_text().unwrap(), expected);
    }

    #[test]
    fn csv_columns_of_unequal_length_are_rejected_by_name() {
        let table = CsvTable::new().column("t", vec![0.0, 0.1]).column("energy", vec![1.0]);
        let message = table.to_text().unwrap_err().to_string();
        assert_eq!(
            message,
            "column 'energy' has 1 values but column 't' has 2; give every column one value per row"
        );
    }

    #[test]
    fn csv_texts_are_escaped_as_formulas_and_numbers_are_not() {
        for text in ["=1+1", "+1+1", "-1+1", "@SUM(A1)", "\t=1", "\r=1"] {
            assert_eq!(csv_cell(text), format!("'{text}"));
        }
        for text in ["", "a=1", "-1.5e3", "+2", "-inf", "1", " =1"] {
            assert_eq!(csv_cell(text), text);
        }
        let table = CsvTable::new().comment("of a,=1;-2;@b").column("=x", vec![-1.0]);
        let expected = "# of a,'=1;-2;'@b\n'=x\n-1.0000000000000000e0\n";
        assert_eq!(table.to_text().unwrap(), expected);
    }

    #[test]
    fn thinned_table_keeps_the_first_and_last_row() {
        let table = || {
            let values: Vec<f64> = (0..1000).map(f64::from).collect();
            CsvTable::new().column("t", values.clone()).column("x", values)
        };
        assert_eq!(table().thinned(2000), table());
        let thin = table().thinned(200);
        assert_eq!(thin.comments, ["rows: one in 10 of 1000, and the last one"]);
        let (first, last) = (&thin.columns[0].1, &thin.columns[1].1);
        assert_eq!((first.len(), first[0], last[1], last[100]), (101, 0.0, 10.0, 999.0));
        assert_eq!(table().thinned(0).columns[0].1, [0.0, 999.0]);
        assert_eq!(CsvTable::new().thinned(0), CsvTable::new());
    }

    #[test]
    fn writing_stops_at_the_first_write_error() {
        struct Short(usize);
        impl Write for Short {
            fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
                self.0 = self.0.checked_sub(bytes.len()).ok_or(io::ErrorKind::StorageFull)?;
                Ok(bytes.len())
            }
            fn flush(&mut self) -> io::Result<()> {
                Ok(())
            }
        }
        let table = CsvTable::new().column("x", vec![0.5; 10_000]);
        let mut file = Short(100_000);
        assert!(table.write(&mut file).is_err() && file.0 > 0);
        table.write(&mut Short(1_000_000)).unwrap();
    }

    #[test]
    fn an_empty_table_has_no_text() {
        assert_eq!(CsvTable::new().to_text().unwrap(), "");
    }

    proptest! {
        #[test]
        fn csv_numbers_are_read_back_bit_for_bit(values in prop::collection::vec(proptest::num::f64::ANY, 0..50)) {
            let text = CsvTable::new().comment("c").column("x", values.clone()).to_text().unwrap();
            let read: Vec<f64> = text.lines().skip(2).map(|line| line.parse().unwrap()).collect();
            prop_assert_eq!(read.len(), values.len());
            for (a, b) in read.iter().zip(&values) {
                prop_assert!(a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan()));
            }
        }
    }
}

//! CSV tables of other programs, with `#` comment lines.

/// Error of a table file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ParsedCsvError {
    /// Invalid CSV.
    #[error("line {line} is not a row of the table: {reason}")]
    Row {
        /// Line, from 1.
        line: u64,
        /// Reason.
        reason: String,
    },
    /// Duplicate column name.
    #[error("two columns have the name '{column}'; rename one of them")]
    Duplicate {
        /// Name.
        column: String,
    },
    /// Unknown column.
    #[error("it has no column '{column}'; its columns are {known}")]
    Column {
        /// Requested name.
        column: String,
        /// Existing names.
        known: String,
    },
    /// A cell is not a number.
    #[error(
        "line {line}, column '{column}', holds '{text}', which is not a finite number below 1e150"
    )]
    Number {
        /// Name of the column.
        column: String,
        /// Line, from 1.
        line: u64,
        /// Text of the cell.
        text: String,
    },
    /// A negative number where a size is expected.
    #[error("line {line}, column '{column}', holds '{text}', but an error must not be negative")]
    Negative {
        /// Name of the column.
        column: String,
        /// Line, from 1.
        line: u64,
        /// Text of the cell.
        text: String,
    },
}

/// Largest allowed number of a cell, so that its square is finite.
const LARGEST: f64 = 1e150;

/// A table of texts with named columns.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ParsedCsv {
    columns: Vec<String>,
    /// Cells with their line, from 1.
    rows: Vec<(u64, Vec<String>)>,
}

impl ParsedCsv {
    /// Parses comma-separated values.
    ///
    /// # Errors
    /// Fails if two columns have the same name, or a row has another number of cells than there are columns.
    pub fn parse(text: &str) -> Result<Self, ParsedCsvError> {
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let wrong = |error: csv::Error| ParsedCsvError::Row {
            line: error.position().map_or(1, csv::Position::line),
            reason: match error.kind() {
                csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
                    format!("it has {len} cells, but there are {expected_len} columns")
                }
                _ => error.to_string(),
            },
        };
        let texts = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect();
        let columns: Vec<String> = texts(reader.headers().map_err(wrong)?);
        let twice = (1..columns.len()).find(|later| columns[..*later].contains(&columns[*later]));
        if let Some(later) = twice {
            return Err(ParsedCsvError::Duplicate { column: columns[later].clone() });
        }
        let rows = reader.records().map(|record| {
            let record = record.map_err(wrong)?;
            Ok((record.position().map_or(1, csv::Position::line), texts(&record)))
        });
        Ok(Self { columns, rows: rows.collect::<Result<_, _>>()? })
    }

    /// Names of the columns, in order.
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Returns true if there are no rows.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Returns true if a column exists.
    pub fn has(&self, column: &str) -> bool {
        self.columns.iter().any(|name| name == column)
    }

    /// Texts of a row by column.
    ///
    /// # Panics
    /// If there is no such row.
    pub fn texts(&self, row: usize) -> &[String] {
        &self.rows[row].1
    }

    /// Line of a row in the file, from 1.
    ///
    /// # Panics
    /// If there is no such row.
    pub fn line(&self, row: usize) -> u64 {
        self.rows[row].0
    }

    /// Text of a cell.
    ///
    /// # Errors
    /// Fails if there is no such column.
    ///
    /// # Panics
    /// If there is no such row.
    pub fn text(&self, row: usize, column: &str) -> Result<&str, ParsedCsvError> {
        let found = self.columns.iter().position(|name| name == column);
        let missing =
            || ParsedCsvError::Column { column: column.to_owned(), known: self.columns.join(", ") };
        found.map(|index| self.rows[row].1[index].as_str()).ok_or_else(missing)
    }

    /// Number in a cell.
    ///
    /// # Errors
    /// Fails when there is no such column, or something else than a finite number whose square is finite.
    pub fn number(&self, row: usize, column: &str) -> Result<f64, ParsedCsvError> {
        let text = self.text(row, column)?;
        let number = text.parse().ok().filter(|number: &f64| number.abs() <= LARGEST);
        number.ok_or_else(|| ParsedCsvError::Number {
            column: column.to_owned(),
            line: self.rows[row].0,
            text: text.to_owned(),
        })
    }

    /// Non-negative size of an error in a cell.
    ///
    /// # Errors
    /// Fails if there is no such column, or the cell is not a finite non-negative number.
    pub fn size(&self, row: usize, column: &str) -> Result<f64, ParsedCsvError> {
        let number = self.number(row, column)?;
        let (column, line) = (column.to_owned(), self.rows[row].0);
        match number < 0.0 {
            true => Err(ParsedCsvError::Negative {
                text: self.text(row, &column)?.to_owned(),
                column,
                line,
            }),
            false => Ok(number),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_wrong_with_a_table_is_said_with_its_place() {
        let sheet =
            ParsedCsv::parse("# how it was made\nt, x0\n0,1.5\n1,two\n2,NaN\n3,-1e300\n").unwrap();
        assert_eq!((sheet.len(), sheet.number(0, "x0")), (4, Ok(1.5)));
        for (row, told) in [
            (1, "line 4, column 'x0', holds 'two'"),
            (2, "line 5, column 'x0', holds 'NaN'"),
            (3, "line 6, column 'x0', holds '-1e300'"),
        ] {
            let error = sheet.number(row, "x0").unwrap_err().to_string();
            assert_eq!(error, format!("{told}, which is not a finite number below 1e150"));
        }
        let told = sheet.number(0, "y0").unwrap_err().to_string();
        assert_eq!(told, "it has no column 'y0'; its columns are t, x0");
        let told = ParsedCsv::parse("t, x0, x0\n0,1,2\n").unwrap_err().to_string();
        assert_eq!(told, "two columns have the name 'x0'; rename one of them");
        let told = ParsedCsv::parse("# made\nt,x0\n0,1\n1\n").unwrap_err().to_string();
        assert_eq!(
            told,
            "line 4 is not a row of the table: it has 1 cells, but there are 2 columns"
        );
    }
}

//! Tables that others have written: CSV with `#` comment lines above.

/// A table in a file that cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ParsedCsvError {
    /// A row of the table is no CSV.
    #[error("line {line} is not a row of the table: {reason}")]
    Row {
        /// The line of the row that is no CSV, counted from 1.
        line: u64,
        /// The reason why the row is no CSV.
        reason: String,
    },
    /// Two columns of the table have the same name.
    #[error("two of its columns are called '{column}'; give each a name of its own")]
    Duplicate {
        /// The name that two columns have.
        column: String,
    },
    /// The table has no such column.
    #[error("it has no column '{column}'; its columns are {known}")]
    Column {
        /// The name of the column asked for.
        column: String,
        /// The names of the columns that the table has.
        known: String,
    },
    /// A cell of the table is not a number.
    #[error(
        "line {line}, column '{column}', holds '{text}', which is not a finite number below 1e150"
    )]
    Number {
        /// The name of the column of the cell that is not a number.
        column: String,
        /// The line of the cell that is not a number, counted from 1.
        line: u64,
        /// The text of the cell that is not a number.
        text: String,
    },
    /// A cell of the table is a negative number, and means a size.
    #[error(
        "line {line}, column '{column}', holds '{text}', and the size of an error is not negative"
    )]
    Negative {
        /// The name of the column of the negative cell.
        column: String,
        /// The line of the negative cell, counted from 1.
        line: u64,
        /// The text of the negative cell.
        text: String,
    },
}

/// The largest number of a cell: its square is finite.
const LARGEST: f64 = 1e150;

/// A table of texts with named columns.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ParsedCsv {
    columns: Vec<String>,
    /// Each with the line where it stands, counted from 1.
    rows: Vec<(u64, Vec<String>)>,
}

impl ParsedCsv {
    /// Reads a table of comma-separated values from the text of a file.
    ///
    /// # Errors
    /// When two columns have the same name, or a row has more or fewer cells than there are columns.
    pub fn parse(text: &str) -> Result<Self, ParsedCsvError> {
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let wrong = |error: csv::Error| ParsedCsvError::Row {
            line: error.position().map_or(1, csv::Position::line),
            reason: match error.kind() {
                csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
                    format!("it has {len} cells, and there are {expected_len} columns")
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

    /// The names of the columns of the table, in order.
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// The number of rows of the table.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether the table has no row.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Whether the table has a column of a name.
    pub fn has(&self, column: &str) -> bool {
        self.columns.iter().any(|name| name == column)
    }

    /// The texts in a row of the table, column by column.
    ///
    /// # Panics
    /// When there is no such row.
    pub fn texts(&self, row: usize) -> &[String] {
        &self.rows[row].1
    }

    /// The line of the file where a row of the table stands, counted from 1.
    ///
    /// # Panics
    /// When there is no such row.
    pub fn line(&self, row: usize) -> u64 {
        self.rows[row].0
    }

    /// The text in a row and a column of the table.
    ///
    /// # Errors
    /// When there is no such column.
    ///
    /// # Panics
    /// When there is no such row.
    pub fn text(&self, row: usize, column: &str) -> Result<&str, ParsedCsvError> {
        let found = self.columns.iter().position(|name| name == column);
        let missing =
            || ParsedCsvError::Column { column: column.to_owned(), known: self.columns.join(", ") };
        found.map(|index| self.rows[row].1[index].as_str()).ok_or_else(missing)
    }

    /// The number in a row and a column of the table.
    ///
    /// # Errors
    /// When there is no such column, or something else than a finite number whose square is finite.
    pub fn number(&self, row: usize, column: &str) -> Result<f64, ParsedCsvError> {
        let text = self.text(row, column)?;
        let number = text.parse().ok().filter(|number: &f64| number.abs() <= LARGEST);
        number.ok_or_else(|| ParsedCsvError::Number {
            column: column.to_owned(),
            line: self.rows[row].0,
            text: text.to_owned(),
        })
    }

    /// The size of an error in a row and a column of the table, which is not negative.
    ///
    /// # Errors
    /// When there is no such column, or something else than a finite number that is not negative.
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
        assert_eq!(told, "two of its columns are called 'x0'; give each a name of its own");
        let told = ParsedCsv::parse("# made\nt,x0\n0,1\n1\n").unwrap_err().to_string();
        assert_eq!(
            told,
            "line 4 is not a row of the table: it has 1 cells, and there are 2 columns"
        );
    }
}

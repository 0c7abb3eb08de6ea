//! CSV tables of other programs. Comment lines start with `#`. Cells are separated by commas, semicolons or tabs.

#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ParsedCsvError {
    #[error("line {line} is not a row of the table: {reason}")]
    Row { line: u64, reason: String },
    #[error("two columns have the name '{column}'; rename one of them")]
    Duplicate { column: String },
    #[error("it has no column '{column}'; its columns are {known}")]
    Column { column: String, known: String },
    #[error(
        "line {line}, column '{column}', holds '{text}', which is not a finite number below 1e150"
    )]
    Number { column: String, line: u64, text: String },
    #[error("line {line}, column '{column}', holds '{text}', but an error must not be negative")]
    Negative { column: String, line: u64, text: String },
}

/// Largest allowed magnitude of a number in a table, so that its square is finite.
const LARGEST: f64 = 1e150;

const LONGEST_SHOWN: usize = 60;

#[derive(Debug, Clone, PartialEq, Default)]
pub struct ParsedCsv {
    columns: Vec<String>,
    separator: u8,
    rows: Vec<(u64, Vec<String>)>,
}

impl ParsedCsv {
    /// Parses a table. Semicolons or tabs separate cells if the header line contains no comma.
    /// The line of dimensions below the header in files written by withy is skipped.
    pub fn parse(text: &str) -> Result<Self, ParsedCsvError> {
        let separator = separator_of(text);
        let mut reader = csv::ReaderBuilder::new()
            .delimiter(separator)
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
        let mut rows: Vec<(u64, Vec<String>)> = rows.collect::<Result<_, _>>()?;
        if rows.first().is_some_and(|(_, cells)| is_line_of_units(cells)) {
            rows.remove(0);
        }
        Ok(Self { columns, separator, rows })
    }

    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    pub fn len(&self) -> usize {
        self.rows.len()
    }

    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    pub fn has(&self, column: &str) -> bool {
        self.columns.iter().any(|name| name == column)
    }

    pub fn texts(&self, row: usize) -> &[String] {
        &self.rows[row].1
    }

    pub fn line(&self, row: usize) -> u64 {
        self.rows[row].0
    }

    pub fn text(&self, row: usize, column: &str) -> Result<&str, ParsedCsvError> {
        let found = self.columns.iter().position(|name| name == column);
        let missing =
            || ParsedCsvError::Column { column: column.to_owned(), known: self.columns.join(", ") };
        found.map(|index| self.rows[row].1[index].as_str()).ok_or_else(missing)
    }

    pub fn number(&self, row: usize, column: &str) -> Result<f64, ParsedCsvError> {
        let text = self.text(row, column)?;
        // A comma in a number is the decimal separator unless commas separate the cells.
        let has_decimal_comma = self.separator != b',' && !text.contains('.');
        let parsed = match has_decimal_comma {
            true => text.replace(',', ".").parse(),
            false => text.parse(),
        };
        let number = parsed.ok().filter(|number: &f64| number.abs() <= LARGEST);
        number.ok_or_else(|| ParsedCsvError::Number {
            column: column.to_owned(),
            line: self.rows[row].0,
            text: shortened(text),
        })
    }

    pub fn size(&self, row: usize, column: &str) -> Result<f64, ParsedCsvError> {
        let number = self.number(row, column)?;
        let (column, line) = (column.to_owned(), self.rows[row].0);
        match number < 0.0 {
            true => Err(ParsedCsvError::Negative {
                text: shortened(self.text(row, &column)?),
                column,
                line,
            }),
            false => Ok(number),
        }
    }
}

fn shortened(text: &str) -> String {
    match text.char_indices().nth(LONGEST_SHOWN) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

fn separator_of(text: &str) -> u8 {
    let names = text.lines().find(|line| !line.trim().is_empty() && !line.starts_with('#'));
    let has = |separator| names.is_some_and(|names| names.contains(separator));
    match (has(','), has(';'), has('\t')) {
        (false, true, _) => b';',
        (false, false, true) => b'\t',
        _ => b',',
    }
}

fn is_line_of_units(cells: &[String]) -> bool {
    let is_factor = |factor: &str| {
        let name = factor.trim_end_matches(['²', '³']);
        ["1", "time", "length", "mass", "force", "energy", "rad"].contains(&name)
    };
    let is_unit =
        |cell: &String| cell.is_empty() || cell == "-" || cell.split(['·', '/']).all(is_factor);
    cells.iter().all(is_unit) && cells.iter().any(|cell| cell.chars().any(char::is_alphabetic))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn error_message_quotes_only_the_beginning_of_a_long_cell() {
        let table = ParsedCsv::parse(&format!("t\n{}\n", "1é".repeat(1000))).unwrap();
        let messages = table.number(0, "t").unwrap_err().to_string();
        assert!(messages.contains("holds '1é1é") && messages.chars().count() < 150, "{messages}");
    }

    #[test]
    fn csv_separators_decimal_commas_and_unit_lines_are_recognised() {
        for text in [
            "t,x0\n0,1.5\n1,2\n",
            "# made\nt,x0\ntime,length\n0,1.5\n1,2\n",
            "t,x0\n,mass·length/time²\n0,1.5\n1,2\n",
            "t;x0\n0;1,5\n1;2\n",
            "t;x0\n0;1.5\n1;2\n",
            "t\tx0\n-\trad\n0\t1,5\n1\t2\n",
        ] {
            let table = ParsedCsv::parse(text).unwrap();
            let numbers: Vec<_> = (0..table.len()).map(|row| table.number(row, "x0")).collect();
            assert_eq!(numbers, [Ok(1.5), Ok(2.0)], "{text:?}");
        }
        for text in ["t,x0\n0,\"1,5\"\n", "t;x0\n0;1.000,5\n", "t,x0\n-,-\n", "t,x0\n0,time\n"] {
            let table = ParsedCsv::parse(text).unwrap();
            assert!(table.number(0, "x0").is_err(), "{text:?}");
        }
    }

    #[test]
    fn csv_errors_state_line_and_column() {
        let sheet =
            ParsedCsv::parse("# how it was made\nt, x0\n0,1.5\n1,two\n2,NaN\n3,-1e300\n").unwrap();
        assert_eq!((sheet.len(), sheet.number(0, "x0")), (4, Ok(1.5)));
        for (row, message) in [
            (1, "line 4, column 'x0', holds 'two'"),
            (2, "line 5, column 'x0', holds 'NaN'"),
            (3, "line 6, column 'x0', holds '-1e300'"),
        ] {
            let error = sheet.number(row, "x0").unwrap_err().to_string();
            assert_eq!(error, format!("{message}, which is not a finite number below 1e150"));
        }
        let message = sheet.number(0, "y0").unwrap_err().to_string();
        assert_eq!(message, "it has no column 'y0'; its columns are t, x0");
        let message = ParsedCsv::parse("t, x0, x0\n0,1,2\n").unwrap_err().to_string();
        assert_eq!(message, "two columns have the name 'x0'; rename one of them");
        let message = ParsedCsv::parse("# made\nt,x0\n0,1\n1\n").unwrap_err().to_string();
        assert_eq!(
            message,
            "line 4 is not a row of the table: it has 1 cells, but there are 2 columns"
        );
    }
}

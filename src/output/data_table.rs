//! Tables of numbers, booleans and texts for other programs, without comment lines.

use std::io::{self, Write};

use super::OutputError;
use super::csv::{csv_cell, exact};

#[derive(Clone, Debug, Default, PartialEq)]
pub struct DataTable {
    pub columns: Vec<DataColumn>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct DataColumn {
    pub name: String,
    /// Dimension of the column: `-` for a pure number, empty if unknown or not applicable.
    pub dimension: String,
    pub values: DataValues,
}

#[derive(Clone, Debug, PartialEq)]
pub enum DataValues {
    Numbers(Vec<Option<f64>>),
    Integers(Vec<Option<i64>>),
    Booleans(Vec<Option<bool>>),
    Texts(Vec<Option<String>>),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableHeading {
    Names,
    NamesAndUnits,
}

impl DataValues {
    pub fn length(&self) -> usize {
        match self {
            Self::Numbers(values) => values.len(),
            Self::Integers(values) => values.len(),
            Self::Booleans(values) => values.len(),
            Self::Texts(values) => values.len(),
        }
    }

    fn written(&self, row: usize) -> String {
        let written = match self {
            Self::Numbers(values) => values[row].map(exact),
            Self::Integers(values) => values[row].map(|value| value.to_string()),
            Self::Booleans(values) => values[row].map(|value| value.to_string()),
            Self::Texts(values) => values[row].as_deref().map(|text| csv_cell(text).into_owned()),
        };
        written.unwrap_or_default()
    }
}

impl DataTable {
    /// Writes the CSV file in pieces. Numbers have 17 digits, from which a float can be restored exactly.
    /// An error of `file` ends the writing, so that a long table can be interrupted.
    pub fn write_csv(&self, heading: TableHeading, file: &mut dyn Write) -> io::Result<()> {
        let rows = self.rows().map_err(io::Error::other)?;
        let mut writer = ::csv::Writer::from_writer(file);
        writer
            .write_record(self.columns.iter().map(|column| csv_cell(&column.name).into_owned()))?;
        if heading == TableHeading::NamesAndUnits {
            writer.write_record(self.columns.iter().map(|column| &column.dimension))?;
        }
        for row in 0..rows {
            writer.write_record(self.columns.iter().map(|column| column.values.written(row)))?;
        }
        writer.flush()
    }

    pub(super) fn rows(&self) -> Result<usize, OutputError> {
        let Some(first) = self.columns.first() else { return Ok(0) };
        let expected = first.values.length();
        match self.columns.iter().find(|column| column.values.length() != expected) {
            None => Ok(expected),
            Some(column) => Err(OutputError::RaggedColumns {
                name: column.name.clone(),
                length: column.values.length(),
                first: first.name.clone(),
                expected,
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn csv(table: &DataTable, heading: TableHeading) -> io::Result<String> {
        let mut bytes = Vec::new();
        table.write_csv(heading, &mut bytes)?;
        Ok(String::from_utf8(bytes).unwrap())
    }

    fn table() -> DataTable {
        let column = |name: &str, dimension: &str, values| DataColumn {
            name: name.into(),
            dimension: dimension.into(),
            values,
        };
        DataTable {
            columns: vec![
                column("t", "time", DataValues::Numbers(vec![Some(0.1), None])),
                column("steps", "-", DataValues::Integers(vec![Some(3), Some(-1)])),
                column("good", "", DataValues::Booleans(vec![Some(true), None])),
                column("told", "", DataValues::Texts(vec![Some("a, b".into()), None])),
            ],
        }
    }

    #[test]
    fn table_has_a_name_line_and_an_optional_unit_line() {
        let rows = "1.0000000000000001e-1,3,true,\"a, b\"\n,-1,,\n";
        let names = "t,steps,good,told\n";
        assert_eq!(csv(&table(), TableHeading::Names).unwrap(), format!("{names}{rows}"));
        let with_units = csv(&table(), TableHeading::NamesAndUnits).unwrap();
        assert_eq!(with_units, format!("{names}time,-,,\n{rows}"));
    }

    #[test]
    fn texts_and_names_are_not_read_as_formulas() {
        let column =
            |name: &str, values| DataColumn { name: name.into(), dimension: String::new(), values };
        let table = DataTable {
            columns: vec![
                column("=1+1", DataValues::Texts(vec![Some("@a".into()), Some("-x".into())])),
                column("n", DataValues::Integers(vec![Some(-1), Some(2)])),
            ],
        };
        assert_eq!(csv(&table, TableHeading::Names).unwrap(), "'=1+1,n\n'@a,-1\n'-x,2\n");
    }

    #[test]
    fn columns_of_unequal_length_are_rejected() {
        let mut ragged = table();
        ragged.columns[1].values = DataValues::Integers(vec![]);
        assert!(csv(&ragged, TableHeading::Names).is_err());
    }
}

//! CSV tables of texts and numbers, with `#` comment lines above.

use super::OutputError;
use super::csv::{comment_line, csv_cell};

#[derive(Clone, Debug, Default, PartialEq)]
pub struct CsvRecords {
    pub comments: Vec<String>,
    pub names: Vec<String>,
    pub rows: Vec<Vec<String>>,
}

impl CsvRecords {
    pub fn to_text(&self) -> Result<String, OutputError> {
        let comments = self.comments.iter().flat_map(|comment| comment.lines());
        let mut bytes: Vec<u8> =
            comments.flat_map(|line| comment_line(line).into_bytes()).collect();
        let mut writer = ::csv::Writer::from_writer(&mut bytes);
        for row in std::iter::once(&self.names).chain(&self.rows) {
            writer.write_record(row.iter().map(|cell| csv_cell(cell).into_owned()))?;
        }
        writer.flush().map_err(::csv::Error::from)?;
        drop(writer);
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn csv_records_quote_cells_with_commas() {
        let mut records = CsvRecords {
            comments: vec!["a study".into()],
            names: vec!["mesh".into(), "error".into()],
            rows: vec![
                vec!["8 spans, cubic".into(), "0.5".into()],
                vec!["=A1".into(), "-1e-3".into()],
            ],
        };
        assert_eq!(
            records.to_text().unwrap(),
            "# a study\nmesh,error\n\"8 spans, cubic\",0.5\n'=A1,-1e-3\n"
        );
        records.rows.push(vec!["alone".into()]);
        assert!(records.to_text().is_err());
    }
}

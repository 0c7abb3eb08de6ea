//! What is known of the rows of a sweep while it is made.

use super::rows::RowOutcome;
use crate::analysis::{RowEntry, SweepResults};
use crate::script::messages::error::ScriptError;
use crate::script::state::parts::StudyPart;

/// What is known of the rows so far.
pub struct SweepProgress {
    /// What was found.
    pub results: SweepResults,
    /// Whether a row has been heard of.
    is_known: Vec<bool>,
    /// How many rows have been heard of, or are left out.
    pub done: usize,
    /// How many rows there are.
    pub rows: usize,
    /// The first row that came to its end, from which the names are.
    pub model: Option<usize>,
}

/// Why a sweep breaks off.
pub enum SweepError {
    /// The function seems wrong, or gives something that is: what it was, and in which row.
    Row(usize, String),
    /// Another error.
    Other(ScriptError),
}

impl SweepProgress {
    /// Nothing is known of so many rows.
    pub fn new(rows: usize) -> Self {
        let results = SweepResults::default();
        Self { results, is_known: vec![false; rows], done: 0, rows, model: None }
    }

    /// Counts the rows that belong to other parts as known, though nothing is known of them.
    pub fn leave_out(&mut self, part: StudyPart) {
        for row in (0..self.rows).filter(|row| !part.has(*row)) {
            self.know(row);
        }
    }

    /// Gives rows that belong to other parts what the first row here has found: the script goes on with something.
    pub fn pretend_the_rest(&mut self) {
        let Some(model) = self.model else { return };
        let found: Vec<f64> = self.results.row(model).collect();
        let has_failed = |row: &usize| self.results.failure(*row).is_some();
        let empty = (0..self.rows)
            .filter(|row| !has_failed(row) && self.results.row(*row).all(f64::is_nan));
        for row in empty.collect::<Vec<_>>() {
            self.results.find(row, &found);
        }
    }

    /// Whether a row has been heard of, or is left out.
    pub fn knows(&self, row: usize) -> bool {
        self.is_known[row]
    }

    fn know(&mut self, row: usize) -> bool {
        let is_new = self.is_known.get(row) == Some(&false);
        if is_new {
            self.is_known[row] = true;
            self.done += 1;
        }
        is_new
    }

    /// Takes an entry of a journal; what fits nothing is left out.
    pub fn recall(&mut self, entry: RowEntry) {
        match entry {
            RowEntry::Sweep { .. } => (),
            RowEntry::Names(names) => {
                if self.results.names.is_empty() && !names.is_empty() {
                    self.results.begin(names, self.rows);
                }
            }
            RowEntry::Found(row, values) => {
                let fits = values.len() == self.results.names.len();
                if let Some(row) = usize::try_from(row).ok().filter(|_| fits)
                    && self.know(row)
                {
                    self.model.get_or_insert(row);
                    self.results.find(row, &values);
                }
            }
            RowEntry::Failed(row, reason) => {
                if let Ok(row) = usize::try_from(row)
                    && self.know(row)
                {
                    self.results.fail(row, &reason);
                }
            }
        }
    }

    /// Takes what became of a row; gives the entries for the journal.
    pub fn hear(&mut self, at: usize, row: RowOutcome) -> Result<Vec<RowEntry>, SweepError> {
        let number = at as u64;
        match row {
            RowOutcome::Found(names, values) => {
                let mut entries = Vec::new();
                if self.model.is_none() {
                    self.model = Some(at);
                    self.results.begin(names.to_vec(), self.rows);
                    entries.push(RowEntry::Names(names.to_vec()));
                } else if *names != *self.results.names {
                    let told = format!("it gives {} here", listed(&names));
                    return Err(SweepError::Row(at, told));
                }
                self.know(at);
                self.results.find(at, &values);
                entries.push(RowEntry::Found(number, values));
                Ok(entries)
            }
            // As long as no run has come to its end, the function may be wrong for all.
            RowOutcome::Wrong(told) if self.model.is_none() => Err(SweepError::Row(at, told)),
            RowOutcome::Failed(reason) | RowOutcome::Wrong(reason) => {
                self.know(at);
                self.results.fail(at, &reason);
                Ok(vec![RowEntry::Failed(number, reason)])
            }
        }
    }
}

/// Names in a line.
pub fn listed(names: &[String]) -> String {
    names.join(", ")
}

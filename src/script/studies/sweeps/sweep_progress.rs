//! State of the rows of a running sweep.

use super::rows::RowOutcome;
use crate::analysis::{RowEntry, SweepResults};
use crate::script::messages::error::ScriptError;
use crate::script::state::parts::StudyPart;

pub struct SweepProgress {
    pub results: SweepResults,
    is_known: Vec<bool>,
    pub done: usize,
    pub rows: usize,
    pub model: Option<usize>,
}

pub enum SweepError {
    Row(usize, String),
    Other(ScriptError),
}

impl SweepProgress {
    pub fn new(rows: usize) -> Self {
        let results = SweepResults::default();
        Self { results, is_known: vec![false; rows], done: 0, rows, model: None }
    }

    pub fn mark_other_parts(&mut self, part: StudyPart) {
        for row in (0..self.rows).filter(|row| !part.has(*row)) {
            self.restore_row(row);
        }
    }

    /// Fills the rows of other parts with the first result of this part, so that the script can continue.
    pub fn fill_other_parts(&mut self) {
        let Some(model) = self.model else { return };
        let found: Vec<f64> = self.results.row(model).collect();
        let has_failed = |row: &usize| self.results.failure(*row).is_some();
        let empty = (0..self.rows)
            .filter(|row| !has_failed(row) && self.results.row(*row).all(f64::is_nan));
        for row in empty.collect::<Vec<_>>() {
            self.results.find(row, &found);
        }
    }

    pub fn knows(&self, row: usize) -> bool {
        self.is_known[row]
    }

    fn restore_row(&mut self, row: usize) -> bool {
        let is_new = self.is_known.get(row) == Some(&false);
        if is_new {
            self.is_known[row] = true;
            self.done += 1;
        }
        is_new
    }

    /// Reads a journal entry, unless it has a wrong number of values.
    pub fn recall(&mut self, entry: RowEntry) {
        match entry {
            RowEntry::Sweep { .. } => (),
            RowEntry::Names(names) => {
                if self.results.names.is_empty() && !names.is_empty() {
                    self.results.begin(names, self.rows);
                }
            }
            RowEntry::Computed(row, values) => {
                let fits = values.len() == self.results.names.len();
                if let Some(row) = usize::try_from(row).ok().filter(|_| fits)
                    && self.restore_row(row)
                {
                    self.model.get_or_insert(row);
                    self.results.find(row, &values);
                }
            }
            RowEntry::Failed(row, reason) => {
                if let Ok(row) = usize::try_from(row)
                    && self.restore_row(row)
                {
                    self.results.fail(row, &reason);
                }
            }
        }
    }

    pub fn record_result(
        &mut self,
        at: usize,
        row: RowOutcome,
    ) -> Result<Vec<RowEntry>, SweepError> {
        let number = at as u64;
        match row {
            RowOutcome::Computed(names, values) => {
                let mut entries = Vec::new();
                if self.model.is_none() {
                    self.model = Some(at);
                    self.results.begin(names.to_vec(), self.rows);
                    entries.push(RowEntry::Names(names.to_vec()));
                } else if *names != *self.results.names {
                    let message = format!("it returns {} here", listed(&names));
                    return Err(SweepError::Row(at, message));
                }
                self.restore_row(at);
                self.results.find(at, &values);
                entries.push(RowEntry::Computed(number, values));
                Ok(entries)
            }
            RowOutcome::Wrong(message) if self.model.is_none() => Err(SweepError::Row(at, message)),
            RowOutcome::Failed(reason) | RowOutcome::Wrong(reason) => {
                self.restore_row(at);
                self.results.fail(at, &reason);
                Ok(vec![RowEntry::Failed(number, reason)])
            }
        }
    }
}

pub fn listed(names: &[String]) -> String {
    names.join(", ")
}

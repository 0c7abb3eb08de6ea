//! Journals of the studies of a run, kept until the script ends, so that a run after an interrupt or error can reuse completed cases.

use std::cell::{Cell, RefCell};
use std::io;
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::settings::JournalPreference;
use crate::analysis::{Journal, JournalError, RowEntry, RowJournal, read_rows, remove_rows};
use crate::script::messages::error::ScriptError;

#[derive(Default)]
pub struct Journals {
    open: RefCell<Vec<(Journal, JournalLifetime)>>,
    of_rows: RefCell<Vec<PathBuf>>,
    has_parts: Cell<bool>,
    kept: Cell<usize>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JournalLifetime {
    Run,
    /// Journal that is not removed, because it contains a part that will be merged.
    Persistent,
}

#[derive(Clone, Copy, Debug)]
pub struct JournalNumber(usize);

impl Journals {
    /// Opens the journal of a study, if the run uses journals.
    ///
    /// # Errors
    /// Fails if an existing file cannot be read, or cannot be removed for a new start.
    pub fn open(
        &self,
        path: PathBuf,
        (wish, lasting): (JournalPreference, JournalLifetime),
    ) -> Result<Option<JournalNumber>, ScriptError> {
        if wish == JournalPreference::None {
            return Ok(None);
        }
        let mut journal = Journal::open(path).map_err(refused)?;
        if wish == JournalPreference::Restart {
            journal.clear().map_err(refused)?;
        }
        if lasting == JournalLifetime::Persistent {
            journal.begin().map_err(refused)?;
            self.has_parts.set(true);
        }
        Ok(Some(self.store(journal, lasting)))
    }

    pub fn open_parts(
        &self,
        paths: impl IntoIterator<Item = PathBuf>,
    ) -> Result<JournalNumber, ScriptError> {
        Ok(self.store(Journal::of_files(paths).map_err(refused)?, JournalLifetime::Persistent))
    }

    fn store(&self, journal: Journal, lasting: JournalLifetime) -> JournalNumber {
        let mut open = self.open.borrow_mut();
        open.push((journal, lasting));
        JournalNumber(open.len() - 1)
    }

    /// Result of the case with the given fingerprint in a journal; `None` if there is none.
    pub fn find<T: DeserializeOwned>(&self, journal: JournalNumber, fingerprint: u64) -> Option<T> {
        let found = self.open.borrow().get(journal.0)?.0.find(fingerprint);
        self.kept.set(self.kept.get() + usize::from(found.is_some()));
        found
    }

    pub fn write<T: Serialize>(
        &self,
        journal: JournalNumber,
        fingerprint: u64,
        result: &T,
    ) -> Result<u64, ScriptError> {
        let mut open = self.open.borrow_mut();
        let Some((journal, _)) = open.get_mut(journal.0) else { return Ok(0) };
        let bytes = journal.write(fingerprint, result).map_err(refused)?;
        self.kept.set(self.kept.get() + 1);
        Ok(bytes)
    }

    /// Opens the journal of a sweep, if the run uses journals. `about` identifies the sweep.
    /// `recall` receives the entries of an existing journal of the same sweep.
    pub fn open_rows(
        &self,
        path: PathBuf,
        (wish, lasting): (JournalPreference, JournalLifetime),
        about: RowEntry,
        mut recall: impl FnMut(RowEntry),
    ) -> Result<Option<RowKeeper>, ScriptError> {
        let (mut is_same, mut known) = (false, 0);
        let whole = match wish {
            JournalPreference::None => return Ok(None),
            JournalPreference::Restart => 0,
            JournalPreference::Resume => read_rows::<io::Error>(&path, |entry| {
                is_same = is_same || entry == about;
                if is_same {
                    known +=
                        usize::from(matches!(entry, RowEntry::Computed(..) | RowEntry::Failed(..)));
                    recall(entry);
                }
                Ok(())
            })
            .map_err(|error| refused_rows(&path, &error))?,
        };
        let whole = if is_same { whole } else { 0 };
        let opened = RowJournal::append(&path, whole);
        let journal = opened.map_err(|error| refused_rows(&path, &error))?;
        match lasting {
            JournalLifetime::Run => self.of_rows.borrow_mut().push(path.clone()),
            JournalLifetime::Persistent => self.has_parts.set(true),
        }
        self.kept.set(self.kept.get() + known);
        let mut keeper = RowKeeper { path, journal };
        if !is_same {
            keeper.append(&about)?;
        }
        Ok(Some(keeper))
    }

    pub fn stored_cases(&self) -> usize {
        self.kept.get()
    }

    pub fn finish(&self) -> Result<(), ScriptError> {
        if !self.has_parts.get() {
            self.kept.set(0);
        }
        for path in self.of_rows.take() {
            remove_rows(&path).map_err(|error| refused_rows(&path, &error))?;
        }
        let ended = self.open.take().into_iter();
        let mut ended = ended.filter(|(_, lasting)| *lasting == JournalLifetime::Run);
        ended.try_for_each(|(journal, _)| journal.finish()).map_err(refused)
    }
}

#[derive(Debug)]
pub struct RowKeeper {
    path: PathBuf,
    journal: RowJournal,
}

impl RowKeeper {
    pub fn write(&mut self, journals: &Journals, entry: &RowEntry) -> Result<u64, ScriptError> {
        if matches!(entry, RowEntry::Computed(..) | RowEntry::Failed(..)) {
            journals.kept.set(journals.kept.get() + 1);
        }
        self.append(entry)
    }

    fn append(&mut self, entry: &RowEntry) -> Result<u64, ScriptError> {
        self.journal.write(entry).map_err(|error| refused_rows(&self.path, &error))
    }

    pub fn sync_periodically(&mut self) -> Result<(), ScriptError> {
        self.journal.flush_periodically().map_err(|error| refused_rows(&self.path, &error))
    }

    pub fn flush(&mut self) -> Result<(), ScriptError> {
        self.journal.flush().map_err(|error| refused_rows(&self.path, &error))
    }
}

fn refused_rows(path: &Path, error: &io::Error) -> ScriptError {
    ScriptError::new(format!(
        "the journal '{}' of the sweep cannot be written: {error}",
        path.display()
    ))
    .hint("choose another folder with --out DIR, or start again with --fresh")
}

fn refused(error: JournalError) -> ScriptError {
    ScriptError::new(error.to_string())
        .hint("choose another folder with --out DIR, or start again with --fresh")
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn journals_exist_until_the_script_ends() {
        let home = tempfile::tempdir().unwrap();
        let path = |name: &str| home.path().join(format!("{name}.journal"));
        let begin = |wish| {
            let journals = Journals::default();
            let numbers = ["a", "b"]
                .map(|name| journals.open(path(name), (wish, JournalLifetime::Run)).unwrap());
            (journals, numbers)
        };
        let (first, [a, b]) = begin(JournalPreference::Resume);
        let bytes = first.write(a.unwrap(), 1, &0.5).unwrap();
        assert_eq!(bytes, std::fs::metadata(path("a")).unwrap().len());
        first.write(b.unwrap(), 1, &0.25).unwrap();
        assert_eq!(first.stored_cases(), 2);
        drop(first);

        let (second, [a, b]) = begin(JournalPreference::Resume);
        assert_eq!(second.stored_cases(), 0, "nothing of it is known to be of use yet");
        assert_eq!(second.find::<f64>(a.unwrap(), 1), Some(0.5));
        assert_eq!(second.find::<f64>(b.unwrap(), 1), Some(0.25));
        assert_eq!(second.find::<f64>(b.unwrap(), 2), None);
        assert_eq!(second.stored_cases(), 2);
        second.finish().unwrap();
        assert!(!path("a").exists() && !path("b").exists() && second.stored_cases() == 0);

        let (third, [a, _]) = begin(JournalPreference::Restart);
        assert_eq!(third.find::<f64>(a.unwrap(), 1), None);
        assert!(begin(JournalPreference::None).1.iter().all(Option::is_none));
    }
}

//! The journals of the studies of a run. They stay until the whole script has come to its end: one that is interrupted, or wrong
//! behind its first study, does not repeat what that found.

use std::cell::{Cell, RefCell};
use std::path::PathBuf;

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::settings::JournalWish;
use crate::analysis::{Journal, JournalError};
use crate::script::words::error::ScriptError;

/// The journals of a run: what is kept of its studies.
#[derive(Default)]
pub struct Journals {
    open: RefCell<Vec<Journal>>,
    /// Cases that were found in them or written into them.
    kept: Cell<usize>,
}

/// The number of one of the journals of a run.
#[derive(Clone, Copy, Debug)]
pub struct JournalNumber(usize);

impl Journals {
    /// Opens the journal of a study as the run wants it, if it wants one.
    ///
    /// # Errors
    /// When there is a file that cannot be read, or removed where the study begins anew.
    pub fn open(
        &self,
        path: PathBuf,
        wish: JournalWish,
    ) -> Result<Option<JournalNumber>, ScriptError> {
        if wish == JournalWish::Without {
            return Ok(None);
        }
        let mut journal = Journal::open(path).map_err(refused)?;
        if wish == JournalWish::Anew {
            journal.clear().map_err(refused)?;
        }
        let mut open = self.open.borrow_mut();
        open.push(journal);
        Ok(Some(JournalNumber(open.len() - 1)))
    }

    /// The result of a case that a journal knows, by the case's fingerprint.
    pub fn find<T: DeserializeOwned>(&self, journal: JournalNumber, fingerprint: u64) -> Option<T> {
        let found = self.open.borrow().get(journal.0)?.find(fingerprint);
        self.kept.set(self.kept.get() + usize::from(found.is_some()));
        found
    }

    /// Writes down in a journal what was found of a case; gives the bytes that this takes.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write<T: Serialize>(
        &self,
        journal: JournalNumber,
        fingerprint: u64,
        result: &T,
    ) -> Result<u64, ScriptError> {
        let mut open = self.open.borrow_mut();
        let Some(journal) = open.get_mut(journal.0) else { return Ok(0) };
        let bytes = journal.write(fingerprint, result).map_err(refused)?;
        self.kept.set(self.kept.get() + 1);
        Ok(bytes)
    }

    /// How many finished cases of this run are kept for the next one.
    pub fn kept(&self) -> usize {
        self.kept.get()
    }

    /// Removes the journals of a script that has come to its end: there is nothing to go on with.
    ///
    /// # Errors
    /// When a file cannot be removed.
    pub fn finish(&self) -> Result<(), ScriptError> {
        self.kept.set(0);
        self.open.take().into_iter().try_for_each(Journal::finish).map_err(refused)
    }
}

fn refused(error: JournalError) -> ScriptError {
    ScriptError::new(error.to_string())
        .hint("choose another folder with --out DIR, or begin anew with --fresh")
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn journals_outlast_their_studies_and_end_with_the_script() {
        let home = tempfile::tempdir().unwrap();
        let path = |name: &str| home.path().join(format!("{name}.journal"));
        let begin = |wish| {
            let journals = Journals::default();
            let numbers = ["a", "b"].map(|name| journals.open(path(name), wish).unwrap());
            (journals, numbers)
        };
        let (first, [a, b]) = begin(JournalWish::GoOn);
        let bytes = first.write(a.unwrap(), 1, &0.5).unwrap();
        assert_eq!(bytes, std::fs::metadata(path("a")).unwrap().len());
        first.write(b.unwrap(), 1, &0.25).unwrap();
        assert_eq!(first.kept(), 2);
        drop(first);

        let (second, [a, b]) = begin(JournalWish::GoOn);
        assert_eq!(second.kept(), 0, "nothing of it is known to be of use yet");
        assert_eq!(second.find::<f64>(a.unwrap(), 1), Some(0.5));
        assert_eq!(second.find::<f64>(b.unwrap(), 1), Some(0.25));
        assert_eq!(second.find::<f64>(b.unwrap(), 2), None);
        assert_eq!(second.kept(), 2);
        second.finish().unwrap();
        assert!(!path("a").exists() && !path("b").exists() && second.kept() == 0);

        let (third, [a, _]) = begin(JournalWish::Anew);
        assert_eq!(third.find::<f64>(a.unwrap(), 1), None);
        assert!(begin(JournalWish::Without).1.iter().all(Option::is_none));
    }
}

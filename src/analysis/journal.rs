//! Journals: files with the results of completed cases, from which an interrupted study resumes.
//!
//! A journal consists of records, each with its length and a checksum. Reading ends at a record that a crash left incomplete.

use std::collections::BTreeMap;
use std::fs::File;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::sandbox_fs::{FileChecksum, Folder};

/// Maximum length of a record [bytes]. A longer record counts as damaged.
const LONGEST: usize = 1 << 30;

/// Maximum length of a journal [bytes].
const LARGEST: u64 = 1 << 32;

const FORMAT: u32 = 1;

type Build = (&'static str, Option<(u64, u32)>);

fn build() -> Build {
    static BUILD: OnceLock<Build> = OnceLock::new();
    *BUILD.get_or_init(|| {
        let file = || {
            let file = File::open(std::env::current_exe().ok()?).ok()?;
            let file_checksum = FileChecksum::of(file).ok()?;
            Some((file_checksum.length, file_checksum.checksum))
        };
        (env!("CARGO_PKG_VERSION"), file())
    })
}

/// Error of reading or writing a journal.
#[derive(Debug, thiserror::Error)]
#[error("the journal '{}' of the study cannot be {action}: {source}", path.display())]
pub struct JournalError {
    path: PathBuf,
    action: &'static str,
    source: io::Error,
}

/// Results of completed cases of a study, from this run and from earlier, interrupted runs.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    known: BTreeMap<u64, Vec<u8>>,
    file: Option<File>,
}

impl Journal {
    /// Opens a journal. A missing file is created with the first record.
    ///
    /// # Errors
    /// Fails if an existing file cannot be read.
    pub fn open(path: impl Into<PathBuf>) -> Result<Self, JournalError> {
        let path = path.into();
        let read = |(folder, name): (Folder, PathBuf)| folder.read(&name, LARGEST);
        let bytes = match found(&path).and_then(read) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == io::ErrorKind::NotFound => Vec::new(),
            Err(source) => return Err(JournalError { path, action: "read", source }),
        };
        let mut rest = bytes.as_slice();
        let known = std::iter::from_fn(|| {
            let (record, behind) = next_record(rest)?;
            rest = behind;
            postcard::from_bytes::<(u64, Vec<u8>)>(record).ok()
        });
        Ok(Self { known: known.collect(), path, file: None })
    }

    /// Combines several journals to one that has no file and can only be read.
    ///
    /// # Errors
    /// Fails if one of the files cannot be read.
    pub fn of_files(paths: impl IntoIterator<Item = PathBuf>) -> Result<Self, JournalError> {
        let mut known = BTreeMap::new();
        for path in paths {
            known.extend(Self::open(path)?.known);
        }
        Ok(Self { path: PathBuf::new(), known, file: None })
    }

    /// Deletes the file with the results of earlier runs.
    ///
    /// # Errors
    /// Fails if the file cannot be removed.
    pub fn clear(&mut self) -> Result<(), JournalError> {
        self.known.clear();
        self.file = None;
        remove(&self.path)
    }

    /// Number of cases.
    pub fn len(&self) -> usize {
        self.known.len()
    }

    /// Returns true if the journal contains no results.
    pub fn is_empty(&self) -> bool {
        self.known.is_empty()
    }

    /// Result of the case with the given fingerprint; `None` if the journal has no result of type `T` for it.
    pub fn find<T: DeserializeOwned>(&self, fingerprint: u64) -> Option<T> {
        postcard::from_bytes(self.known.get(&fingerprint)?).ok()
    }

    /// Appends the result of a case to the file. Returns the number of bytes written.
    ///
    /// # Errors
    /// Fails if writing fails.
    pub fn write<T: Serialize>(
        &mut self,
        fingerprint: u64,
        result: &T,
    ) -> Result<u64, JournalError> {
        let path = self.path.clone();
        let cannot = |source| JournalError { path, action: "written", source };
        let Ok(result) = postcard::to_stdvec(result) else {
            return Err(cannot(io::Error::other("the result cannot be stored in a file")));
        };
        let bytes = self.append(fingerprint, &result).map_err(cannot)?;
        self.known.insert(fingerprint, result);
        Ok(bytes)
    }

    /// Creates the file of the journal, which shows that the study has been started.
    ///
    /// # Errors
    /// Fails if writing fails.
    pub fn begin(&mut self) -> Result<(), JournalError> {
        let path = self.path.clone();
        let begun = self.begin_file().map(drop);
        begun.map_err(|source| JournalError { path, action: "written", source })
    }

    fn begin_file(&mut self) -> io::Result<u64> {
        let mut bytes = 0;
        if self.file.is_none() {
            // The file is rewritten without its incomplete record, because records after it would be unreadable.
            let known = self.known.iter().map(|(other, result)| record(*other, result));
            let known = known.collect::<io::Result<Vec<_>>>()?.concat();
            let (folder, name) = self.place()?;
            // The new file gets its final name only when it is complete, so that nothing is lost if the program is killed.
            let anew = name.with_extension("journal.new");
            match folder.remove(&anew) {
                Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
                _ => (),
            }
            let mut file = folder.create(&anew)?;
            file.write_all(&known)?;
            bytes += known.len() as u64;
            file.sync_all()?;
            folder.replace(&anew, &name)?;
            self.file = Some(file);
        }
        Ok(bytes)
    }

    fn append(&mut self, fingerprint: u64, result: &[u8]) -> io::Result<u64> {
        let mut bytes = self.begin_file()?;
        if let Some(file) = &mut self.file {
            let record = record(fingerprint, result)?;
            file.write_all(&record)?;
            bytes += record.len() as u64;
        }
        Ok(bytes)
    }

    fn place(&self) -> io::Result<(Folder, PathBuf)> {
        let name = self.path.file_name().ok_or(io::ErrorKind::InvalidInput)?;
        Ok((Folder::open_or_create(self.path.parent().unwrap_or(Path::new(".")))?, name.into()))
    }

    /// Deletes the file of the journal at the end of a study.
    ///
    /// # Errors
    /// Fails if the file cannot be removed.
    pub fn finish(self) -> Result<(), JournalError> {
        drop(self.file);
        remove(&self.path)
    }

    /// Hash of all data on which the result of a case depends, including the program itself.
    pub fn fingerprint(parts: &[&[u8]]) -> u64 {
        let mut hasher = DefaultHasher::new();
        (FORMAT, build()).hash(&mut hasher);
        parts.hash(&mut hasher);
        hasher.finish()
    }
}

fn found(path: &Path) -> io::Result<(Folder, PathBuf)> {
    let name = path.file_name().ok_or(io::ErrorKind::InvalidInput)?;
    Ok((Folder::find(path.parent().unwrap_or(Path::new(".")))?, name.into()))
}

fn remove(path: &Path) -> Result<(), JournalError> {
    match found(path).and_then(|(folder, name)| folder.remove(&name)) {
        Err(source) if source.kind() != io::ErrorKind::NotFound => {
            Err(JournalError { path: path.to_owned(), action: "removed", source })
        }
        _ => Ok(()),
    }
}

fn record(fingerprint: u64, result: &[u8]) -> io::Result<Vec<u8>> {
    let payload = postcard::to_stdvec(&(fingerprint, result)).map_err(io::Error::other)?;
    let length = u32::try_from(payload.len()).map_err(io::Error::other)?;
    let checksum = crc32fast::hash(&payload);
    Ok([&length.to_le_bytes(), &checksum.to_le_bytes(), payload.as_slice()].concat())
}

fn next_record(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let (length, rest) = bytes.split_first_chunk()?;
    let (checksum, rest) = rest.split_first_chunk()?;
    let length = usize::try_from(u32::from_le_bytes(*length)).ok().filter(|it| *it <= LONGEST)?;
    let (payload, rest) = rest.split_at_checked(length)?;
    (crc32fast::hash(payload) == u32::from_le_bytes(*checksum)).then_some((payload, rest))
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    fn written(path: &Path, cases: std::ops::Range<u64>) {
        let mut journal = Journal::open(path).unwrap();
        for case in cases {
            journal.write(case, &(case as f64 / 3.0, f64::NAN, format!("case {case}"))).unwrap();
        }
    }

    fn found_cases(path: &Path) -> Vec<u64> {
        let journal = Journal::open(path).unwrap();
        let known = |case: &u64| {
            let result: Option<(f64, f64, String)> = journal.find(*case);
            assert!(
                result.iter().all(|(third, nan, _)| *third == *case as f64 / 3.0 && nan.is_nan())
            );
            result.is_some()
        };
        (0..20).filter(known).collect()
    }

    #[test]
    fn reopened_journal_continues_and_finished_journal_is_deleted() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("new").join("study.journal");
        assert!(Journal::open(&path).unwrap().is_empty());
        assert!(!path.exists(), "a journal without records needs no file");
        written(&path, 0..3);
        written(&path, 3..5);
        assert_eq!(found_cases(&path), [0, 1, 2, 3, 4]);
        assert_eq!(Journal::open(&path).unwrap().find::<Vec<String>>(7), None);
        let mut journal = Journal::open(&path).unwrap();
        journal.clear().unwrap();
        assert!(found_cases(&path).is_empty());
        written(&path, 8..9);
        Journal::open(&path).unwrap().finish().unwrap();
        assert!(!path.exists());
    }

    #[test]
    fn damaged_journal_keeps_the_records_before_the_damage() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("study.journal");
        written(&path, 0..4);
        let whole = fs::read(&path).unwrap();
        for at in 0..whole.len() {
            fs::write(&path, &whole[..at]).unwrap();
            let kept = found_cases(&path).len();
            assert_eq!(kept as u64, found_cases(&path).last().map_or(0, |last| last + 1));
            assert!(kept < 4, "{at}");
            let mut damaged = whole.clone();
            damaged[at] ^= 4;
            fs::write(&path, &damaged).unwrap();
            assert!(found_cases(&path).len() < 4, "{at}");
            written(&path, 10..11);
            assert_eq!(found_cases(&path).last(), Some(&10));
        }
    }

    #[test]
    fn failed_rewrite_of_a_journal_keeps_all_records() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("study.journal");
        written(&path, 0..3);
        let anew = home.path().join("study.journal.new");
        fs::create_dir(&anew).unwrap();
        let mut journal = Journal::open(&path).unwrap();
        assert!(journal.write(3, &0.0).unwrap_err().to_string().contains("cannot be written"));
        assert_eq!(found_cases(&path), [0, 1, 2]);
        fs::remove_dir(&anew).unwrap();
        fs::write(&anew, b"half").unwrap();
        written(&path, 3..5);
        assert_eq!(found_cases(&path), [0, 1, 2, 3, 4]);
        assert!(!anew.exists());
    }

    #[cfg(unix)]
    #[test]
    fn symlinked_journals_and_journal_folders_are_rejected() {
        use std::os::unix::fs::symlink;
        let home = tempfile::tempdir().unwrap();
        let theirs = home.path().join("theirs");
        fs::create_dir(&theirs).unwrap();
        written(&theirs.join("study.journal"), 0..3);
        symlink(&theirs, home.path().join("out")).unwrap();
        assert!(Journal::open(home.path().join("out/study.journal")).is_err());
        let own = home.path().join("own.journal");
        symlink(theirs.join("study.journal"), &own).unwrap();
        assert!(Journal::open(&own).is_err());
        assert!(remove(&home.path().join("out/study.journal")).is_err());
        assert_eq!(found_cases(&theirs.join("study.journal")), [0, 1, 2]);
    }

    #[test]
    fn build_is_identified_by_the_program_file() {
        assert!(build().1.is_some_and(|(length, _)| length > 0));
        assert_eq!(build(), build());
    }

    #[test]
    fn fingerprint_depends_on_the_division_into_parts() {
        let of = Journal::fingerprint;
        assert_eq!(of(&[b"ab", b"c"]), of(&[b"ab", b"c"]));
        assert_ne!(of(&[b"ab", b"c"]), of(&[b"a", b"bc"]));
    }
}

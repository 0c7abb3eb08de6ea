//! Workbook: folder of a student with the start files, the attempts and the progress file.

use std::fs;
use std::path::{Path, PathBuf};

use super::attempt::LARGEST;
use super::catalogue::EXERCISES;
use super::error::ExerciseError;
use super::exercise::Exercise;
use super::progress::{self, StudentProgress};
use crate::output::write_atomic;
use crate::sandbox_fs::read_file;

pub const FOLDER: &str = "withy-exercises";

/// Folder with one file per exercise. Attempts are never overwritten.
#[derive(Debug)]
pub struct Workbook {
    folder: PathBuf,
}

#[derive(Debug, PartialEq, Eq)]
pub enum Advice {
    Hint { text: String, number: usize, count: usize },
    Solution(&'static str),
}

impl Workbook {
    /// The nearest workbook among `here` and its parent folders, otherwise a new subfolder of `here`.
    pub fn near(here: &Path) -> Self {
        // A path that cannot be resolved is used as given; the error is reported when the folder is read.
        let real = here.canonicalize().unwrap_or_else(|_| here.into());
        let is_workbook = |folder: &&Path| folder.join(progress::FILE).exists();
        match real.ancestors().find(is_workbook) {
            Some(folder) if folder == real => Self { folder: here.into() },
            Some(folder) => Self { folder: folder.into() },
            None => Self { folder: here.join(FOLDER) },
        }
    }

    pub fn fill(&self) -> Result<usize, ExerciseError> {
        let missing: Vec<_> =
            EXERCISES.iter().filter(|exercise| !self.file(exercise).exists()).collect();
        for exercise in &missing {
            write_atomic(self.file(exercise), exercise.start.as_bytes())?;
        }
        if !self.folder.join(progress::FILE).exists() {
            StudentProgress::default().write(&self.folder)?;
        }
        Ok(missing.len())
    }

    pub fn folder(&self) -> &Path {
        &self.folder
    }

    pub fn file(&self, exercise: &Exercise) -> PathBuf {
        self.folder.join(exercise.track).join(format!("{}.rhai", exercise.name))
    }

    pub fn is_begun(&self, exercise: &Exercise) -> bool {
        read_file(&self.file(exercise), LARGEST).is_ok_and(|text| text != exercise.start.as_bytes())
    }

    pub fn progress(&self) -> Result<StudentProgress, ExerciseError> {
        StudentProgress::read(&self.folder)
    }

    /// Returns the first exercise that has not been passed; `None` if all exercises have been passed.
    pub fn next(&self) -> Result<Option<&'static Exercise>, ExerciseError> {
        let progress = self.progress()?;
        Ok(EXERCISES.iter().find(|exercise| !progress.has_passed(exercise)))
    }

    pub fn record(&self, exercise: &Exercise, passed: bool) -> Result<(), ExerciseError> {
        self.change(|progress| progress.record(exercise, passed))
    }

    pub fn hint(&self, exercise: &Exercise) -> Result<Advice, ExerciseError> {
        let given = self.progress()?.hints(exercise);
        let hints = exercise.judge().hints;
        let Some(text) = hints.get(given).cloned() else {
            return Ok(Advice::Solution(exercise.solution));
        };
        self.change(|progress| progress.record_hint(exercise))?;
        Ok(Advice::Hint { text, number: given + 1, count: hints.len() })
    }

    /// Restores the start file of an exercise, and returns the path under which the attempt is kept.
    ///
    /// # Errors
    /// Fails if a file cannot be renamed or written; the attempt is not lost.
    pub fn reset(&self, exercise: &Exercise) -> Result<PathBuf, ExerciseError> {
        let file = self.file(exercise);
        let kept = free_name(&file);
        fs::rename(&file, &kept).map_err(|source| ExerciseError::Keep {
            from: file.clone(),
            to: kept.clone(),
            source,
        })?;
        write_atomic(&file, exercise.start.as_bytes())?;
        self.change(|progress| progress.remove(exercise))?;
        Ok(kept)
    }

    /// Changes the progress file. It is read again before each change, because another process may have changed it.
    fn change(&self, change: impl FnOnce(&mut StudentProgress)) -> Result<(), ExerciseError> {
        let before = self.progress()?;
        let mut progress = before.clone();
        change(&mut progress);
        if progress == before { Ok(()) } else { progress.write(&self.folder) }
    }
}

fn free_name(file: &Path) -> PathBuf {
    let numbered = |number: usize| match number {
        1 => file.with_extension("old"),
        _ => file.with_extension(format!("old{number}")),
    };
    let mut number = 1;
    while numbered(number).exists() {
        number += 1;
    }
    numbered(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn workbook() -> (tempfile::TempDir, Workbook) {
        let folder = tempfile::tempdir().unwrap();
        let workbook = Workbook::near(folder.path());
        workbook.fill().unwrap();
        (folder, workbook)
    }

    #[test]
    fn workbook_is_found_from_its_parent_and_from_itself() {
        let (folder, workbook) = workbook();
        assert_eq!(workbook.folder(), folder.path().join(FOLDER));
        assert_eq!(Workbook::near(workbook.folder()).folder(), workbook.folder());
    }

    #[test]
    fn filling_a_workbook_writes_only_missing_files() {
        let (_folder, workbook) = workbook();
        let file = workbook.file(&EXERCISES[0]);
        fs::write(&file, "mine").unwrap();
        fs::remove_file(workbook.file(&EXERCISES[1])).unwrap();
        assert_eq!(workbook.fill().unwrap(), 1);
        assert_eq!(fs::read_to_string(file).unwrap(), "mine");
    }

    #[test]
    fn progress_is_stored_and_updated_by_the_last_check() {
        let (_folder, workbook) = workbook();
        assert_eq!(workbook.next().unwrap(), Some(&EXERCISES[0]));
        workbook.record(&EXERCISES[0], true).unwrap();
        let again = Workbook::near(workbook.folder());
        assert_eq!(again.next().unwrap(), Some(&EXERCISES[1]));
        again.record(&EXERCISES[0], false).unwrap();
        assert_eq!(workbook.next().unwrap(), Some(&EXERCISES[0]));
    }

    #[test]
    fn hints_are_given_in_order_followed_by_the_solution() {
        let (_folder, workbook) = workbook();
        let hints = EXERCISES[0].judge().hints;
        for (index, hint) in hints.iter().enumerate() {
            let (number, count) = (index + 1, hints.len());
            let expected = Advice::Hint { text: hint.clone(), number, count };
            assert_eq!(workbook.hint(&EXERCISES[0]).unwrap(), expected);
        }
        let last = workbook.hint(&EXERCISES[0]).unwrap();
        assert_eq!(last, Advice::Solution(EXERCISES[0].solution));
    }

    #[test]
    fn reset_keeps_a_copy_of_each_attempt() {
        let (_folder, workbook) = workbook();
        let file = workbook.file(&EXERCISES[0]);
        for attempt in ["first", "second"] {
            fs::write(&file, attempt).unwrap();
            workbook.record(&EXERCISES[0], true).unwrap();
            let kept = workbook.reset(&EXERCISES[0]).unwrap();
            assert_eq!(fs::read_to_string(kept).unwrap(), attempt);
            assert_eq!(fs::read_to_string(&file).unwrap(), EXERCISES[0].start);
            assert!(!workbook.progress().unwrap().has_passed(&EXERCISES[0]));
        }
    }

    #[test]
    fn damaged_progress_file_is_reported_and_not_overwritten() {
        let (_folder, workbook) = workbook();
        let file = workbook.folder().join(progress::FILE);
        fs::write(&file, "{ half").unwrap();
        let message = workbook.record(&EXERCISES[0], true).unwrap_err().to_string();
        assert!(
            message.contains("is damaged") && message.contains("your attempts are kept"),
            "{message}"
        );
        assert_eq!(fs::read_to_string(&file).unwrap(), "{ half");
    }
}

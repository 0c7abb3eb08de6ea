//! Progress of a student: the passed exercises and the number of given hints, stored in a small file.

use std::collections::{BTreeMap, BTreeSet};
use std::io::ErrorKind;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::error::ExerciseError;
use super::exercise::Exercise;
use crate::output::write_atomic;
use crate::sandbox_fs::read_text;

/// Maximum size of the progress file [bytes].
const LARGEST: u64 = 1 << 20;

pub const FILE: &str = "withy-progress.json";

/// Progress of a student, including entries for exercises that this version of the program does not have.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StudentProgress {
    passed: BTreeSet<String>,
    hints: BTreeMap<String, usize>,
}

impl StudentProgress {
    /// Reads the progress from a student's folder; it is empty if there is no progress file.
    pub fn read(folder: &Path) -> Result<Self, ExerciseError> {
        let path = folder.join(FILE);
        let text = match read_text(&path, LARGEST) {
            Ok(text) => text,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Self::default()),
            Err(source) => return Err(ExerciseError::Read { path, source }),
        };
        serde_json::from_str(&text).map_err(|why| ExerciseError::Progress { path, why })
    }

    /// Writes the progress to a student's folder.
    ///
    /// # Errors
    /// Fails if the file cannot be written; the old file is then unchanged.
    pub fn write(&self, folder: &Path) -> Result<(), ExerciseError> {
        let text = format!("{:#}\n", serde_json::json!(self));
        Ok(write_atomic(folder.join(FILE), text.as_bytes())?)
    }

    pub fn has_passed(&self, exercise: &Exercise) -> bool {
        self.passed.contains(&exercise.id())
    }

    pub fn record(&mut self, exercise: &Exercise, passed: bool) {
        match passed {
            true => self.passed.insert(exercise.id()),
            false => self.passed.remove(&exercise.id()),
        };
    }

    pub fn hints(&self, exercise: &Exercise) -> usize {
        self.hints.get(&exercise.id()).copied().unwrap_or(0)
    }

    pub fn record_hint(&mut self, exercise: &Exercise) {
        *self.hints.entry(exercise.id()).or_default() += 1;
    }

    pub fn remove(&mut self, exercise: &Exercise) {
        self.passed.remove(&exercise.id());
        self.hints.remove(&exercise.id());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exercises::catalogue::EXERCISES;
    use std::fs;

    #[test]
    fn progress_of_unknown_exercises_is_kept() {
        let folder = tempfile::tempdir().unwrap();
        let text = r#"{ "passed": ["beams/of_tomorrow"], "hints": { "beams/of_tomorrow": 2 } }"#;
        fs::write(folder.path().join(FILE), text).unwrap();
        let mut progress = StudentProgress::read(folder.path()).unwrap();
        progress.record(&EXERCISES[0], true);
        progress.write(folder.path()).unwrap();
        let text = fs::read_to_string(folder.path().join(FILE)).unwrap();
        let kept: serde_json::Value = serde_json::from_str(&text).unwrap();
        let passed = serde_json::json!([EXERCISES[0].id(), "beams/of_tomorrow"]);
        let expected = serde_json::json!({ "passed": passed, "hints": { "beams/of_tomorrow": 2 } });
        assert_eq!(kept, expected);
    }

    #[test]
    fn removing_an_exercise_deletes_its_progress_and_hints() {
        let mut progress = StudentProgress::default();
        progress.record(&EXERCISES[0], true);
        progress.record_hint(&EXERCISES[0]);
        assert_eq!((progress.has_passed(&EXERCISES[0]), progress.hints(&EXERCISES[0])), (true, 1));
        progress.remove(&EXERCISES[0]);
        assert_eq!(progress, StudentProgress::default());
    }
}

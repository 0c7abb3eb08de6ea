//! What a student has passed and which hints were given, in a small file that is written whole or not at all.

use std::collections::{BTreeMap, BTreeSet};
use std::io::ErrorKind;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::error::ExerciseError;
use super::exercise::Exercise;
use crate::output::write_whole;
use crate::sandbox_fs::read_text;

/// The largest file of a progress [bytes].
const LARGEST: u64 = 1 << 20;

/// The name of the file of the progress, by which the folder of a student is known.
pub const FILE: &str = "withy-progress.json";

/// How far a student has come. Exercises that this program does not know are kept: another version may.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StudentProgress {
    /// The exercises that the last check of them passed.
    passed: BTreeSet<String>,
    /// How many hints were given.
    hints: BTreeMap<String, usize>,
}

impl StudentProgress {
    /// Reads the progress of a student's folder; it is empty where there is no file.
    ///
    /// # Errors
    /// When the file cannot be read, or was damaged.
    pub fn read(folder: &Path) -> Result<Self, ExerciseError> {
        let path = folder.join(FILE);
        let text = match read_text(&path, LARGEST) {
            Ok(text) => text,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Self::default()),
            Err(source) => return Err(ExerciseError::Read { path, source }),
        };
        serde_json::from_str(&text).map_err(|why| ExerciseError::Progress { path, why })
    }

    /// Writes the progress into the file of a student's folder.
    ///
    /// # Errors
    /// When it cannot be written; the old one is still there then.
    pub fn write(&self, folder: &Path) -> Result<(), ExerciseError> {
        let text = format!("{:#}\n", serde_json::json!(self));
        Ok(write_whole(folder.join(FILE), text.as_bytes())?)
    }

    /// Whether the last check of an exercise passed.
    pub fn has_passed(&self, exercise: &Exercise) -> bool {
        self.passed.contains(&exercise.id())
    }

    /// Notes what the last check of an exercise said.
    pub fn note(&mut self, exercise: &Exercise, passed: bool) {
        match passed {
            true => self.passed.insert(exercise.id()),
            false => self.passed.remove(&exercise.id()),
        };
    }

    /// How many hints were given for an exercise.
    pub fn hints(&self, exercise: &Exercise) -> usize {
        self.hints.get(&exercise.id()).copied().unwrap_or(0)
    }

    /// Notes that one more hint was given for an exercise.
    pub fn note_hint(&mut self, exercise: &Exercise) {
        *self.hints.entry(exercise.id()).or_default() += 1;
    }

    /// Forgets the progress in an exercise.
    pub fn forget(&mut self, exercise: &Exercise) {
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
    fn exercises_of_another_version_are_kept() {
        let folder = tempfile::tempdir().unwrap();
        let text = r#"{ "passed": ["beams/of_tomorrow"], "hints": { "beams/of_tomorrow": 2 } }"#;
        fs::write(folder.path().join(FILE), text).unwrap();
        let mut progress = StudentProgress::read(folder.path()).unwrap();
        progress.note(&EXERCISES[0], true);
        progress.write(folder.path()).unwrap();
        let text = fs::read_to_string(folder.path().join(FILE)).unwrap();
        let kept: serde_json::Value = serde_json::from_str(&text).unwrap();
        let passed = serde_json::json!([EXERCISES[0].id(), "beams/of_tomorrow"]);
        let expected = serde_json::json!({ "passed": passed, "hints": { "beams/of_tomorrow": 2 } });
        assert_eq!(kept, expected);
    }

    #[test]
    fn what_is_forgotten_has_neither_passed_nor_had_hints() {
        let mut progress = StudentProgress::default();
        progress.note(&EXERCISES[0], true);
        progress.note_hint(&EXERCISES[0]);
        assert_eq!((progress.has_passed(&EXERCISES[0]), progress.hints(&EXERCISES[0])), (true, 1));
        progress.forget(&EXERCISES[0]);
        assert_eq!(progress, StudentProgress::default());
    }
}

//! Folders with the attempts of the students of a class.

use std::fs;
use std::path::{Path, PathBuf};

use super::catalogue::{EXERCISES, TRACKS};
use super::error::ExerciseError;
use super::exercise::Exercise;
use super::workbook;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Submission {
    pub student: String,
    pub folder: PathBuf,
}

impl Submission {
    /// Returns the submissions in a folder, sorted by name: its subfolders that are not hidden, or the folder itself if it contains attempts.
    ///
    /// # Errors
    /// Fails if the folder cannot be read, or if it contains nothing to grade.
    pub fn all_in(folder: &Path) -> Result<Vec<Self>, ExerciseError> {
        let unreadable = |source| ExerciseError::Read { path: folder.into(), source };
        let own = Self::new(folder);
        if own.contains_attempts() {
            return Ok(vec![own]);
        }
        let mut all = Vec::new();
        for entry in fs::read_dir(folder).map_err(unreadable)? {
            let path = entry.map_err(unreadable)?.path();
            let is_hidden =
                path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'));
            if path.is_dir() && !is_hidden {
                let student = entry_name(&path);
                all.push(Self { student, folder: path });
            }
        }
        all.sort_by(|a, b| a.student.cmp(&b.student));
        match all.is_empty() {
            true => {
                Err(ExerciseError::NoSubmissions { path: folder.into(), track: TRACKS[0].name })
            }
            false => Ok(all),
        }
    }

    fn new(folder: &Path) -> Self {
        // A path that cannot be resolved is used as given; the error is reported when files are read.
        let real = folder.canonicalize().unwrap_or_else(|_| folder.into());
        let name = real.file_name().map(|name| name.to_string_lossy().into_owned());
        Self { student: name.unwrap_or_else(|| ".".into()), folder: folder.into() }
    }

    pub fn is_link(&self) -> bool {
        fs::symlink_metadata(&self.folder).is_ok_and(|about| about.is_symlink())
    }

    pub fn attempt(&self, exercise: &Exercise) -> Option<PathBuf> {
        let inside = self.folder.join(workbook::FOLDER);
        let places = [
            self.folder.join(exercise.file()),
            inside.join(exercise.file()),
            self.folder.join(format!("{}.rhai", exercise.name)),
        ];
        places.into_iter().find(|place| place.exists())
    }

    fn contains_attempts(&self) -> bool {
        EXERCISES.iter().any(|exercise| self.attempt(exercise).is_some())
    }
}

fn entry_name(path: &Path) -> String {
    path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn write(folder: &Path, file: &str) {
        let path = folder.join(file);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, "").unwrap();
    }

    #[test]
    fn each_named_folder_is_a_student_in_any_file_layout() {
        let class = tempfile::tempdir().unwrap();
        write(class.path(), "carl/kink.rhai");
        write(class.path(), "ada/splines/kink.rhai");
        write(class.path(), "bea/withy-exercises/splines/kink.rhai");
        write(class.path(), ".git/config");
        write(class.path(), "README.md");
        let all = Submission::all_in(class.path()).unwrap();
        let names: Vec<_> = all.iter().map(|submission| submission.student.as_str()).collect();
        assert_eq!(names, ["ada", "bea", "carl"]);
        let kink = super::super::catalogue::find("kink").unwrap();
        assert!(all.iter().all(|submission| submission.attempt(kink).is_some()));
    }

    #[test]
    fn folder_with_exercise_files_is_one_submission() {
        let one = tempfile::tempdir().unwrap();
        write(one.path(), "splines/kink.rhai");
        write(one.path(), "out/picture.svg");
        assert_eq!(Submission::all_in(one.path()).unwrap().len(), 1);
    }

    #[test]
    fn empty_and_missing_submission_folders_are_rejected() {
        let empty = tempfile::tempdir().unwrap();
        let message = Submission::all_in(empty.path()).unwrap_err().to_string();
        assert!(message.contains("a folder for each student"), "{message}");
        assert!(Submission::all_in(&empty.path().join("none")).is_err());
    }
}

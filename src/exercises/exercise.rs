//! Exercises with their embedded texts.

use super::judge::Judge;

/// Exercise with its task, solution and judge. The texts are files in `scripts/exercises`.
#[derive(Debug, PartialEq, Eq)]
pub struct Exercise {
    /// Name of the track, which is also the name of its folder.
    pub track: &'static str,
    /// Name of the exercise, which is unique among all tracks.
    pub name: &'static str,
    /// Text of the start file, which the student completes.
    pub start: &'static str,
    /// Text of the model solution.
    pub solution: &'static str,
    /// Script that judges an attempt. Its header contains the required variables and the hints.
    pub judge: &'static str,
}

impl Exercise {
    /// Name with the track: `track/name`.
    pub fn id(&self) -> String {
        format!("{}/{}", self.track, self.name)
    }

    /// Path of the exercise file relative to the folder of a student.
    pub fn file(&self) -> String {
        format!("{}/{}.rhai", self.track, self.name)
    }

    /// Title of the exercise, which is the first line of its start file.
    pub fn title(&self) -> &'static str {
        self.start.lines().next().and_then(|line| line.strip_prefix("//! ")).unwrap_or_default()
    }

    /// Returns the parsed header of the judge's script.
    pub fn judge(&self) -> Judge {
        Judge::of(self.judge)
    }
}

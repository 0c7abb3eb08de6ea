//! One exercise: texts that are embedded in the program, and what they say about themselves.

use super::judge::Judge;

/// An exercise. Its texts are files of `scripts/exercises`, embedded by [`catalogue`](super::catalogue).
#[derive(Debug, PartialEq, Eq)]
pub struct Exercise {
    /// The track it belongs to, a folder.
    pub track: &'static str,
    /// Its name, by which no other exercise of any track goes.
    pub name: &'static str,
    /// The file that a student begins with.
    pub start: &'static str,
    /// One right answer.
    pub solution: &'static str,
    /// The script that judges, headed by what it needs and by hints.
    pub judge: &'static str,
}

impl Exercise {
    /// `track/name`.
    pub fn id(&self) -> String {
        format!("{}/{}", self.track, self.name)
    }

    /// Its file below the folder of a student.
    pub fn file(&self) -> String {
        format!("{}/{}.rhai", self.track, self.name)
    }

    /// What it is about: the first line of its start file.
    pub fn title(&self) -> &'static str {
        self.start.lines().next().and_then(|line| line.strip_prefix("//! ")).unwrap_or_default()
    }

    /// Its judge.
    pub fn judge(&self) -> Judge {
        Judge::of(self.judge)
    }
}

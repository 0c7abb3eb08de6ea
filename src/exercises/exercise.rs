//! One exercise: texts that are embedded in the program, and what they say about themselves.

use super::judge::Judge;

/// An exercise with its task, solution and judge. The texts are files of `scripts/exercises`, embedded by [`catalogue`](super::catalogue).
#[derive(Debug, PartialEq, Eq)]
pub struct Exercise {
    /// The track that the exercise belongs to, a folder.
    pub track: &'static str,
    /// The name of the exercise, by which no other one of any track goes.
    pub name: &'static str,
    /// The file that a student begins the exercise with.
    pub start: &'static str,
    /// One right answer to the exercise.
    pub solution: &'static str,
    /// The script that judges an attempt at the exercise, headed by what it needs and by hints.
    pub judge: &'static str,
}

impl Exercise {
    /// The name of the exercise with that of its track: `track/name`.
    pub fn id(&self) -> String {
        format!("{}/{}", self.track, self.name)
    }

    /// The file of the exercise below the folder of a student.
    pub fn file(&self) -> String {
        format!("{}/{}.rhai", self.track, self.name)
    }

    /// What the exercise is about: the first line of its start file.
    pub fn title(&self) -> &'static str {
        self.start.lines().next().and_then(|line| line.strip_prefix("//! ")).unwrap_or_default()
    }

    /// The judge of the exercise.
    pub fn judge(&self) -> Judge {
        Judge::of(self.judge)
    }
}

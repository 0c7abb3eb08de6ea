//! An exercise: its embedded texts, and their metadata.

use super::judge::Judge;

/// An exercise with its task, solution and judge. The texts are files of `scripts/exercises`, which [`catalogue`](super::catalogue) embeds.
#[derive(Debug, PartialEq, Eq)]
pub struct Exercise {
    /// Track, which is also its folder.
    pub track: &'static str,
    /// Name, unique among all tracks.
    pub name: &'static str,
    /// Start file.
    pub start: &'static str,
    /// Model solution.
    pub solution: &'static str,
    /// Script that judges an attempt; its header contains the required variables and the hints.
    pub judge: &'static str,
}

impl Exercise {
    /// Name with track: `track/name`.
    pub fn id(&self) -> String {
        format!("{}/{}", self.track, self.name)
    }

    /// File in the folder of a student.
    pub fn file(&self) -> String {
        format!("{}/{}.rhai", self.track, self.name)
    }

    /// Title: first line of the start file.
    pub fn title(&self) -> &'static str {
        self.start.lines().next().and_then(|line| line.strip_prefix("//! ")).unwrap_or_default()
    }

    /// Judge of the exercise.
    pub fn judge(&self) -> Judge {
        Judge::of(self.judge)
    }
}

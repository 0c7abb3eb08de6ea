//! Grading submissions: every exercise of a student gets a mark, whatever the files hold.

use std::path::PathBuf;

use serde_json::{Value, json};

use super::attempt;
use super::exercise::Exercise;
use super::judging::AttemptVerdict;
use super::submissions::Submission;

/// The mark of an attempt at an exercise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// The attempt does what the exercise asks for.
    Passed,
    /// The attempt runs, and something is off.
    Off,
    /// The attempt does not run to its end, or is no text.
    Broken,
    /// A limit stopped the attempt.
    Stopped,
    /// The attempt is the start file, unchanged.
    Untouched,
    /// There is no file with an attempt.
    Missing,
}

impl Mark {
    /// The mark that a word stands for.
    pub fn of(word: &str) -> Option<Self> {
        let all =
            [Self::Passed, Self::Off, Self::Broken, Self::Stopped, Self::Untouched, Self::Missing];
        all.into_iter().find(|mark| mark.word() == word)
    }

    /// The mark in one word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Passed => "passed",
            Self::Off => "off",
            Self::Broken => "broken",
            Self::Stopped => "stopped",
            Self::Untouched => "untouched",
            Self::Missing => "missing",
        }
    }
}

/// One exercise with the mark of a student's attempt.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Graded {
    /// The exercise that is graded.
    pub exercise: &'static Exercise,
    /// The mark of the attempt.
    pub mark: Mark,
    /// What is off in the attempt; empty where nothing is.
    pub message: String,
}

/// The marks of one student.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StudentReport {
    /// The name of the student.
    pub student: String,
    /// The marks of all exercises, in the order of the table.
    pub graded: Vec<Graded>,
}

impl StudentReport {
    /// The number of exercises that the student has passed.
    pub fn passed(&self) -> usize {
        self.graded.iter().filter(|graded| graded.mark == Mark::Passed).count()
    }

    /// The marks of the student as JSON.
    pub fn json(&self) -> Value {
        let exercises: Vec<_> = self
            .graded
            .iter()
            .map(|Graded { exercise, mark, message }| {
                json!({ "exercise": exercise.id(), "result": mark.word(), "message": message })
            })
            .collect();
        json!({ "student": self.student, "passed": self.passed(), "exercises": exercises })
    }
}

/// What is to be done to find the mark of an attempt.
pub enum GradingTask {
    /// Nothing is to be done: the mark is known without judging, with what is off.
    Known(Mark, String),
    /// The attempt in this file, which can be read, is to be judged.
    Judge(PathBuf),
}

impl GradingTask {
    /// Looks at what a student has handed in for an exercise.
    pub fn of(submission: &Submission, exercise: &Exercise) -> Self {
        if submission.is_link() {
            let told = format!("the folder '{}' is a link", submission.folder.display());
            return Self::Known(
                Mark::Broken,
                format!("{told}: an attempt lies in a folder of its own"),
            );
        }
        let Some(path) = submission.attempt(exercise) else {
            return Self::Known(Mark::Missing, String::new());
        };
        match attempt::load(&path, &submission.folder) {
            Ok(attempt) if is_same(&attempt.text, exercise.start) => {
                Self::Known(Mark::Untouched, String::new())
            }
            Ok(_) => Self::Judge(path),
            Err(why) => Self::Known(Mark::Broken, why.message),
        }
    }
}

/// The mark of an attempt from its verdict, and what is off. Nothing when it was interrupted.
pub fn mark(verdict: AttemptVerdict) -> Option<(Mark, String)> {
    let (mark, message) = match verdict {
        AttemptVerdict::Passed => (Mark::Passed, String::new()),
        AttemptVerdict::Off(found) => (Mark::Off, found.join("\n")),
        AttemptVerdict::Broken(why) => {
            let line = why.location.as_ref().map(|at| format!("line {}: ", at.line));
            (Mark::Broken, format!("{}{}", line.unwrap_or_default(), why.message))
        }
        AttemptVerdict::Stopped(why) => (Mark::Stopped, why.message),
        AttemptVerdict::Interrupted => return None,
    };
    Some((mark, message))
}

/// Whether two texts are the same but for the ends of lines.
fn is_same(a: &str, b: &str) -> bool {
    a.lines().map(str::trim_end).eq(b.lines().map(str::trim_end))
}

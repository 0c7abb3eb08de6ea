//! Grades submissions. A student receives a mark for every exercise, whatever the files contain.

use std::path::PathBuf;

use serde_json::{Value, json};

use super::attempt;
use super::exercise::Exercise;
use super::judging::AttemptVerdict;
use super::submissions::Submission;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    Passed,
    WrongResult,
    Error,
    Stopped,
    Unchanged,
    Missing,
}

impl Mark {
    pub fn of(word: &str) -> Option<Self> {
        let all = [
            Self::Passed,
            Self::WrongResult,
            Self::Error,
            Self::Stopped,
            Self::Unchanged,
            Self::Missing,
        ];
        all.into_iter().find(|mark| mark.keyword() == word)
    }

    pub fn keyword(self) -> &'static str {
        match self {
            Self::Passed => "passed",
            Self::WrongResult => "off",
            Self::Error => "broken",
            Self::Stopped => "stopped",
            Self::Unchanged => "untouched",
            Self::Missing => "missing",
        }
    }
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Graded {
    pub exercise: &'static Exercise,
    pub mark: Mark,
    pub message: String,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StudentReport {
    pub student: String,
    pub graded: Vec<Graded>,
}

impl StudentReport {
    pub fn passed(&self) -> usize {
        self.graded.iter().filter(|graded| graded.mark == Mark::Passed).count()
    }

    pub fn json(&self) -> Value {
        let exercises: Vec<_> = self
            .graded
            .iter()
            .map(|Graded { exercise, mark, message }| {
                json!({ "exercise": exercise.id(), "result": mark.keyword(), "message": message })
            })
            .collect();
        json!({ "student": self.student, "passed": self.passed(), "exercises": exercises })
    }
}

pub enum GradingTask {
    Known(Mark, String),
    Judge(PathBuf),
}

impl GradingTask {
    pub fn of(submission: &Submission, exercise: &Exercise) -> Self {
        if submission.is_link() {
            let message = format!("the folder '{}' is a link", submission.folder.display());
            return Self::Known(
                Mark::Error,
                format!("{message}; an attempt must be in a real folder"),
            );
        }
        let Some(path) = submission.attempt(exercise) else {
            return Self::Known(Mark::Missing, String::new());
        };
        match attempt::load(&path, &submission.folder) {
            Ok(attempt) if is_same(&attempt.text, exercise.start) => {
                Self::Known(Mark::Unchanged, String::new())
            }
            Ok(_) => Self::Judge(path),
            Err(why) => Self::Known(Mark::Error, why.message),
        }
    }
}

/// Converts a verdict to a mark and a message; `None` if the judging was interrupted.
pub fn mark(verdict: AttemptVerdict) -> Option<(Mark, String)> {
    let (mark, message) = match verdict {
        AttemptVerdict::Passed => (Mark::Passed, String::new()),
        AttemptVerdict::WrongResult(found) => (Mark::WrongResult, found.join("\n")),
        AttemptVerdict::Error(why) => {
            let line = why.location.as_ref().map(|at| format!("line {}: ", at.line));
            (Mark::Error, format!("{}{}", line.unwrap_or_default(), why.message))
        }
        AttemptVerdict::Stopped(why) => (Mark::Stopped, why.message),
        AttemptVerdict::Interrupted => return None,
    };
    Some((mark, message))
}

fn is_same(a: &str, b: &str) -> bool {
    a.lines().map(str::trim_end).eq(b.lines().map(str::trim_end))
}

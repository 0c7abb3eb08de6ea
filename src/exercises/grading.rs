//! Grading submissions: every exercise of a student gets a mark, whatever the files hold.

use std::path::PathBuf;

use serde_json::{Value, json};

use super::attempt;
use super::exercise::Exercise;
use super::judging::Verdict;
use super::submissions::Submission;

/// What an attempt is worth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// It does what the exercise asks for.
    Passed,
    /// It runs, and something is off.
    Off,
    /// It does not run to its end, or is no text.
    Broken,
    /// A limit stopped it.
    Stopped,
    /// It is the start file.
    Untouched,
    /// There is no file.
    Missing,
}

impl Mark {
    /// The mark of that word.
    pub fn of(word: &str) -> Option<Self> {
        let all =
            [Self::Passed, Self::Off, Self::Broken, Self::Stopped, Self::Untouched, Self::Missing];
        all.into_iter().find(|mark| mark.word() == word)
    }

    /// One word for it.
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

/// The mark of one attempt.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Graded {
    /// The exercise.
    pub exercise: &'static Exercise,
    /// The mark.
    pub mark: Mark,
    /// What is off; empty where nothing is.
    pub message: String,
}

/// What one student has reached.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Report {
    /// The student.
    pub student: String,
    /// All exercises, in the order of the table.
    pub graded: Vec<Graded>,
}

impl Report {
    /// How many exercises are passed.
    pub fn passed(&self) -> usize {
        self.graded.iter().filter(|graded| graded.mark == Mark::Passed).count()
    }

    /// The same as JSON.
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

/// What is to be done for the mark of an attempt.
pub enum Task {
    /// Nothing: it is known without judging.
    Known(Mark, String),
    /// The attempt in this file, which can be read, is to be judged.
    Judge(PathBuf),
}

impl Task {
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

/// The mark of an attempt, and what is off. Nothing when it was interrupted.
pub fn mark(verdict: Verdict) -> Option<(Mark, String)> {
    let (mark, message) = match verdict {
        Verdict::Passed => (Mark::Passed, String::new()),
        Verdict::Off(found) => (Mark::Off, found.join("\n")),
        Verdict::Broken(why) => {
            let line = why.location.as_ref().map(|at| format!("line {}: ", at.line));
            (Mark::Broken, format!("{}{}", line.unwrap_or_default(), why.message))
        }
        Verdict::Stopped(why) => (Mark::Stopped, why.message),
        Verdict::Interrupted => return None,
    };
    Some((mark, message))
}

/// Whether two texts are the same but for the ends of lines.
fn is_same(a: &str, b: &str) -> bool {
    a.lines().map(str::trim_end).eq(b.lines().map(str::trim_end))
}

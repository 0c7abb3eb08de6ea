//! Grading submissions: every exercise of a student gets a mark, whatever the files hold.

use serde_json::{Value, json};

use super::attempt;
use super::catalogue::EXERCISES;
use super::exercise::Exercise;
use super::judging::{Verdict, judge};
use super::submissions::Submission;
use crate::script::context::Settings;

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
    fn json(&self) -> Value {
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

/// The reports of a class as JSON.
pub fn json(reports: &[Report]) -> Value {
    let students: Vec<_> = reports.iter().map(Report::json).collect();
    json!({ "exercises": EXERCISES.len(), "students": students })
}

/// Grades what one student has handed in, each attempt with settings of its own. Nothing when it was interrupted.
pub fn grade(submission: &Submission, settings: impl Fn() -> Settings) -> Option<Report> {
    let graded: Option<Vec<_>> = EXERCISES
        .iter()
        .map(|exercise| {
            let (mark, message) = mark(submission, exercise, settings())?;
            Some(Graded { exercise, mark, message })
        })
        .collect();
    Some(Report { student: submission.student.clone(), graded: graded? })
}

fn mark(
    submission: &Submission,
    exercise: &Exercise,
    settings: Settings,
) -> Option<(Mark, String)> {
    let Some(path) = submission.attempt(exercise) else {
        return Some((Mark::Missing, String::new()));
    };
    let attempt = match attempt::load(&path, &submission.folder) {
        Ok(attempt) => attempt,
        Err(why) => return Some((Mark::Broken, why.message)),
    };
    if is_same(&attempt.text, exercise.start) {
        return Some((Mark::Untouched, String::new()));
    }
    match judge(exercise, &attempt, settings) {
        Verdict::Passed => Some((Mark::Passed, String::new())),
        Verdict::Off(found) => Some((Mark::Off, found.join("\n"))),
        Verdict::Broken(why) => {
            let line = why.location.as_ref().map(|at| format!("line {}: ", at.line));
            Some((Mark::Broken, format!("{}{}", line.unwrap_or_default(), why.message)))
        }
        Verdict::Stopped(why) => Some((Mark::Stopped, why.message)),
        Verdict::Interrupted => None,
    }
}

/// Whether two texts are the same but for the ends of lines.
fn is_same(a: &str, b: &str) -> bool {
    a.lines().map(str::trim_end).eq(b.lines().map(str::trim_end))
}

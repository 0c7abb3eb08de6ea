//! `withy learn grade`: the attempts of a class.

use std::env;
use std::path::Path;
use std::process;
use std::sync::Arc;

use super::Exit;
use super::interrupt::{self, AtStake};
use super::learn::say;
use super::limits::LimitOptions;
use crate::exercises::catalogue::EXERCISES;
use crate::exercises::error::ExerciseError;
use crate::exercises::grading::{self, Report};
use crate::exercises::submissions::Submission;
use crate::output::{Cell, Table};
use crate::script::context::{Mode, Settings};

/// How marks are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// A table for people.
    Table,
    /// JSON for programs.
    Json,
}

/// Grades all submissions of a folder and prints the marks. What attempts write is thrown away.
pub fn grade(folder: &Path, form: Form, limits: &LimitOptions) -> Result<Exit, ExerciseError> {
    let submissions = Submission::all_in(folder)?;
    let flag = interrupt::flag(AtStake::Run);
    let out = env::temp_dir().join(format!("withy-grade-{}", process::id()));
    let settings = || Settings {
        out: out.clone(),
        interrupt: Arc::clone(&flag),
        limits: limits.limits(),
        ..Settings::silent(Mode::Run)
    };
    let reports: Option<Vec<_>> = submissions
        .iter()
        .map(|submission| {
            let report = grading::grade(submission, settings);
            // There is nothing to throw away where nothing was written.
            let _ = std::fs::remove_dir_all(&out);
            report
        })
        .collect();
    let Some(reports) = reports else { return Ok(Exit::Interrupted) };
    match form {
        Form::Json => say(&format!("{:#}", grading::json(&reports))),
        Form::Table => say(&table(&reports)),
    }
    Ok(Exit::Good)
}

/// A line for each attempt that was begun, and one for each student.
fn table(reports: &[Report]) -> String {
    let mut marks = Table::new(&["student", "exercise", "result", "what is off"]);
    let mut sums = Table::new(&["student", "passed", "of"]);
    for report in reports {
        for graded in &report.graded {
            let off = graded.message.lines().next().unwrap_or_default();
            let cells = [report.student.clone(), graded.exercise.id(), graded.mark.word().into()];
            marks.row(cells.into_iter().chain([off.to_owned()]));
        }
        let counts = [report.passed(), EXERCISES.len()].map(|count| Cell::from(count as f64));
        sums.row([Cell::from(report.student.as_str())].into_iter().chain(counts));
    }
    format!("{marks}\n{}", sums.to_string().trim_end())
}

//! Execution and check of a script.

use std::io::{stderr, stdout};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use serde_json::{Value, json};

use super::start::FAILURE;
use crate::script::diagnose::Diagnostic;
use crate::script::engine::runner::{self, Ending, RunOutcome};
use crate::script::help::lookup;
use crate::script::packages::language;
use crate::script::source::program::Program;
use crate::script::state::limits::Limits;
use crate::script::state::settings::{RunMode, RunSettings};

const CHECK_FAILED: u8 = 1;

const DEPTH: usize = 64;

const HELP_WIDTH: usize = 72;

/// Limits of a run in the browser. Memory and time are not limited, because no thread can supervise memory, and the page ends long runs.
pub(super) fn limits() -> Limits {
    Limits { memory: None, depth: DEPTH, ..Limits::default() }
}

pub(super) fn run(file: &Path) -> ExitCode {
    let settings = RunSettings {
        out: PathBuf::new(),
        limits: limits(),
        printed: Box::new(stdout()),
        diagnostics: Box::new(stderr()),
        ..RunSettings::silent(RunMode::Run)
    };
    match start(file, settings) {
        Ok(outcome) => {
            for line in outcome.summary() {
                eprintln!("{line}");
            }
            exit_code(&outcome)
        }
        Err(diagnostic) => fail(&diagnostic),
    }
}

fn start(file: &Path, settings: RunSettings) -> Result<RunOutcome, Diagnostic> {
    Ok(runner::run(&Program::load(file)?, &language(), settings))
}

fn exit_code(outcome: &RunOutcome) -> ExitCode {
    match &outcome.ending {
        Ending::Failed(diagnostic) => fail(diagnostic),
        _ if !outcome.checks.failed().is_empty() => ExitCode::from(CHECK_FAILED),
        _ => ExitCode::SUCCESS,
    }
}

fn fail(diagnostic: &Diagnostic) -> ExitCode {
    let hint = diagnostic.hint.as_deref().and_then(without_options);
    eprint!("{}", Diagnostic { hint, ..diagnostic.clone() });
    ExitCode::from(FAILURE)
}

/// Hint without its parts about command line options for limits, which the playground does not have.
fn without_options(hint: &str) -> Option<String> {
    let parts: Vec<&str> = hint.split("; ").filter(|part| !part.contains("--max-")).collect();
    (!parts.is_empty()).then(|| parts.join("; "))
}

pub(super) fn check(file: &Path) -> ExitCode {
    let settings = RunSettings { limits: limits(), ..RunSettings::silent(RunMode::DryRun) };
    let found = match start(file, settings) {
        Ok(RunOutcome { ending: Ending::Failed(diagnostic), .. }) | Err(diagnostic) => {
            vec![to_json(&diagnostic)]
        }
        Ok(_) => Vec::new(),
    };
    println!("{}", Value::Array(found));
    ExitCode::SUCCESS
}

pub(super) fn help(name: &str) -> ExitCode {
    match lookup::page(&language(), name) {
        Ok(page) => {
            println!("{}", json!(page.plain(HELP_WIDTH)));
            ExitCode::SUCCESS
        }
        Err(unknown) => fail(&Diagnostic::general(unknown.to_string())),
    }
}

fn to_json(diagnostic: &Diagnostic) -> Value {
    let place = diagnostic.location.as_ref().map(|at| {
        json!({ "file": at.program.name, "line": at.line, "column": at.column, "length": at.length })
    });
    let hint = diagnostic.hint.as_deref().and_then(without_options);
    json!({ "message": diagnostic.message, "hint": hint, "place": place })
}

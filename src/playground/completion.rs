//! Completion of names in a script.

use std::path::Path;
use std::process::ExitCode;

use serde_json::{Value, json};

use super::commands::limits;
use super::start::FAILURE;
use crate::repl::document::names_at;
use crate::repl::editor::candidates::Candidate;
use crate::repl::editor::completion::complete;
use crate::repl::editor::hints::hint;
use crate::script::diagnose::Diagnostic;
use crate::script::source::program::Program;

pub(super) fn complete_at(file: &Path, offset: usize) -> ExitCode {
    match completions(file, offset) {
        Ok(found) => {
            println!("{found}");
            ExitCode::SUCCESS
        }
        Err(diagnostic) => {
            eprint!("{diagnostic}");
            ExitCode::from(FAILURE)
        }
    }
}

fn completions(file: &Path, offset: usize) -> Result<Value, Diagnostic> {
    let program = Program::load(file)?;
    let text = program.text.get(..offset).unwrap_or(&program.text);
    let surroundings = names_at(&program, offset, limits())?;
    let (start, candidates) = complete(text, text.len(), &surroundings);
    let options = candidates.iter().map(|Candidate { display, replacement, summary }| {
        json!({ "label": display, "insert": replacement, "about": summary })
    });
    let options: Vec<Value> = options.collect();
    let hint = hint(text, text.len(), &surroundings).filter(|hint| hint.insertable.is_none());
    let hint = hint.map(|hint| hint.shown.trim().to_owned());
    Ok(json!({ "start": start, "options": options, "hint": hint }))
}

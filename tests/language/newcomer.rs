//! Typical mistakes of newcomers, with the expected message and hint.
//!
//! Each row of `tests/newcomer/*.txt` has the input, then `=> ` and a part of the message, then `-> ` and a part of the hint. An input may have several lines.
//! Lines that begin with `== ` are headings.
#![allow(clippy::unwrap_used)]

use std::fs;

use crate::common::notepad::Notepad;
use withy::script::engine::runner::{Ending, run};
use withy::script::packages::language;
use withy::script::source::program::Program;
use withy::script::state::settings::{RunMode, RunSettings};

/// Mistake with its expected message and hint.
#[derive(Default)]
struct Row {
    typed: String,
    message: String,
    hint: String,
}

fn rows(text: &str) -> Vec<Row> {
    let mut rows = Vec::new();
    let mut row = Row::default();
    for line in text.lines().filter(|line| !line.starts_with("== ")) {
        if let Some(message) = line.strip_prefix("=> ") {
            row.message = message.into();
        } else if let Some(hint) = line.strip_prefix("-> ") {
            row.hint = hint.into();
            rows.push(std::mem::take(&mut row));
        } else if !line.is_empty() {
            row.typed.push_str(line);
            row.typed.push('\n');
        }
    }
    assert_eq!(row.typed, "", "the last row is whole");
    rows
}

/// Message and hint for a script that must fail.
fn said(typed: &str) -> Result<(String, String), String> {
    let printed = Notepad::default();
    let settings =
        RunSettings { printed: Box::new(printed.clone()), ..RunSettings::silent(RunMode::Run) };
    match run(&Program::named("typed", typed), &language(), settings).ending {
        Ending::Failed(messages) => Ok((messages.message, messages.hint.unwrap_or_default())),
        other => Err(format!("{other:?}")),
    }
}

fn judge(file: &str, least: usize) {
    let text = fs::read_to_string(format!("tests/newcomer/{file}.txt")).unwrap();
    let rows = rows(&text);
    let mut wrong = Vec::new();
    for row in &rows {
        match said(&row.typed) {
            Ok((message, hint)) if message.contains(&row.message) && hint.contains(&row.hint) => (),
            Ok((message, hint)) => wrong.push(format!(
                "{}  said   => {message}\n         -> {hint}\n  wanted => {}\n         -> {}",
                row.typed, row.message, row.hint
            )),
            Err(ending) => wrong.push(format!("{}  must be wrong: {ending}", row.typed)),
        }
    }
    assert!(wrong.is_empty(), "{} of {} rows\n\n{}", wrong.len(), rows.len(), wrong.join("\n\n"));
    assert!(rows.len() >= least, "only {} rows", rows.len());
}

#[test]
fn errors_of_beginners_suggest_correct_code() {
    judge("first_steps", 25);
}

#[test]
fn syntax_of_other_languages_gets_a_suggestion() {
    judge("habits", 50);
}

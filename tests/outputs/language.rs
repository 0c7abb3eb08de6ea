//! Outputs of scripts in this process: the language suite, inputs of newcomers, examples of the help, and exercises.

use std::fs;
use std::path::Path;

use crate::book::Book;
use crate::notepad::Notepad;
use crate::times;
use withy::exercises::catalogue::EXERCISES;
use withy::script::engine::runner::{Ending, run};
use withy::script::packages::{TABLES, language};
use withy::script::source::program::Program;
use withy::script::state::settings::{RunMode, RunSettings};

pub fn record(book: &mut Book) {
    suite(book);
    newcomers(book);
    examples(book);
    exercises(book);
}

/// Runs a text, and records its output, messages, outcome and files.
fn keep_run(book: &mut Book, name: &str, text: &str) {
    let out = tempfile::tempdir().unwrap();
    let (printed, message) = (Notepad::default(), Notepad::default());
    let settings = RunSettings {
        out: out.path().join("out"),
        printed: Box::new(printed.clone()),
        diagnostics: Box::new(message.clone()),
        ..RunSettings::silent(RunMode::Run)
    };
    let outcome = run(&Program::named("script", text), &language(), settings);
    let ending = match outcome.ending {
        Ending::Failed(diagnostic) => diagnostic.to_string(),
        other => format!("{other:?}"),
    };
    let checks = outcome.checks.failed().to_vec();
    let all = format!("{}\n{}\n{ending}\n{checks:?}", printed.take(), message.take());
    let place = out.path().to_string_lossy().into_owned();
    let (all, files) = (all.replace(&place, "FOLDER"), out.path().join("out"));
    if measures_times(text) {
        book.keep(name, times::without_numbers(&all));
        book.keep_file_names(&format!("{name}, files"), &files);
    } else {
        book.keep(name, all);
        book.keep_files(&format!("{name}, files"), &files);
    }
}

/// Returns true if a script measures times. Its tables and pictures differ between runs.
pub fn measures_times(text: &str) -> bool {
    ["timestamp()", "study_cost", "study_work_precision"].iter().any(|study| text.contains(study))
}

/// Texts of a folder, by name.
pub fn texts(folder: &str, ending: &str) -> Vec<(String, String)> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut texts: Vec<_> = entries
        .filter(|path| path.extension().is_some_and(|found| found == ending))
        .map(|path| (name_of(&path), fs::read_to_string(&path).unwrap()))
        .collect();
    texts.sort();
    texts
}

fn name_of(path: &Path) -> String {
    path.file_stem().unwrap().to_string_lossy().into_owned()
}

fn suite(book: &mut Book) {
    for (file, text) in texts("tests/suite", "rhai") {
        for section in text.split("// --- ").skip(1) {
            let (name, script) = section.split_once('\n').unwrap();
            keep_run(book, &format!("suite/{file}/{}", name.trim()), script);
        }
    }
}

/// Rows are identified by their numbers, because the inputs are too long for names.
fn newcomers(book: &mut Book) {
    for (file, text) in texts("tests/newcomer", "txt") {
        let rows = text.lines().filter(|line| !line.starts_with("== "));
        let (mut typed, mut number) = (String::new(), 0);
        for line in rows {
            if line.starts_with("-> ") {
                number += 1;
                keep_run(book, &format!("newcomer/{file}/{number}"), &std::mem::take(&mut typed));
            } else if !line.starts_with("=> ") {
                typed += line;
                typed.push('\n');
            }
        }
    }
}

fn examples(book: &mut Book) {
    for table in TABLES {
        for (number, row) in table.rows.iter().enumerate() {
            let script = format!("{}\n{}", table.setup, row.example);
            keep_run(book, &format!("examples/{}/{number} {}", table.name, row.name), &script);
        }
    }
    for table in language().built_in_tables() {
        for (number, row) in table.rows.iter().enumerate() {
            keep_run(
                book,
                &format!("examples/{}/{number} {}", table.name, row.name()),
                row.example,
            );
        }
    }
}

fn exercises(book: &mut Book) {
    for exercise in EXERCISES {
        keep_run(book, &format!("exercises/{}/start", exercise.id()), exercise.start);
        keep_run(book, &format!("exercises/{}/solution", exercise.id()), exercise.solution);
        let hints = exercise.judge().hints.join("\n");
        book.keep(format!("exercises/{}/hints", exercise.id()), hints);
    }
}

//! Runs the scripts of `tests/suite`.
//!
//! A file has sections `// --- name`. A section without expectations must run to its end with all checks passing. `// error: COLUMN text` and an optional `//
//! hint: text` precede the line with the error; both texts may be parts. `// prints: text` is exactly the next printed line.

use std::fs;

use crate::common::notepad::Notepad;
use withy::script::engine::runner::{Ending, RunOutcome, run};
use withy::script::packages::language;
use withy::script::source::program::Program;
use withy::script::state::settings::{RunMode, RunSettings};

/// Expectation of a section.
#[derive(Default)]
struct Expectation {
    error: Option<(usize, usize, String)>,
    hint: Option<String>,
    printed: Vec<String>,
}

struct Section {
    name: String,
    text: String,
}

#[test]
fn suite() {
    let mut failures = Vec::new();
    let mut count = 0;
    for entry in fs::read_dir("tests/suite").expect("the folder of the suite") {
        let path = entry.expect("an entry").path();
        let text = fs::read_to_string(&path).expect("a script");
        for section in sections(&text) {
            count += 1;
            if let Err(reason) = judge(&section) {
                failures.push(format!("{}: {}: {reason}", path.display(), section.name));
            }
        }
    }
    assert!(
        failures.is_empty(),
        "{} of {count} sections failed\n\n{}",
        failures.len(),
        failures.join("\n\n")
    );
    assert!(count > 50, "only {count} sections were found");
}

fn sections(text: &str) -> Vec<Section> {
    let mut sections: Vec<Section> = Vec::new();
    for line in text.lines() {
        match line.strip_prefix("// --- ") {
            Some(name) => sections.push(Section { name: name.trim().into(), text: String::new() }),
            None => {
                if let Some(section) = sections.last_mut() {
                    section.text.push_str(line);
                    section.text.push('\n');
                }
            }
        }
    }
    sections
}

fn expectation(text: &str) -> Expectation {
    let mut expected = Expectation::default();
    let lines: Vec<_> = text.lines().map(str::trim).collect();
    for (index, line) in lines.iter().enumerate() {
        if let Some(rest) = line.strip_prefix("// error: ") {
            let (column, message) = rest.split_once(' ').unwrap_or((rest, ""));
            let offending =
                lines[index..].iter().position(|line| !line.starts_with("//")).unwrap_or(0)
                    + index
                    + 1;
            expected.error = Some((offending, column.parse().expect("a column"), message.into()));
        } else if let Some(hint) = line.strip_prefix("// hint: ") {
            expected.hint = Some(hint.into());
        } else if let Some(printed) = line.strip_prefix("// prints: ") {
            expected.printed.push(printed.into());
        }
    }
    expected
}

fn judge(section: &Section) -> Result<(), String> {
    let expected = expectation(&section.text);
    let printed = Notepad::default();
    let settings =
        RunSettings { printed: Box::new(printed.clone()), ..RunSettings::silent(RunMode::Run) };
    let outcome = run(&Program::named("suite", &section.text), &language(), settings);
    let lines: Vec<_> = printed.take().lines().map(str::to_owned).collect();
    judge_ending(&expected, &outcome)?;
    if !expected.printed.is_empty() && lines != expected.printed {
        return Err(format!("printed {lines:#?}, expected {:#?}", expected.printed));
    }
    match outcome.checks.failed() {
        [] => Ok(()),
        failed => Err(format!("{failed:?}")),
    }
}

fn judge_ending(expected: &Expectation, outcome: &RunOutcome) -> Result<(), String> {
    match (&expected.error, &outcome.ending) {
        (None, Ending::Finished) => Ok(()),
        (None, Ending::Failed(diagnostic)) => Err(format!("must run\n{diagnostic}")),
        (Some((line, column, message)), Ending::Failed(diagnostic)) => {
            let place = format!("suite:{line}:{column}");
            let right_place = diagnostic.location_text().as_deref() == Some(&place);
            let right_hint = expected.hint.as_deref().is_none_or(|hint| {
                diagnostic.hint.as_deref().is_some_and(|given| given.contains(hint))
            });
            match right_place && right_hint && diagnostic.message.contains(message) {
                true => Ok(()),
                false => Err(format!(
                    "expected {place} {message} (hint {:?}), got\n{diagnostic}",
                    expected.hint
                )),
            }
        }
        (expected, ending) => Err(format!("expected {expected:?}, got {ending:?}")),
    }
}

//! A verdict as plain data, which goes from the process of an attempt to whoever shows it.

use serde::{Deserialize, Serialize};

use super::captured_output::CapturedOutput;
use super::judging::AttemptVerdict;
use crate::script::diagnose::{Diagnostic, Location};

/// The longest message that is passed on, in characters: nobody reads more.
const LONGEST: usize = 4000;
/// Characters of a source line that are passed on, and how many of them stand before the place.
const EXCERPT: (usize, usize) = (400, 150);

/// What became of an attempt at an exercise, and what it has printed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct AttemptReport {
    /// What became of the attempt.
    pub outcome: AttemptOutcome,
    /// What the attempt has printed.
    pub printed: CapturedOutput,
}

/// What became of an attempt at an exercise.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum AttemptOutcome {
    /// The attempt does what the exercise asks for.
    Passed,
    /// The attempt runs, and this is off, in the judge's words.
    Off(Vec<String>),
    /// The attempt does not run to its end.
    Broken(AttemptError),
    /// A limit stopped the attempt.
    Stopped(AttemptError),
    /// The attempt was stopped from outside.
    Interrupted,
}

/// An error of an attempt at an exercise.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct AttemptError {
    /// What is wrong in the attempt.
    pub message: String,
    /// What to do about the error.
    pub help: Option<String>,
    /// The place of the error in a script, if it is known.
    pub place: Option<ScriptPosition>,
    /// The calls that led to the error.
    pub calls: Vec<String>,
}

/// The place of an error in a script.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ScriptPosition {
    /// The name of the file with the error.
    pub file: String,
    /// The line of the error, from 1.
    pub line: usize,
    /// The text of the line with the error, or a part of that text about the place.
    pub text: String,
    /// Where the place of the error begins in the text of its line, in characters from 0.
    pub at: usize,
    /// The length of the place in characters.
    pub length: usize,
}

impl From<AttemptVerdict> for AttemptOutcome {
    fn from(verdict: AttemptVerdict) -> Self {
        match verdict {
            AttemptVerdict::Passed => Self::Passed,
            AttemptVerdict::Off(found) => {
                Self::Off(found.iter().map(|found| shortened(found)).collect())
            }
            AttemptVerdict::Broken(why) => Self::Broken(AttemptError::from(why)),
            AttemptVerdict::Stopped(why) => Self::Stopped(AttemptError::from(why)),
            AttemptVerdict::Interrupted => Self::Interrupted,
        }
    }
}

impl From<Diagnostic> for AttemptError {
    fn from(why: Diagnostic) -> Self {
        Self {
            message: shortened(&why.message),
            help: why.hint.as_deref().map(shortened),
            place: why.location.as_ref().map(ScriptPosition::from),
            calls: why.trace.iter().take(3).map(|step| shortened(&step.to_string())).collect(),
        }
    }
}

impl From<&Location> for ScriptPosition {
    fn from(location: &Location) -> Self {
        let line = location.program.text.lines().nth(location.line.saturating_sub(1));
        let column = location.column.saturating_sub(1);
        let (longest, before) = EXCERPT;
        let skipped = column.saturating_sub(before);
        let text = line.unwrap_or_default().chars().skip(skipped).take(longest).collect();
        Self {
            file: location.program.name.clone(),
            line: location.line,
            text,
            at: column - skipped,
            length: location.length,
        }
    }
}

fn shortened(text: &str) -> String {
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{} …", &text[..end]),
        None => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::script::source::program::Program;

    fn place(text: &str, line: usize, column: usize) -> ScriptPosition {
        let program = Arc::new(Program::named("mine.rhai", text));
        ScriptPosition::from(&Location { program, line, column, length: 4 })
    }

    #[test]
    fn a_place_has_its_line_or_what_stands_about_it() {
        let near = place("let a = 1;\nlet b = todo(\"b\");", 2, 9);
        assert_eq!((near.text.as_str(), near.at, near.line), ("let b = todo(\"b\");", 8, 2));
        let far = place(&format!("{}here", " ".repeat(100_000)), 1, 100_001);
        assert_eq!(far.text.chars().skip(far.at).collect::<String>(), "here");
        assert!(far.text.len() <= EXCERPT.0);
        assert_eq!(place("", 7, 1).text, "");
    }

    #[test]
    fn a_report_comes_through_a_line_whatever_it_says() {
        let why = Diagnostic::general("x".repeat(1 << 20)).with_hint("two\nlines \u{1b}[2J");
        let printed = CapturedOutput { lines: vec!["\u{7}".into()], more: 3 };
        let report = AttemptReport { outcome: AttemptVerdict::Broken(why).into(), printed };
        let line = serde_json::to_string(&report).unwrap();
        assert!(!line.contains(['\n', '\u{1b}']) && line.len() < 3 * LONGEST);
        assert_eq!(serde_json::from_str::<AttemptReport>(&line).unwrap(), report);
    }
}

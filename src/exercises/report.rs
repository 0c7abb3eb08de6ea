//! Serialisable verdicts, which the process of an attempt sends to the process that displays them.

use serde::{Deserialize, Serialize};

use super::captured_output::CapturedOutput;
use super::judging::AttemptVerdict;
use crate::script::diagnose::{Diagnostic, Location};

/// Maximum length of a message in a verdict [characters].
const LONGEST: usize = 4000;
/// Maximum length of the excerpt of a source line, and of its part before the error [characters].
const EXCERPT: (usize, usize) = (400, 150);

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct AttemptReport {
    pub outcome: AttemptOutcome,
    pub printed: CapturedOutput,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum AttemptOutcome {
    Passed,
    WrongResult(Vec<String>),
    Error(AttemptError),
    Stopped(AttemptError),
    Interrupted,
}

#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct AttemptError {
    pub message: String,
    pub help: Option<String>,
    pub place: Option<ScriptPosition>,
    pub calls: Vec<String>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ScriptPosition {
    pub file: String,
    pub line: usize,
    pub text: String,
    /// Index of the first character of the error in `text`, counted from 0.
    pub at: usize,
    pub length: usize,
}

impl From<AttemptVerdict> for AttemptOutcome {
    fn from(verdict: AttemptVerdict) -> Self {
        match verdict {
            AttemptVerdict::Passed => Self::Passed,
            AttemptVerdict::WrongResult(found) => {
                Self::WrongResult(found.iter().map(|found| shortened(found)).collect())
            }
            AttemptVerdict::Error(why) => Self::Error(AttemptError::from(why)),
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
    fn error_location_has_its_line_or_an_excerpt() {
        let near = place("let a = 1;\nlet b = todo(\"b\");", 2, 9);
        assert_eq!((near.text.as_str(), near.at, near.line), ("let b = todo(\"b\");", 8, 2));
        let far = place(&format!("{}here", " ".repeat(100_000)), 1, 100_001);
        assert_eq!(far.text.chars().skip(far.at).collect::<String>(), "here");
        assert!(far.text.len() <= EXCERPT.0);
        assert_eq!(place("", 7, 1).text, "");
    }

    #[test]
    fn attempt_reports_survive_serialisation_to_one_line() {
        let why = Diagnostic::general("x".repeat(1 << 20)).with_hint("two\nlines \u{1b}[2J");
        let printed = CapturedOutput { lines: vec!["\u{7}".into()], further_lines: 3 };
        let report = AttemptReport { outcome: AttemptVerdict::Error(why).into(), printed };
        let line = serde_json::to_string(&report).unwrap();
        assert!(!line.contains(['\n', '\u{1b}']) && line.len() < 3 * LONGEST);
        assert_eq!(serde_json::from_str::<AttemptReport>(&line).unwrap(), report);
    }
}

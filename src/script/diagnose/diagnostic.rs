//! An error as it is shown to people: message, hint, place, and the calls that led there.

use std::fmt;
use std::sync::Arc;

use super::render::Colours;
use crate::script::messages::brief::brief;
use crate::script::source::program::{Program, Unreadable};

/// A diagnostic: an error as it is shown to people.
#[derive(Clone, Debug)]
pub struct Diagnostic {
    /// What is wrong, in words.
    pub message: String,
    /// What to do about the error.
    pub hint: Option<String>,
    /// The place of the error, if it is about one in a script.
    pub location: Option<Location>,
    /// The calls of script functions that led to the error, innermost first.
    pub trace: Vec<CallFrame>,
    /// Whose mistake the error is.
    pub blame: Blame,
}

/// Whose mistake an error is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Blame {
    /// The error is a mistake in the script, or in the way it was called.
    User,
    /// The error is a mistake of this program.
    Us,
}

/// A piece of one line of a script.
#[derive(Clone, Debug)]
pub struct Location {
    /// The script that the piece is in.
    pub program: Arc<Program>,
    /// The line of the piece, from 1.
    pub line: usize,
    /// The column where the piece begins, in characters from 1.
    pub column: usize,
    /// The length of the piece in characters.
    pub length: usize,
}

/// One call on the way to an error.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CallFrame {
    /// What the call has called.
    pub callee: Callee,
    /// The line of the call on the way to the error, if it is known.
    pub line: Option<usize>,
    /// The file of the call on the way to the error, if it is not the one that was run.
    pub file: Option<String>,
}

/// What a call on the way to an error has called.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Callee {
    /// A function was called by its name.
    Function(String),
    /// A function without a name was called.
    Closure,
    /// A file was imported.
    File(String),
    /// Nothing was called: this is the line of the standard library at which the error arose.
    Library,
}

impl Diagnostic {
    /// An error that is about no place in a script.
    pub fn general(message: impl Into<String>) -> Self {
        Self {
            message: brief(message.into()),
            hint: None,
            location: None,
            trace: Vec::new(),
            blame: Blame::User,
        }
    }

    /// The diagnostic of a mistake of this program.
    pub fn bug(message: impl fmt::Display) -> Self {
        let mut diagnostic = Self::general(format!("withy has made a mistake: {message}"));
        diagnostic.hint = Some(
            "this is a bug in withy, not in your script; please report it with the script".into(),
        );
        diagnostic.blame = Blame::Us;
        diagnostic
    }

    /// Adds to the diagnostic what to do.
    #[must_use]
    pub fn with_hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(brief(hint.into()));
        self
    }

    /// The diagnostic in one line, what is wrong and where: for tables.
    pub fn line(&self) -> String {
        let told = self.message.split_whitespace().collect::<Vec<_>>().join(" ");
        match self.location.as_ref().filter(|at| !at.program.name.is_empty()) {
            Some(at) => format!("{told} ({}, line {})", at.program.name, at.line),
            None => told,
        }
    }

    /// Adds something else to do to the diagnostic, on a line of its own.
    #[must_use]
    pub fn with_another_hint(mut self, hint: &str) -> Self {
        self.hint = Some(self.hint.map_or_else(|| hint.into(), |first| format!("{first}\n{hint}")));
        self
    }

    /// The place of the error as `file:line:column`, for tests and editors.
    pub fn place(&self) -> Option<String> {
        self.location.as_ref().map(|at| format!("{}:{}:{}", at.program.name, at.line, at.column))
    }
}

impl From<Unreadable> for Diagnostic {
    fn from(refused: Unreadable) -> Self {
        Self::general(refused.told).with_hint(refused.hint)
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(Colours::None))
    }
}

//! Error as shown to the user: message, hint, location, and call trace.

use std::fmt;
use std::sync::Arc;

use super::render::Colours;
use crate::script::messages::brief::brief;
use crate::script::source::program::{Program, Unreadable};

/// Error as shown to the user.
#[derive(Clone, Debug)]
pub struct Diagnostic {
    /// Error message.
    pub message: String,
    /// Suggestion.
    pub hint: Option<String>,
    /// Location in a script; `None` if there is none.
    pub location: Option<Location>,
    /// Calls of script functions that led to the error. The innermost call comes first.
    pub trace: Vec<CallFrame>,
    /// Origin of the error.
    pub blame: Blame,
}

/// Origin of an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Blame {
    /// Error that the user can correct, for example in the script.
    User,
    /// Internal error of the program.
    Program,
}

/// Part of one line of a script.
#[derive(Clone, Debug)]
pub struct Location {
    /// Script.
    pub program: Arc<Program>,
    /// Line, counted from 1.
    pub line: usize,
    /// First column in characters, counted from 1.
    pub column: usize,
    /// Length in characters.
    pub length: usize,
}

/// Call in the trace of an error.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CallFrame {
    /// Called function.
    pub callee: Callee,
    /// Line of the call; `None` if unknown.
    pub line: Option<usize>,
    /// File of the call; `None` for the main script.
    pub file: Option<String>,
}

/// Function that was called in a frame of the trace.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Callee {
    /// Named function.
    Function(String),
    /// Closure.
    Closure,
    /// Imported file.
    File(String),
    /// Not a call, but the line of the standard library at which the error occurred.
    Library,
}

impl Diagnostic {
    /// Creates an error without a location.
    pub fn general(message: impl Into<String>) -> Self {
        Self {
            message: brief(message.into()),
            hint: None,
            location: None,
            trace: Vec::new(),
            blame: Blame::User,
        }
    }

    /// Creates an internal error.
    pub fn internal_error(message: impl fmt::Display) -> Self {
        let mut diagnostic = Self::general(format!("internal error of withy: {message}"));
        diagnostic.hint = Some(
            "this is a bug in withy, not in your script; please report it with the script".into(),
        );
        diagnostic.blame = Blame::Program;
        diagnostic
    }

    /// Sets the hint.
    #[must_use]
    pub fn with_hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(brief(hint.into()));
        self
    }

    /// Message and location of the error on one line, for tables.
    pub fn line(&self) -> String {
        let message = self.message.split_whitespace().collect::<Vec<_>>().join(" ");
        match self.location.as_ref().filter(|at| !at.program.name.is_empty()) {
            Some(at) => format!("{message} ({}, line {})", at.program.name, at.line),
            None => message,
        }
    }

    /// Adds another hint on a separate line.
    #[must_use]
    pub fn with_another_hint(mut self, hint: &str) -> Self {
        self.hint = Some(self.hint.map_or_else(|| hint.into(), |first| format!("{first}\n{hint}")));
        self
    }

    /// Location as `file:line:column`, for tests and editors.
    pub fn location_text(&self) -> Option<String> {
        self.location.as_ref().map(|at| format!("{}:{}:{}", at.program.name, at.line, at.column))
    }
}

impl From<Unreadable> for Diagnostic {
    fn from(refused: Unreadable) -> Self {
        Self::general(refused.message).with_hint(refused.hint)
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(Colours::None))
    }
}

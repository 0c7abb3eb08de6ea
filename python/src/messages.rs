//! Requests to the thread of a session, and its messages.

use std::path::PathBuf;
use std::sync::mpsc::Sender;

use withy::script::state::inputs::Inputs;

use crate::value::Value;

/// Request to the thread of a session.
pub enum Request {
    /// Performs a task and sends its messages.
    Perform(Task, Sender<Message>),
    /// Changes the stored values.
    Update(Update),
}

/// Change of the stored values of a session.
pub enum Update {
    /// Result of a called Python function, or the message of its exception.
    Answer { call: u64, result: Result<Value, String> },
    /// Releases a kept value.
    Release(u64),
}

/// Task of a session.
pub enum Task {
    /// Runs the script in a file.
    RunFile { path: PathBuf, inputs: Inputs },
    /// Runs statements of a script.
    RunText { text: String, name: String, inputs: Inputs },
    /// Evaluates an expression in which the variables `a0`, `a1`, … have these values.
    Evaluate { expression: String, values: Vec<Value> },
    /// Sets a variable.
    Define { name: String, value: Value },
    /// Returns the value of a variable.
    Read { name: String },
    /// Returns the names of the variables.
    Names,
    /// Returns the paths of the written files.
    Files,
    /// Returns the messages of the failed checks.
    FailedChecks,
}

/// Message from the thread of a session.
pub enum Message {
    /// A line was printed.
    Line(Stream, String),
    /// A Python function must be called.
    Call { call: u64, function: u64, arguments: Vec<Value> },
    /// The task is complete.
    Done(Result<Value, Failure>),
}

/// Stream of a printed line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stream {
    /// Output of the script.
    Printed,
    /// Notes and failed checks.
    Notes,
}

/// Reason why a task did not complete.
#[derive(Debug)]
pub enum Failure {
    /// The script failed.
    Script(ScriptFailure),
    /// The script was interrupted.
    Interrupted,
}

/// Error of a script.
#[derive(Debug, Default)]
pub struct ScriptFailure {
    /// Error message.
    pub message: String,
    /// Suggestion.
    pub hint: Option<String>,
    /// File, line and column of the error; `None` if it has no place in a script.
    pub place: Option<(String, usize, usize)>,
    /// Message with the line of the script and the hint.
    pub report: String,
}

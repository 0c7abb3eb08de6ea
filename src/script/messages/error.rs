//! Errors of native functions: message, hint, and underlined part of the call.

use rhai::{Dynamic, EvalAltResult, Position};

use super::advice;
use super::brief::brief;
use super::raised::Raised;
use super::stop::Stop;

pub(in crate::script) const BUG: &str = "a bug in withy";

/// Error of a native function of the language.
#[derive(Debug)]
pub enum ScriptError {
    /// The request of the script is invalid.
    Failure(Failure),
    /// The run was interrupted or exceeded a limit. Scripts cannot catch this error.
    Stopped(Stop),
    /// Internal error of the program. Its message asks for a report.
    Internal(String),
    /// Error of a called script function, passed on unchanged.
    Engine(Box<EvalAltResult>),
}

/// Invalid request: the message names the object and the value, and the hint states the remedy.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// Error message.
    pub message: String,
    /// Suggestion for the user.
    pub hint: Option<String>,
    /// Underlined part of the call.
    pub place: CallPart,
}

/// Part of a call to which an error refers.
#[derive(Clone, Debug, PartialEq)]
pub enum CallPart {
    /// Name of the function.
    Call,
    /// Argument with this index, counted from 0. In a call with method syntax, argument 0 is before the dot.
    Argument(usize),
    /// Argument of a method with this index, counted from 0 after the dot.
    ArgumentOfMethod(usize),
    /// Key of an option map in the arguments.
    Key(String),
}

impl ScriptError {
    /// Creates the error of an invalid request.
    pub fn new(message: impl Into<String>) -> Self {
        let message = brief(message.into());
        Self::Failure(Failure { message, hint: None, place: CallPart::Call })
    }

    /// Creates an internal error.
    pub fn internal_error(message: impl Into<String>) -> Self {
        Self::Internal(message.into())
    }

    /// Adds a hint.
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        if let Self::Failure(failure) = &mut self {
            failure.hint = Some(brief(hint.into()));
        }
        self
    }

    /// Adds the hint for the error `cause`, if one is known.
    pub fn advised(self, cause: &(dyn std::error::Error + 'static)) -> Self {
        match advice::hint_for(cause) {
            Some(advice) => self.hint(advice),
            None => self,
        }
    }

    /// Sets the part of the call to which the error refers.
    pub fn at(mut self, place: CallPart) -> Self {
        if let Self::Failure(failure) = &mut self {
            failure.place = place;
        }
        self
    }

    /// Declares the index of an argument to be counted after the dot of a method call. The index itself is unchanged.
    pub fn of_method(mut self) -> Self {
        if let Self::Failure(Failure { place, .. }) = &mut self
            && let CallPart::Argument(number) = *place
        {
            *place = CallPart::ArgumentOfMethod(number);
        }
        self
    }

    /// Converts the error to an engine error at the position of the call.
    pub fn into_engine(self, call: Position) -> Box<EvalAltResult> {
        match self {
            Self::Failure(failure) => {
                EvalAltResult::ErrorRuntime(Dynamic::from(failure), call).into()
            }
            Self::Stopped(stop) => EvalAltResult::ErrorTerminated(Dynamic::from(stop), call).into(),
            Self::Internal(message) => EvalAltResult::ErrorSystem(message, BUG.into()).into(),
            Self::Engine(error) => error,
        }
    }
}

/// Converts an error of a lower layer to a failure with its message and a hint, and passes errors of script functions on unchanged.
impl<E: std::error::Error + 'static> From<E> for ScriptError {
    fn from(error: E) -> Self {
        match Raised::script_error_in(&error) {
            Some(raised) => Self::Engine(raised),
            None => Self::new(error.to_string()).advised(&error),
        }
    }
}

/// Result of functions called by the engine: a value, or an error with its position in the script.
pub type EngineResult<T> = Result<T, Box<EvalAltResult>>;

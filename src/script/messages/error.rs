//! Errors that native bodies report: what is wrong, what to do, and where in the call to point.

use rhai::{Dynamic, EvalAltResult, Position};

use super::advice;
use super::brief::brief;
use super::raised::Raised;
use super::stop::Stop;

/// The words that mark errors of the engine that are our own mistakes.
pub(in crate::script) const BUG: &str = "a bug in withy";

/// Why a native function of the language gave up.
#[derive(Debug)]
pub enum ScriptError {
    /// The script asked for something that is wrong.
    Failure(Failure),
    /// The run was interrupted from outside or passed a limit; scripts cannot catch this.
    Stopped(Stop),
    /// The program made a mistake of its own; the user is asked to report it.
    Bug(String),
    /// A script function that was called back failed; its own error is handed on untouched.
    Engine(Box<EvalAltResult>),
}

/// A wrong request: the message names the object and the value, the hint says what to do next.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// What is wrong with the request.
    pub message: String,
    /// What to do about the wrong request.
    pub hint: Option<String>,
    /// The part of the call to underline.
    pub place: CallPart,
}

/// The part of a call that an error is about.
#[derive(Clone, Debug, PartialEq)]
pub enum CallPart {
    /// The error is about the called name.
    Call,
    /// The error is about the argument with this number, from 0; that of a function called behind a dot stands before it.
    Argument(usize),
    /// The error is about the argument of a method with this number, from 0: the receiver does not count.
    ArgumentOfMethod(usize),
    /// The error is about this key of an option map among the arguments.
    Key(String),
}

impl ScriptError {
    /// The error of a wrong request by the script.
    pub fn new(message: impl Into<String>) -> Self {
        let message = brief(message.into());
        Self::Failure(Failure { message, hint: None, place: CallPart::Call })
    }

    /// The error of a mistake of this program.
    pub fn bug(message: impl Into<String>) -> Self {
        Self::Bug(message.into())
    }

    /// Adds to the error what to do about it.
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        if let Self::Failure(failure) = &mut self {
            failure.hint = Some(brief(hint.into()));
        }
        self
    }

    /// Adds what to do about an error of the layers below that caused it, if there is advice on that.
    pub fn advised(self, cause: &(dyn std::error::Error + 'static)) -> Self {
        match advice::on(cause) {
            Some(advice) => self.hint(advice),
            None => self,
        }
    }

    /// Makes the error point at an argument or a key instead of the call.
    pub fn at(mut self, place: CallPart) -> Self {
        if let Self::Failure(failure) = &mut self {
            failure.place = place;
        }
        self
    }

    /// The same error of a method, whose arguments are counted behind its dot.
    pub fn of_method(mut self) -> Self {
        if let Self::Failure(Failure { place, .. }) = &mut self
            && let CallPart::Argument(number) = *place
        {
            *place = CallPart::ArgumentOfMethod(number);
        }
        self
    }

    /// The same error in the form in which the engine carries it, at the position of the call.
    pub fn into_engine(self, call: Position) -> Box<EvalAltResult> {
        match self {
            Self::Failure(failure) => {
                EvalAltResult::ErrorRuntime(Dynamic::from(failure), call).into()
            }
            Self::Stopped(stop) => EvalAltResult::ErrorTerminated(Dynamic::from(stop), call).into(),
            Self::Bug(message) => EvalAltResult::ErrorSystem(message, BUG.into()).into(),
            Self::Engine(error) => error,
        }
    }
}

/// Errors of the layers below become failures with their own words and what to do about them; those that a script function has caused are
/// handed on as its own.
impl<E: std::error::Error + 'static> From<E> for ScriptError {
    fn from(error: E) -> Self {
        match Raised::behind(&error) {
            Some(raised) => Self::Engine(raised),
            None => Self::new(error.to_string()).advised(&error),
        }
    }
}

/// The result of the engine's own functions: a value, or an error with its place in the script.
pub type EngineResult<T> = Result<T, Box<EvalAltResult>>;

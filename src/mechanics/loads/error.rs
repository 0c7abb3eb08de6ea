//! Errors of schedules.

use std::error::Error;
use std::fmt;
use std::rc::Rc;

use crate::elementary::rounded_to;

/// Error of a script function, which is displayed unchanged and can be downcast to its type.
#[derive(Debug, Clone)]
pub struct FunctionError(Rc<dyn Error>);

impl FunctionError {
    /// Wraps an error of any type, or a message.
    pub fn new(error: impl Into<Box<dyn Error>>) -> Self {
        Self(error.into().into())
    }
}

impl PartialEq for FunctionError {
    fn eq(&self, other: &Self) -> bool {
        self.0.to_string() == other.0.to_string()
    }
}

impl fmt::Display for FunctionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl Error for FunctionError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        Some(&*self.0)
    }
}

/// Error for a schedule that is invalid or has no value at some time.
#[expect(missing_docs, reason = "the messages describe the variants and their fields")]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LoadError {
    #[error("{schedule}: {name} is {value}, but must be {allowed}")]
    Value { schedule: &'static str, name: &'static str, value: f64, allowed: &'static str },
    #[error("the length without force becomes {}, but must not be negative", rounded_to(6, *length))]
    NegativeLength { length: f64 },
    #[error("a schedule has {parts} parts, but at most {most} can be combined")]
    TooManyParts { parts: usize, most: usize },
    #[error("table: {rows} rows given, but at least 2 are needed, each with a time and a factor")]
    ShortTable { rows: usize },
    #[error(
        "table: the time of row {row} ({time}) is smaller than the previous one ({before}); times must not decrease (repeat a time for a jump)"
    )]
    DecreasingTimes {
        row: usize,
        /// Time in the invalid row of a table [time].
        time: f64,
        /// Time in the previous row of the table [time].
        before: f64,
    },
    #[error("a stored schedule has missing or superfluous terms")]
    StoredTerms,
    #[error(
        "it jumps at t = {time} from {before} to {after}, but a prescribed motion must be continuous"
    )]
    Jump {
        /// Time of the jump [time].
        time: f64,
        /// Value before the jump [length, rad].
        before: f64,
        /// Value after the jump [length, rad].
        after: f64,
    },
    #[error("its rate is infinite at t = {time}, but must be finite")]
    InfiniteRate {
        /// Time at which the rate is infinite [time].
        time: f64,
    },
    #[error(transparent)]
    Function(FunctionError),
    #[error("the schedule is {value} at t = {}, but it must be finite", rounded_to(6, *time))]
    NotFinite {
        /// Time at which the value is not finite [time].
        time: f64,
        /// Value of the schedule that is not finite [-].
        value: f64,
    },
}

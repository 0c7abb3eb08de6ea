//! What can be wrong with a schedule.

use std::error::Error;
use std::fmt;
use std::rc::Rc;

/// What a function of time from outside failed with, as it was made; it is told as that, and may be taken apart by who knows its type.
#[derive(Debug, Clone)]
pub struct FunctionError(Rc<dyn Error>);

impl FunctionError {
    /// An error of any type, or its words alone.
    pub fn new(error: impl Into<Box<dyn Error>>) -> Self {
        Self(error.into().into())
    }
}

/// Failures are equal that are told alike.
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

/// It is nothing but its cause.
impl Error for FunctionError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        Some(&*self.0)
    }
}

/// A schedule that makes no sense, or has no value at some time.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LoadError {
    /// A number that must be finite, or lie in a range.
    #[error("{schedule}: {name} is {value}, but must be {allowed}")]
    Value {
        /// The kind of schedule.
        schedule: &'static str,
        /// The parameter.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it may be.
        allowed: &'static str,
    },
    /// A combination that is too large to be evaluated in every step.
    #[error("a schedule of {parts} parts, but at most {most} can be combined")]
    ManyParts {
        /// Its parts.
        parts: usize,
        /// Most that are allowed.
        most: usize,
    },
    /// A table with too few rows.
    #[error("table: {rows} rows, but at least 2 are needed, each a time and a factor")]
    ShortTable {
        /// Rows given.
        rows: usize,
    },
    /// A table whose times decrease.
    #[error(
        "table: the time of row {row} ({time}) is smaller than the one before it ({before}); times must not decrease (repeat one for a jump)"
    )]
    DecreasingTimes {
        /// Row, from 0.
        row: usize,
        /// Its time.
        time: f64,
        /// The time before it.
        before: f64,
    },
    /// Stored terms of which some are missing or left over.
    #[error("a stored schedule has terms missing or left over")]
    StoredTerms,
    /// A function that failed.
    #[error(transparent)]
    Function(FunctionError),
    /// A value that is not finite.
    #[error("the schedule is {value} at t = {time}, but a load must be finite")]
    NotFinite {
        /// When.
        time: f64,
        /// What it is.
        value: f64,
    },
}

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
    /// A number of a schedule that must be finite, or lie in a range.
    #[error("{schedule}: {name} is {value}, but must be {allowed}")]
    Value {
        /// The kind of schedule with the refused number.
        schedule: &'static str,
        /// The name of the refused parameter of a schedule.
        name: &'static str,
        /// The value of the refused parameter, in its unit.
        value: f64,
        /// The values that the refused parameter may have, in words.
        allowed: &'static str,
    },
    /// A combination that is too large to be evaluated in every step.
    #[error("a schedule of {parts} parts, but at most {most} can be combined")]
    ManyParts {
        /// The number of schedules that the combined one is made of.
        parts: usize,
        /// The largest number of parts that a combined schedule may have.
        most: usize,
    },
    /// A table with too few rows.
    #[error("table: {rows} rows, but at least 2 are needed, each a time and a factor")]
    ShortTable {
        /// The number of rows given for the table of a schedule.
        rows: usize,
    },
    /// A table of a schedule whose times decrease.
    #[error(
        "table: the time of row {row} ({time}) is smaller than the one before it ({before}); times must not decrease (repeat one for a jump)"
    )]
    DecreasingTimes {
        /// The index of the row whose time is earlier than the one before it, from 0.
        row: usize,
        /// The time of the row that comes too late in the table [time].
        time: f64,
        /// The time of the row before, which is later [time].
        before: f64,
    },
    /// The stored terms of a schedule of which some are missing or left over.
    #[error("a stored schedule has terms missing or left over")]
    StoredTerms,
    /// A motion that jumps.
    #[error("it jumps at t = {time} from {before} to {after}, and a motion has to be continuous")]
    Jump {
        /// The time at which the motion jumps [time].
        time: f64,
        /// The value just before the jump [length, rad].
        before: f64,
        /// The value just after the jump [length, rad].
        after: f64,
    },
    /// A motion with an infinite rate.
    #[error("its rate is infinite at t = {time}, as that of √t is at 0")]
    InfiniteRate {
        /// The time at which the rate of the motion is infinite [time].
        time: f64,
    },
    /// A function that failed.
    #[error(transparent)]
    Function(FunctionError),
    /// A value of a schedule that is not finite.
    #[error("the schedule is {value} at t = {time}, but it must be finite")]
    NotFinite {
        /// The time at which the schedule has no finite value [time].
        time: f64,
        /// The value of the schedule that is not finite [-].
        value: f64,
    },
}

//! What can be wrong with a schedule.

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
    #[error(
        "a schedule of {parts} parts, but at most {most} can be combined; write it as schedule(|t| …)"
    )]
    ManyParts {
        /// Its parts.
        parts: usize,
        /// Most that are allowed.
        most: usize,
    },
    /// A table with too few rows.
    #[error("table: {rows} rows, but at least 2 are needed: [[t, factor], …]")]
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
    #[error("{0}")]
    Function(String),
    /// A value that is not finite.
    #[error("the schedule is {value} at t = {time}, but a load must be finite")]
    NotFinite {
        /// When.
        time: f64,
        /// What it is.
        value: f64,
    },
}

//! What can be wrong with a schedule.

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
    /// A combined schedule that is too large to be evaluated in every step.
    #[error(
        "a schedule of {parts} parts, but at most {most} can be combined; write it as schedule(|t| …)"
    )]
    ManyParts {
        /// The number of schedules that the combined one is made of.
        parts: usize,
        /// The largest number of parts that a combined schedule may have.
        most: usize,
    },
    /// A table of a schedule with too few rows.
    #[error("table: {rows} rows, but at least 2 are needed: [[t, factor], …]")]
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
    /// A function of a schedule that failed, with its reason in words.
    #[error("{0}")]
    Function(String),
    /// A value of a schedule that is not finite.
    #[error("the schedule is {value} at t = {time}, but a load must be finite")]
    NotFinite {
        /// The time at which the schedule has no finite value [time].
        time: f64,
        /// The value of the schedule that is not finite [-].
        value: f64,
    },
}

//! What became of a run.

use serde::{Deserialize, Serialize};

/// How a run of a study ended.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum CaseOutcome {
    /// The run came to its end.
    Finished,
    /// The run could not start or not go on.
    Failed {
        /// The end of the last good step of the failed run [time].
        time: f64,
        /// The reason why the run failed, in words.
        reason: String,
    },
    /// The run took more than a study lets a case take.
    GaveUp {
        /// The end of the last good step of the run that was given up [time].
        time: f64,
        /// What the run took too much of, in words.
        limit: String,
    },
    /// The run met a bug of withy.
    Panicked {
        /// The message of the bug.
        message: String,
    },
}

impl CaseOutcome {
    /// Whether the run came to its end.
    pub fn is_finished(&self) -> bool {
        *self == Self::Finished
    }

    /// The outcome in a few words.
    pub fn describe(&self) -> String {
        match self {
            Self::Finished => "finished".to_owned(),
            Self::Failed { time, reason } => format!("failed at t = {time}: {reason}"),
            Self::GaveUp { time, limit } => format!("ran out of patience at t = {time}: {limit}"),
            Self::Panicked { message } => {
                format!("a bug of withy stopped it, please report it: {message}")
            }
        }
    }
}

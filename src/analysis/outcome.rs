//! What became of a run.

use serde::{Deserialize, Serialize};

/// How a run of a study ended.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Outcome {
    /// It came to its end.
    Finished,
    /// It could not start or not go on.
    Failed {
        /// The end of its last good step [time].
        time: f64,
        /// Why.
        reason: String,
    },
    /// It took more than a study lets a case take.
    GaveUp {
        /// The end of its last good step [time].
        time: f64,
        /// What it took too much of.
        limit: String,
    },
    /// A bug of withy.
    Panicked {
        /// Its message.
        message: String,
    },
}

impl Outcome {
    /// Whether the run came to its end.
    pub fn is_finished(&self) -> bool {
        *self == Self::Finished
    }

    /// In a few words.
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

//! Outcomes of runs.

use serde::{Deserialize, Serialize};

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum CaseOutcome {
    Finished,
    Failed {
        /// End of the last successful step [time].
        time: f64,
        reason: String,
    },
    LimitExceeded {
        /// End of the last successful step [time].
        time: f64,
        limit: String,
    },
    Panicked {
        message: String,
    },
}

impl CaseOutcome {
    pub fn is_finished(&self) -> bool {
        *self == Self::Finished
    }

    pub fn describe(&self) -> String {
        match self {
            Self::Finished => "finished".to_owned(),
            Self::Failed { time, reason } => format!("failed at t = {time}: {reason}"),
            Self::LimitExceeded { time, limit } => {
                format!("stopped at t = {time} by a limit: {limit}")
            }
            Self::Panicked { message } => {
                format!("stopped by an internal error of withy, please report it: {message}")
            }
        }
    }
}

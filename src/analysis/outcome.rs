//! Outcomes of runs.

use serde::{Deserialize, Serialize};

/// Outcome of a run of a study.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum CaseOutcome {
    /// The run completed.
    Finished,
    /// The run could not start or continue.
    Failed {
        /// End of the last successful step [time].
        time: f64,
        /// Reason.
        reason: String,
    },
    /// The run exceeded the limits of a case.
    LimitExceeded {
        /// End of the last successful step [time].
        time: f64,
        /// Description of the exceeded limit.
        limit: String,
    },
    /// The run panicked because of a bug.
    Panicked {
        /// Panic message.
        message: String,
    },
}

impl CaseOutcome {
    /// Returns true if the run completed.
    pub fn is_finished(&self) -> bool {
        *self == Self::Finished
    }

    /// Short description.
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

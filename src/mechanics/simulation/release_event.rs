//! Release that was executed during a run.

use serde::{Deserialize, Serialize};

/// Executed release.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ReleaseEvent {
    /// Index of the release in the scene.
    pub release: usize,
    /// Time of the release [time], which is the end of one step and the start of the next step.
    pub time: f64,
}

//! What has let go in a run.

use serde::{Deserialize, Serialize};

/// A release that has happened.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ReleaseEvent {
    /// The index of the release in the scene.
    pub release: usize,
    /// When something let go: the end of a step, and the start of the next one [time].
    pub time: f64,
}

//! Releases during a run.

use serde::{Deserialize, Serialize};

/// Executed release.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ReleaseEvent {
    /// Index of the release in the scene.
    pub release: usize,
    /// Time of the release, between two steps [time].
    pub time: f64,
}

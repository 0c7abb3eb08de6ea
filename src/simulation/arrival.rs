//! Sliders that reach the end of their masters.

use serde::{Deserialize, Serialize};

use crate::model::TrackLimit;

/// What happened to a slider at the end of its master.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum ArrivalKind {
    /// The run ended.
    Stopped,
    /// It bounced off.
    Bounced,
    /// It came to rest against the stop.
    Rested,
    /// It left the master.
    Released,
}

/// A slider reached the end of its master.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Arrival {
    /// When.
    pub time: f64,
    /// Which slider, and which end.
    pub limit: TrackLimit,
    /// What came of it.
    pub kind: ArrivalKind,
}

impl ArrivalKind {
    /// A word for scripts.
    pub fn name(self) -> &'static str {
        match self {
            Self::Stopped => "stopped",
            Self::Bounced => "bounced",
            Self::Rested => "rested",
            Self::Released => "released",
        }
    }
}

impl Arrival {
    /// In words: `slider 'ring' bounced off the end of its beam at t = 1.5`.
    pub fn describe(&self, slider: &str) -> String {
        let end = self.limit.end.name();
        let did = match self.kind {
            ArrivalKind::Stopped => "reached",
            ArrivalKind::Bounced => "bounced off",
            ArrivalKind::Rested => "came to rest against",
            ArrivalKind::Released => "left over",
        };
        format!("slider '{slider}' {did} the {end} of its beam at t = {}", self.time)
    }
}

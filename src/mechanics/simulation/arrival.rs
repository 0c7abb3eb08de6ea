//! Sliders that reach the end of their masters.

use serde::{Deserialize, Serialize};

use crate::geometry::Vec2;
use crate::system::MasterLimit;

/// What happened to a slider at the end of its master.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum ArrivalKind {
    /// The slider reached the end of its master, and the run ended.
    Stopped,
    /// The slider bounced off the end of its master.
    Bounced,
    /// The slider came to rest against the stop at the end of its master.
    Rested,
    /// The slider left its master at the end.
    Released,
    /// The slider passed a seam of its track, from one beam to the next.
    Passed,
}

/// The arrival of a slider at the end of its master.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Arrival {
    /// The time of the arrival [time].
    pub time: f64,
    /// The slider that arrived, and the end of its master.
    pub limit: MasterLimit,
    /// The beam of that end, by its index, for a slider on a track.
    pub beam: Option<usize>,
    /// What happened to the slider at the end.
    pub kind: ArrivalKind,
    /// What the slider gave its master in the impact there, that is no part of contact forces [mass·length/time].
    pub impulse: Vec2,
}

impl ArrivalKind {
    /// The kind of arrival in a word for scripts, such as `bounced`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Stopped => "stopped",
            Self::Bounced => "bounced",
            Self::Rested => "rested",
            Self::Released => "released",
            Self::Passed => "passed",
        }
    }
}

impl Arrival {
    /// The arrival in words: `slider 'ring' bounced off the end of its beam at t = 1.5`; the beam is named where the slider is on a track.
    pub fn describe(&self, slider: &str, beam: Option<&str>) -> String {
        let end = self.limit.end.name();
        let beam = beam.map_or_else(|| "its beam".to_owned(), |name| format!("beam '{name}'"));
        let did = match self.kind {
            ArrivalKind::Stopped => "reached",
            ArrivalKind::Bounced => "bounced off",
            ArrivalKind::Rested => "came to rest against",
            ArrivalKind::Released => "left over",
            ArrivalKind::Passed => "passed",
        };
        format!("slider '{slider}' {did} the {end} of {beam} at t = {}", self.time)
    }
}

//! Arrivals of sliders at the ends of their masters.

use serde::{Deserialize, Serialize};

use crate::geometry::Vec2;
use crate::system::MasterLimit;

/// Outcome of the arrival of a slider at an end of its master.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum ArrivalKind {
    /// The run ended.
    Stopped,
    /// The slider bounced.
    Bounced,
    /// The slider is held at the stop.
    Held,
    /// The slider was released.
    Released,
    /// The slider passed a seam of its track.
    Passed,
}

/// Arrival of a slider at an end of its master.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Arrival {
    /// Time of the arrival [time].
    pub time: f64,
    /// Slider and end of its master.
    pub limit: MasterLimit,
    /// Index of the beam on which a slider on a track arrived; `None` for other sliders.
    pub beam: Option<usize>,
    /// Outcome of the arrival.
    pub kind: ArrivalKind,
    /// Impulse on the master in the impact [mass·length/time]. The contact forces do not contain it.
    pub impulse: Vec2,
}

impl ArrivalKind {
    /// Outcome in scripts, such as `bounced`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Stopped => "stopped",
            Self::Bounced => "bounced",
            Self::Held => "rested",
            Self::Released => "released",
            Self::Passed => "passed",
        }
    }
}

impl Arrival {
    /// Description such as `slider 'ring' bounced off the end of its beam at t = 1.5`. For sliders on tracks it contains the name of the beam.
    pub fn describe(&self, slider: &str, beam: Option<&str>) -> String {
        let end = self.limit.end.name();
        let beam = beam.map_or_else(|| "its beam".to_owned(), |name| format!("beam '{name}'"));
        let did = match self.kind {
            ArrivalKind::Stopped => "reached",
            ArrivalKind::Bounced => "bounced off",
            ArrivalKind::Held => "came to rest against",
            ArrivalKind::Released => "was released at",
            ArrivalKind::Passed => "passed",
        };
        format!(
            "slider '{slider}' {did} the {end} of {beam} at t = {}",
            crate::system::rounded(self.time)
        )
    }
}

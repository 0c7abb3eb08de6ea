//! Arrivals of sliders at the ends of their masters, take-offs and landings.

use serde::{Deserialize, Serialize};

use crate::geometry::Vec2;
use crate::system::MasterEnd;

/// Outcome of the arrival of a slider at an end of its master, or on the axis of its master.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum ArrivalKind {
    /// The run ended.
    Stopped,
    /// The slider bounced.
    Bounced,
    /// A stop holds the slider at the end of its master.
    Held,
    /// The slider was released.
    Released,
    /// The slider passed from one beam of its track to the next.
    /// This kind also applies if a slider in flight crosses the extension of the axis of its master beyond an end, without contact.
    Passed,
    /// The slider left the axis of its master.
    TookOff,
    /// The slider reached the axis of its master, and is in contact with it.
    Landed,
}

/// Arrival of a slider at an end of its master, take-off or landing.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Arrival {
    /// Time of the arrival [time].
    pub time: f64,
    /// Index of the slider.
    pub slider: usize,
    /// End of the master at which the slider arrived; `None` for a take-off, a landing, or another event on the axis of the master.
    pub end: Option<MasterEnd>,
    /// Index of the beam on which a slider on a track arrived; `None` for other sliders.
    pub beam: Option<usize>,
    /// Outcome of the arrival.
    pub kind: ArrivalKind,
    /// Impulse on the master in the impact [mass·length/time]. The contact forces do not contain this impulse.
    pub impulse: Vec2,
}

impl ArrivalKind {
    /// Name of the outcome in scripts, such as `bounced`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Stopped => "stopped",
            Self::Bounced => "bounced",
            Self::Held => "rested",
            Self::Released => "released",
            Self::Passed => "passed",
            Self::TookOff => "took off",
            Self::Landed => "landed",
        }
    }
}

impl Arrival {
    /// Description of the arrival, such as `slider 'ring' bounced off the end of its beam at t = 1.5`.
    pub fn describe(&self, slider: &str, beam: Option<&str>) -> String {
        let end = self.end.map_or_else(String::new, |end| format!("the {} of ", end.name()));
        let beam = beam.map_or_else(|| "its beam".to_owned(), |name| format!("beam '{name}'"));
        let did = match self.kind {
            ArrivalKind::Stopped => "reached",
            ArrivalKind::Bounced => "bounced off",
            ArrivalKind::Held => "came to rest against",
            ArrivalKind::Released => "was released at",
            ArrivalKind::Passed => "passed",
            ArrivalKind::TookOff => "left",
            ArrivalKind::Landed => "landed on",
        };
        format!("slider '{slider}' {did} {end}{beam} at t = {}", crate::system::rounded(self.time))
    }
}

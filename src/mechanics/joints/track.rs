//! Tracks: consecutive beams along which a slider moves.

use serde::{Deserialize, Serialize};

/// Beams that meet end to end. A slider passes from one beam to the next. On a closed track, the number of rounds is not limited.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Track {
    /// Name of the track in messages.
    pub name: String,
    /// Beams in the order of the track; at least one beam.
    pub beams: Vec<TrackBeam>,
    /// Continuation of the track after its last beam.
    pub end: TrackEnd,
}

/// Beam of a track.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct TrackBeam {
    /// Index of the beam.
    pub beam: usize,
    /// Direction of the track along the beam.
    pub heading: TrackDirection,
}

/// Direction of a track along one of its beams.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum TrackDirection {
    /// The track leads from the start of the beam to its end.
    Forward,
    /// The track leads from the end of the beam to its start.
    Backward,
}

/// Continuation of a track after its last beam.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum TrackEnd {
    /// The track ends.
    Open,
    /// The track continues along its first beam.
    Closed,
}

impl Track {
    /// Indices of the beams in the order of the track.
    pub fn beams(&self) -> impl Iterator<Item = usize> + '_ {
        self.beams.iter().map(|leg| leg.beam)
    }
}

impl TrackDirection {
    pub(crate) fn reversed(self) -> Self {
        match self {
            Self::Forward => Self::Backward,
            Self::Backward => Self::Forward,
        }
    }

    /// Converts an arc length along the track to an arc length along the beam, or vice versa [length].
    /// The arc length along the track starts where the track enters the beam.
    /// The arc length along the beam starts at the start of the beam.
    pub fn along(self, length: f64, arc_length: f64) -> f64 {
        match self {
            Self::Forward => arc_length,
            Self::Backward => length - arc_length,
        }
    }

    /// Sign that converts a displacement along the track to a displacement towards the end of the beam [-].
    pub fn sign(self) -> f64 {
        match self {
            Self::Forward => 1.0,
            Self::Backward => -1.0,
        }
    }
}

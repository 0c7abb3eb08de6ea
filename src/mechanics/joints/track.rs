//! Tracks: several beams, one after the other, along which something slides.

use serde::{Deserialize, Serialize};

/// Beams that meet end to end, along which a slider passes from one to the next, and round and round where the last one leads to the first.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Track {
    /// The name of the track, for messages.
    pub name: String,
    /// The beams of the track in the order in which it leads along them; at least one.
    pub legs: Vec<TrackBeam>,
    /// What becomes of the track behind its last beam.
    pub course: TrackEnd,
}

/// A beam of a track.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct TrackBeam {
    /// The index of the beam.
    pub beam: usize,
    /// How the track leads along the beam.
    pub heading: TrackDirection,
}

/// How a track leads along one of its beams.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum TrackDirection {
    /// From the start of the beam to its end.
    Forward,
    /// From the end of the beam to its start.
    Backward,
}

/// What becomes of a track behind its last beam.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum TrackEnd {
    /// The track ends there.
    Open,
    /// The track goes on along its first beam.
    Closed,
}

impl Track {
    /// The indices of the beams of the track, in its order.
    pub fn beams(&self) -> impl Iterator<Item = usize> + '_ {
        self.legs.iter().map(|leg| leg.beam)
    }
}

impl TrackDirection {
    /// The other way along a beam.
    pub fn reversed(self) -> Self {
        match self {
            Self::Forward => Self::Backward,
            Self::Backward => Self::Forward,
        }
    }

    /// Arc length from the start of a beam of such a length, for arc length counted from where the track enters it; its own inverse [length].
    pub fn along(self, length: f64, arc_length: f64) -> f64 {
        match self {
            Self::Forward => arc_length,
            Self::Backward => length - arc_length,
        }
    }

    /// The sign of a movement along the track that leads towards the end of the beam [-].
    pub fn sign(self) -> f64 {
        match self {
            Self::Forward => 1.0,
            Self::Backward => -1.0,
        }
    }
}

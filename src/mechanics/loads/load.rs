//! Loads and their places.

use serde::{Deserialize, Serialize};

use super::Schedule;
use crate::beams::Station;
use crate::geometry::Vec2;

/// Frame of the direction of a load.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum LoadFrame {
    /// Fixed direction in space.
    #[default]
    Dead,
    /// Follower direction, which rotates with the section. Components are along and across the axis as drawn.
    Follower,
}

/// Kind and place of a load.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum LoadKind {
    /// Force at a station [force].
    Force {
        /// Station of the force.
        station: Station,
        /// Force at a schedule factor of 1 [force].
        force: Vec2,
        /// Frame of its direction.
        frame: LoadFrame,
    },
    /// Moment at a station [force·length].
    Moment {
        /// Station of the moment.
        station: Station,
        /// Moment at a schedule factor of 1, counter-clockwise [force·length].
        moment: f64,
    },
    /// Force per length along a whole beam as drawn [force/length].
    Line {
        /// Index of the beam in its scene.
        beam: usize,
        /// Force per length of the axis as drawn at a schedule factor of 1 [force/length].
        force: Vec2,
        /// Frame of its direction.
        frame: LoadFrame,
    },
}

impl LoadKind {
    /// Quantity, dimension and magnitude at a schedule factor of 1, for columns.
    pub fn measure(&self) -> (&'static str, &'static str, f64) {
        match self {
            Self::Force { force, .. } => ("force", "force", force.norm()),
            Self::Moment { moment, .. } => ("torque", "force·length", *moment),
            Self::Line { force, .. } => ("force", "force/length", force.norm()),
        }
    }
}

/// Load of a scene.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Load {
    /// Name in messages.
    pub name: String,
    /// Kind and place.
    pub kind: LoadKind,
    /// Factor over time.
    pub schedule: Schedule,
    /// Name in columns of histories, which then include its work.
    pub title: Option<String>,
}

//! Loads and the stations or beams at which they act.

use serde::{Deserialize, Serialize};

use super::Schedule;
use crate::beams::Station;
use crate::geometry::Vec2;

/// Frame in which the direction of a load is constant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum LoadFrame {
    /// Fixed direction in space.
    #[default]
    Dead,
    /// Frame of the section (follower load): the direction rotates with the section. Components are along and across the initial axis.
    Follower,
}

/// Type of a load, with its station or beam.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum LoadKind {
    /// Force at a station [force].
    Force {
        /// Station of the force.
        station: Station,
        /// Force at a schedule factor of 1 [force].
        force: Vec2,
        /// Frame in which the direction of the force is constant.
        frame: LoadFrame,
    },
    /// Moment at a station [force·length].
    Moment {
        /// Station of the moment.
        station: Station,
        /// Moment at a schedule factor of 1 [force·length], positive counter-clockwise.
        moment: f64,
    },
    /// Force per initial length along a whole beam [force/length].
    Line {
        /// Index of the beam in its scene.
        beam: usize,
        /// Force per initial length of the axis at a schedule factor of 1 [force/length].
        force: Vec2,
        /// Frame in which the direction of the force is constant.
        frame: LoadFrame,
    },
}

impl LoadKind {
    /// Magnitude of the force, or moment with its sign, at a schedule factor of 1 [force, force·length, force/length].
    pub fn magnitude(&self) -> f64 {
        match self {
            Self::Force { force, .. } | Self::Line { force, .. } => force.norm(),
            Self::Moment { moment, .. } => *moment,
        }
    }
}

/// Load of a scene.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Load {
    /// Name of the load in messages.
    pub name: String,
    /// Type of the load, with its station or beam.
    pub kind: LoadKind,
    /// Load factor as a function of time.
    pub schedule: Schedule,
    /// Name of the load in the columns of histories, which then contain the value and the work of the load; `None` for loads without columns.
    pub title: Option<String>,
}

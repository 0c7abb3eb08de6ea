//! What acts on a beam, and where.

use serde::{Deserialize, Serialize};

use super::Schedule;
use crate::beams::Station;
use crate::geometry::Vec2;

/// What the direction of a load is tied to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum LoadFrame {
    /// The load is tied to space: it keeps its direction.
    #[default]
    Dead,
    /// The load is tied to the section and turns with it. Components are along the axis as drawn and across it.
    Follower,
}

/// What a load is and where it acts.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum LoadKind {
    /// A force at a station [force].
    Force {
        /// The station at which the force acts.
        station: Station,
        /// The force while the schedule is 1 [force].
        force: Vec2,
        /// What the direction of the force is tied to.
        frame: LoadFrame,
    },
    /// A moment at a station [force·length].
    Moment {
        /// The station at which the moment acts.
        station: Station,
        /// The moment while the schedule is 1, counter-clockwise [force·length].
        moment: f64,
    },
    /// A force per length of a whole beam as drawn [force/length].
    Line {
        /// The index, in its scene, of the beam with the line load.
        beam: usize,
        /// The force per length of the axis as drawn while the schedule is 1 [force/length].
        force: Vec2,
        /// What the direction of the line load is tied to.
        frame: LoadFrame,
    },
}

impl LoadKind {
    /// What is told of the load in columns: what it is, its dimension, and its size while the schedule is 1.
    pub fn measure(&self) -> (&'static str, &'static str, f64) {
        match self {
            Self::Force { force, .. } => ("force", "force", force.norm()),
            Self::Moment { moment, .. } => ("torque", "force·length", *moment),
            Self::Line { force, .. } => ("force", "force/length", force.norm()),
        }
    }
}

/// A load of a scene.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Load {
    /// The name of the load, for messages.
    pub name: String,
    /// What the load is and where it acts.
    pub kind: LoadKind,
    /// The schedule of the load: a factor over time.
    pub schedule: Schedule,
    /// What the load is called in columns of histories, which have its work then.
    pub title: Option<String>,
}

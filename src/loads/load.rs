//! What acts on a beam, and where.

use serde::{Deserialize, Serialize};

use super::Schedule;
use crate::beams::Station;
use crate::geometry::Vec2;

/// What the direction of a load is tied to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Frame {
    /// To space: the load keeps its direction.
    #[default]
    Dead,
    /// To the section: the load turns with it. Components are along the axis as drawn and across it.
    Follower,
}

/// The kinds of load.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum LoadKind {
    /// A force at a station [force].
    Force {
        /// Where.
        station: Station,
        /// Its value while the schedule is 1.
        force: Vec2,
        /// What it is tied to.
        frame: Frame,
    },
    /// A moment at a station [force·length].
    Moment {
        /// Where.
        station: Station,
        /// Its value while the schedule is 1, counter-clockwise.
        moment: f64,
    },
    /// A force per length of a whole beam as drawn [force/length].
    Line {
        /// The index of the beam in its scene.
        beam: usize,
        /// Its value while the schedule is 1.
        force: Vec2,
        /// What it is tied to.
        frame: Frame,
    },
}

/// A load of a scene.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Load {
    /// For messages.
    pub name: String,
    /// What and where.
    pub kind: LoadKind,
    /// When.
    pub schedule: Schedule,
}

//! Joints that tie whole components of movement, so that the tied ones share an unknown.
//!
//! Both partners then have the same increments at every step, whatever the method: the joint has no gap, does no
//! work, and passes on force and moment unchanged.

use serde::{Deserialize, Serialize};

use crate::beams::Station;

/// A component of the movement of a section.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Component {
    /// Along the first axis.
    X,
    /// Along the second axis.
    Y,
    /// About the third.
    Rotation,
}

impl Component {
    /// All of them, in the order of a movement.
    pub const ALL: [Self; 3] = [Self::X, Self::Y, Self::Rotation];
}

/// Which components a joint ties.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum JointKind {
    /// Positions; sections turn freely against each other.
    Hinge,
    /// Positions and rotations; the angle between the sections stays as drawn. With the ground: a clamp.
    Rigid,
}

/// What a station is tied to.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Partner {
    /// The ground, at the place of the station as drawn.
    Ground,
    /// A station at the same place, of another beam or of the same one.
    Station(Station),
}

/// A joint of a scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Joint {
    /// For messages.
    pub name: String,
    /// What it ties.
    pub kind: JointKind,
    /// The station that is tied.
    pub station: Station,
    /// What it is tied to.
    pub partner: Partner,
}

impl JointKind {
    /// The components that it ties.
    pub fn components(self) -> &'static [Component] {
        match self {
            Self::Hinge => &Component::ALL[..2],
            Self::Rigid => &Component::ALL,
        }
    }

    /// In words.
    pub fn describe(self, partner: &Partner) -> &'static str {
        match (self, partner) {
            (Self::Hinge, _) => "hinge",
            (Self::Rigid, Partner::Ground) => "clamp",
            (Self::Rigid, Partner::Station(_)) => "rigid joint",
        }
    }
}

//! Sliding joints as a scene describes them.

use serde::{Deserialize, Serialize};

use super::SlidingRule;
use crate::beams::Station;

/// A point that stays on the axis of a beam and slides along it without friction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Slider {
    /// The name of the slider, for messages and the columns of the history.
    pub name: String,
    /// The slave of the slider: the point that slides.
    pub slave: Station,
    /// The index of the master of the slider: the beam on which it slides, or starts to slide where that is one of a track.
    pub master: usize,
    /// The index of the track along which the slider passes from beam to beam, if it does.
    pub track: Option<usize>,
    /// The arc length at which the slider starts on its master, as drawn [length].
    pub arc_length: f64,
    /// The law by which a step keeps the slider on its master.
    pub rule: SlidingRule,
    /// What happens when the slider reaches an end of its master, or of its track.
    pub ends: EndAction,
    /// How much of the speed with which the slider strikes an end it has when it leaves, from 0 to 1, where it bounces [-].
    pub restitution: f64,
    /// What happens to start velocities with which the slider would leave its master.
    pub velocities: StartVelocities,
}

impl Slider {
    /// Returns a slider on a beam, at an arc length of the undeformed beam [length], with the default rule and the
    /// default action at the ends.
    pub fn new(name: impl Into<String>, slave: Station, master: usize, arc_length: f64) -> Self {
        Self {
            name: name.into(),
            slave,
            master,
            track: None,
            arc_length,
            rule: SlidingRule::default(),
            ends: EndAction::default(),
            restitution: 1.0,
            velocities: StartVelocities::default(),
        }
    }
}

/// What happens when a slider reaches an end of its master.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum EndAction {
    /// The run ends when the slider reaches the end.
    #[default]
    Stop,
    /// The slider bounces off a stop at the end, by its coefficient of restitution; momenta are kept.
    Bounce,
    /// The slider stays in contact with a stop at the end until the contact force would be tensile. Waves in the elastic bodies, which
    /// steps must resolve, determine the rebound.
    Contact,
    /// The slider leaves its master at the end and flies free.
    Release,
}

impl EndAction {
    /// Returns true if a stop at the end keeps the slider on its master.
    pub fn has_stop(self) -> bool {
        matches!(self, Self::Bounce | Self::Contact)
    }
}

/// What happens to start velocities across the master, at which a slider would leave it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum StartVelocities {
    /// Start velocities across the master are an error.
    #[default]
    Check,
    /// Instead of start velocities across the master the nearest ones without them are taken, in the norm of the kinetic energy.
    Project,
}

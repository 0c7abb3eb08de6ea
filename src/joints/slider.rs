//! Sliding joints as a scene describes them.

use serde::{Deserialize, Serialize};

use super::SlidingRule;
use crate::beams::Station;

/// A point that stays on the axis of a beam and slides along it without friction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Slider {
    /// For messages and the columns of the history.
    pub name: String,
    /// The point that slides: the slave.
    pub slave: Station,
    /// The index of the beam on which it slides: the master.
    pub master: usize,
    /// Where on the master it starts: arc length as drawn [length].
    pub arc_length: f64,
    /// How a step keeps it there.
    pub rule: SlidingRule,
    /// What happens where the master ends.
    pub ends: EndAction,
    /// What happens to start velocities that would leave the master.
    pub velocities: StartVelocities,
}

/// What happens when a slider reaches an end of its master.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum EndAction {
    /// The run ends there.
    #[default]
    Stop,
    /// It bounces off an elastic stop; energy and momenta are kept.
    Bounce,
    /// It leaves the master and flies free.
    Release,
}

/// What happens to start velocities across the master, at which a slider would leave it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum StartVelocities {
    /// They are an error.
    #[default]
    Check,
    /// The nearest velocities without them are taken, in the norm of the kinetic energy.
    Project,
}

//! Sliding joints as described by a scene.

use serde::{Deserialize, Serialize};

use super::SlidingRule;
use crate::beams::Station;

/// Point that stays on the axis of a beam and slides along it, with or without friction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Slider {
    /// Name in messages and columns.
    pub name: String,
    /// Slave: the sliding point.
    pub slave: Station,
    /// Index of the master beam; on a track, of the beam at the start.
    pub master: usize,
    /// Index of the track; `None` for a slider on a single beam.
    pub track: Option<usize>,
    /// Initial arc length on the master as drawn [length].
    pub arc_length: f64,
    /// Sliding rule.
    pub rule: SlidingRule,
    /// Behaviour at the ends of its master or track.
    pub ends: EndAction,
    /// Coefficient of restitution at the ends, from 0 to 1 [-].
    pub restitution: f64,
    /// Coefficient of friction along the master [-].
    pub friction: f64,
    /// Treatment of start velocities across the master.
    pub velocities: StartVelocities,
}

impl Slider {
    /// Returns a slider at an arc length of the undeformed beam [length], with the default rule and the default behaviour at the ends.
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
            friction: 0.0,
            velocities: StartVelocities::default(),
        }
    }

    /// Returns true if the slider loses energy at its ends or by friction.
    pub fn dissipates(&self) -> bool {
        self.restitution < 1.0 || self.friction > 0.0
    }
}

/// Behaviour of a slider at the ends of its master.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum EndAction {
    /// The run ends.
    #[default]
    Stop,
    /// The slider bounces with its coefficient of restitution. Momenta are conserved.
    Bounce,
    /// The slider stays at a stop at the end until the contact force becomes tensile. Waves in the elastic bodies, which the steps must resolve,
    /// determine the rebound.
    Contact,
    /// The slider is released from its master.
    Release,
}

impl EndAction {
    /// Returns true if a stop at the end keeps the slider on its master.
    pub(crate) fn has_stop(self) -> bool {
        matches!(self, Self::Bounce | Self::Contact)
    }
}

/// Treatment of start velocities across the master.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum StartVelocities {
    /// Start velocities across the master are rejected.
    #[default]
    Check,
    /// Start velocities across the master are removed by the smallest change in the norm of the kinetic energy.
    Project,
}

//! Sliding joints in a scene.

use serde::{Deserialize, Serialize};

use super::SlidingRule;
use crate::beams::Station;

/// Point that stays on the axis of a beam and slides along the axis, with or without friction.
/// A one-sided slider can only push its master, and may leave the axis of the master on its side.
/// A sleeve also keeps the angle between the slave and the master constant.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Slider {
    /// Name of the slider in messages and columns.
    pub name: String,
    /// Slave: the sliding point.
    pub slave: Station,
    /// Index of the master beam. For a slider on a track, it is the index of the beam on which the slider starts.
    pub master: usize,
    /// Index of the track; `None` for a slider on a single beam.
    pub track: Option<usize>,
    /// Initial arc length of the slider along the master [length].
    pub arc_length: f64,
    /// Sliding rule of the slider.
    pub rule: SlidingRule,
    /// Behaviour of the slider at the ends of the master or track.
    pub ends: EndAction,
    /// Coefficient of restitution at the ends, or at landings of a slider with a side, from 0 to 1 [-].
    pub restitution: f64,
    /// Coefficient of friction along the master [-].
    pub friction: f64,
    /// Coefficient of friction while the slider sticks, at least `friction` [-]; `None` if it equals `friction`.
    pub static_friction: Option<f64>,
    /// Movements of the slave that the slider restrains.
    pub restraint: Restraint,
    /// Treatment of initial velocities of the slave across the master. Velocities and spins of sleeves are always projected.
    pub velocities: StartVelocities,
}

impl Slider {
    /// Returns a slider at an arc length of the undeformed beam [length], with default rule and default behaviour at the ends.
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
            static_friction: None,
            restraint: Restraint::default(),
            velocities: StartVelocities::default(),
        }
    }

    /// Returns true if the slider may lose energy at the ends of its master, by friction, or when it lands on its master.
    pub fn dissipates(&self) -> bool {
        self.restitution < 1.0 || self.has_friction() || self.side().is_some()
    }

    /// Returns true if a coefficient of friction of the slider is not zero.
    pub fn has_friction(&self) -> bool {
        self.friction > 0.0 || self.static_friction.is_some_and(|coefficient| coefficient > 0.0)
    }

    /// Side of the master on which the slave may leave the axis; `None` for a slider that never leaves the axis.
    pub fn side(&self) -> Option<Side> {
        match self.restraint {
            Restraint::OneSided(side) => Some(side),
            Restraint::Place | Restraint::PlaceAndDirection => None,
        }
    }

    /// Returns true if the slider is a sleeve, which also keeps the angle between the slave and the master constant.
    pub fn is_sleeve(&self) -> bool {
        self.restraint == Restraint::PlaceAndDirection
    }
}

/// Movements of the slave relative to the master that a slider restrains.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Restraint {
    /// The slave stays on the axis of the master.
    #[default]
    Place,
    /// The slave may leave the axis on one side.
    OneSided(Side),
    /// Sleeve without length: the slave stays on the axis, and its angle to the section of the master is constant.
    PlaceAndDirection,
}

/// Side of a beam, for an observer who looks along the beam from its start to its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Side {
    /// Left side of the beam.
    Left,
    /// Right side of the beam.
    Right,
}

impl Side {
    /// Name of the side for messages and scripts, such as `left`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
        }
    }

    /// Sign of coordinates along the left normal on this side [-]: 1 on the left, -1 on the right.
    pub fn sign(self) -> f64 {
        match self {
            Self::Left => 1.0,
            Self::Right => -1.0,
        }
    }
}

/// Behaviour of a slider at the ends of its master.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum EndAction {
    /// The run ends.
    #[default]
    Stop,
    /// The slider bounces with its coefficient of restitution. The impact conserves momentum and angular momentum.
    Bounce,
    /// A stop holds the slider at the end until the contact force becomes tensile.
    /// Waves in the elastic bodies determine the rebound, so the steps must resolve these waves.
    Contact,
    /// The slider is released from its master.
    Release,
}

impl EndAction {
    pub(crate) fn has_stop(self) -> bool {
        matches!(self, Self::Bounce | Self::Contact)
    }
}

/// Treatment of initial velocities of the slave across the master.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum StartVelocities {
    /// The scene is rejected if the slave has a velocity across its master.
    #[default]
    Check,
    /// Velocities across the master are removed by the smallest change of all velocities, in the norm of the kinetic energy.
    Project,
}

//! Releases of joints, sliders, springs and drives during a run.

use serde::{Deserialize, Serialize};

/// Object that can be released, with its index among the objects of the same type.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Releasable {
    /// Joint: a hinge, a rigid joint, a clamp or a support.
    Joint(usize),
    /// Slider.
    Slider(usize),
    /// Spring, damper, tendon or brake.
    Spring(usize),
    /// Prescribed motion.
    Drive(usize),
}

/// Event that triggers a release.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Trigger {
    /// Release at the given time of the simulation [time]. A step ends at this time.
    Time(f64),
    /// Release by a call of the user of the simulation, between two steps.
    Outside,
}

/// Release during a run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Release {
    /// Object to be released.
    pub object: Releasable,
    /// Trigger of the release.
    pub trigger: Trigger,
}

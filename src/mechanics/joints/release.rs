//! Joints, sliders, springs and drives that let go in the course of a run.

use serde::{Deserialize, Serialize};

/// What holds something in a scene and may let go of it, by its index among those of its kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Releasable {
    /// A joint: a hinge, a rigid joint, a clamp, a support.
    Joint(usize),
    /// A slider.
    Slider(usize),
    /// A spring, a damper or a tendon.
    Spring(usize),
    /// A motion that is given.
    Drive(usize),
}

/// When something lets go.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Trigger {
    /// At a time after the start, where a step ends [time].
    Time(f64),
    /// When somebody outside says so, between two steps.
    Outside,
}

/// What lets go in the course of a run, and when.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Release {
    /// What lets go.
    pub hold: Releasable,
    /// When it does.
    pub trigger: Trigger,
}

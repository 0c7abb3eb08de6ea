//! The force of an element as an unknown of its own.

use crate::geometry::larger;

/// A force that is an unknown of its own.
#[derive(Debug, Clone, Copy, Default)]
pub struct HiddenForce {
    /// The force of the iterate.
    pub force: f64,
    /// The force of the last step.
    pub last: f64,
    /// What the configuration asks for, less the force.
    pub mismatch: f64,
    /// The derivative by `Δq` of what the configuration asks for.
    pub stiffness: f64,
}

/// What a configuration asks of a force: the force, and its derivative by `Δq`.
#[derive(Debug, Clone, Copy, Default)]
pub struct Target {
    pub force: f64,
    pub stiffness: f64,
}

impl HiddenForce {
    /// Compares it with a configuration; how far it is off, as a part of such a length or angle.
    pub fn compare(&mut self, target: Target, extent: f64) -> f64 {
        self.mismatch = target.force - self.force;
        let size =
            larger(target.stiffness.abs() * extent, larger(target.force.abs(), self.force.abs()));
        if self.mismatch == 0.0 { 0.0 } else { self.mismatch.abs() / size }
    }

    /// Keeps what a configuration asks for, with its derivative, until the correction that follows.
    pub fn linearise(&mut self, target: Target) {
        self.mismatch = target.force - self.force;
        self.stiffness = target.stiffness;
    }

    /// Carries a correction over, to first order: what the configuration asks for then.
    pub fn correct(&mut self, change: f64) {
        self.force += self.mismatch + self.stiffness * change;
    }
}

//! The force of an element as an unknown of its own.

use crate::geometry::larger;

/// A force that is an unknown of its own.
#[derive(Debug, Clone, Copy, Default)]
pub struct MixedForce {
    /// The force of the iterate.
    pub force: f64,
    /// The force of the last step.
    pub last: f64,
    /// What the configuration asks for, less the force.
    pub mismatch: f64,
    /// The derivative by `Δq` of what the configuration asks for, of the last linearisation.
    pub stiffness: f64,
    /// The same of the configuration that was compared last.
    asked: f64,
    /// Where the iteration of the step has been.
    search: IterationState,
}

/// Where the iteration of a step has been: how often it was linearised, and the rate and the force at which it was last.
#[derive(Debug, Clone, Copy, Default)]
struct IterationState {
    linearised: u32,
    at: (f64, f64),
}

/// So many linearisations find what has no corners, and most of what has.
const PATIENCE: u32 = 4;

/// What a configuration asks of a force: the force, and its derivative by `Δq`.
#[derive(Debug, Clone, Copy, Default)]
pub struct ForceTarget {
    pub force: f64,
    pub stiffness: f64,
}

impl MixedForce {
    /// Compares it with a configuration; how far it is off, as a part of such a length or angle.
    pub fn compare(&mut self, target: ForceTarget, extent: f64) -> f64 {
        self.mismatch = target.force - self.force;
        self.asked = target.stiffness;
        let size =
            larger(target.stiffness.abs() * extent, larger(target.force.abs(), self.force.abs()));
        if self.mismatch == 0.0 { 0.0 } else { self.mismatch.abs() / size }
    }

    /// The change of `Δq` after which the configuration that was compared last would ask for the force as it is, to first order; infinite where no
    /// change does.
    pub fn missing_change(&self) -> f64 {
        match self.mismatch == 0.0 {
            true => 0.0,
            false if self.asked > 0.0 => -self.mismatch / self.asked,
            false => f64::INFINITY,
        }
    }

    /// Begins a step with the force of the last one.
    pub fn begin_step(&mut self) {
        self.force = self.last;
        self.search = IterationState::default();
    }

    /// How much the force falls where the rate rises, by all that it acts on, as the last two iterates tell: where the search goes on for long, and
    /// not before.
    pub fn impedance(&mut self, rate: f64) -> Option<f64> {
        let IterationState { linearised, at: (rate_before, force_before) } = self.search;
        self.search = IterationState { linearised: linearised + 1, at: (rate, self.force) };
        let impedance = (force_before - self.force) / (rate - rate_before);
        (linearised >= PATIENCE && impedance > 0.0 && impedance.is_finite()).then_some(impedance)
    }

    /// Keeps what a configuration asks for, with its derivative, until the correction that follows.
    pub fn linearise(&mut self, target: ForceTarget) {
        self.mismatch = target.force - self.force;
        self.stiffness = target.stiffness;
    }

    /// Carries a correction over, to first order: what the configuration asks for then.
    pub fn correct(&mut self, change: f64) {
        self.force += self.mismatch + self.stiffness * change;
    }
}

//! The forces met in a step, to which its residual is compared.

use crate::beams::{ForceSummary, RotationIncrement};
use crate::geometry::larger;
use crate::integrators::Interval;

/// The interval of the current step, and the largest force and moment of each kind in it.
#[derive(Debug, Clone, Copy)]
pub(in crate::model) struct StepScales {
    pub(in crate::model) interval: Interval,
    pub(in crate::model) inertia: (f64, f64),
    pub(in crate::model) loads: (f64, f64),
    pub(in crate::model) summary: ForceSummary,
    /// The largest force of a contact [force].
    pub(in crate::model) contact: f64,
    pub(in crate::model) rotations: RotationIncrement,
    /// Whether loads may jump where the step begins, as far as accelerations are kept.
    pub(in crate::model) jumps: bool,
}

impl Default for StepScales {
    fn default() -> Self {
        Self {
            interval: Interval::between(0.0, 0.0),
            inertia: (0.0, 0.0),
            loads: (0.0, 0.0),
            summary: ForceSummary::default(),
            contact: 0.0,
            rotations: RotationIncrement::TangentScaled,
            jumps: false,
        }
    }
}

impl StepScales {
    /// The sum of the largest forces of every kind [force].
    pub(in crate::model) fn force(&self) -> f64 {
        self.summary.force + self.inertia.0 + self.loads.0 + self.contact
    }

    /// The sum of the largest moments of every kind [force·length].
    pub(in crate::model) fn moment(&self) -> f64 {
        self.summary.moment + self.inertia.1 + self.loads.1
    }
}

/// The largest magnitudes among positions and among rotations.
pub(in crate::model) fn largest(values: &[f64], is_rotation: &[bool]) -> (f64, f64) {
    values.iter().zip(is_rotation).fold((0.0, 0.0), |(force, moment), (value, rotation)| {
        if *rotation {
            (force, larger(moment, value.abs()))
        } else {
            (larger(force, value.abs()), moment)
        }
    })
}

/// A residual compared with the forces that should balance it; nothing is nothing, whatever it is compared with.
pub(in crate::model) fn relative(residual: f64, scale: f64) -> f64 {
    if residual == 0.0 { 0.0 } else { residual / scale }
}

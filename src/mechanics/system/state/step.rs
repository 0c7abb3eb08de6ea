//! The present step, and the forces met in it, to which its residual is compared.

use crate::beams::{ForceSummary, RotationIncrement};
use crate::integrators::Interval;

/// The interval of the present step, and the largest force and moment of each kind in it.
pub struct StepMeasures {
    pub interval: Interval,
    /// The force and moment of the inertia of the rates at the start of the step, twice over its duration [force, force·length].
    pub inertia: (f64, f64),
    pub loads: (f64, f64),
    pub summary: ForceSummary,
    /// The largest force of a contact that was met in the step [force].
    pub contact: f64,
    pub rotations: RotationIncrement,
    /// Whether loads may jump where the step begins, as far as accelerations are kept.
    pub jumps: bool,
    /// Room for forces on all degrees of freedom.
    scratch: Vec<f64>,
}

impl StepMeasures {
    /// The present step of a model with so many degrees of freedom, before the first one begins.
    pub fn new(degrees_of_freedom: usize) -> Self {
        Self {
            interval: Interval::between(0.0, 0.0),
            inertia: (0.0, 0.0),
            loads: (0.0, 0.0),
            summary: ForceSummary::default(),
            contact: 0.0,
            rotations: RotationIncrement::TangentScaled,
            jumps: false,
            scratch: vec![0.0; degrees_of_freedom],
        }
    }

    /// Begins a step over an interval, in which no force was met yet.
    pub fn begin(&mut self, interval: Interval, jumps: bool) {
        let scratch = std::mem::take(&mut self.scratch);
        *self = Self { interval, jumps, scratch, ..Self::new(0) };
    }

    /// The room for forces on all degrees of freedom, of which none acts yet.
    pub fn no_forces(&mut self) -> &mut [f64] {
        self.scratch.fill(0.0);
        &mut self.scratch
    }

    /// The sum of the largest forces of every kind [force].
    fn force(&self) -> f64 {
        self.summary.force + self.inertia.0 + self.loads.0 + self.contact
    }

    /// The sum of the largest moments of every kind [force·length].
    fn moment(&self) -> f64 {
        self.summary.moment + self.inertia.1 + self.loads.1
    }

    /// A residual force compared with the forces that should balance it [-].
    pub fn relative_force(&self, residual: f64) -> f64 {
        relative(residual, self.force())
    }

    /// A residual moment compared with the moments that should balance it [-].
    pub fn relative_moment(&self, residual: f64) -> f64 {
        relative(residual, self.moment())
    }
}

/// Nothing is nothing, whatever it is compared with.
fn relative(residual: f64, scale: f64) -> f64 {
    if residual == 0.0 { 0.0 } else { residual / scale }
}

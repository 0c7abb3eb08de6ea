//! Largest forces and moments in the present step. The residual of the step is compared with them.

use super::{InertiaSolver, PresentForces};
use crate::beams::{ForceSummary, RotationIncrement};
use crate::integrators::Interval;

/// Interval of the present step, with the largest forces and moments of sections, inertia, loads and contacts.
pub struct StepMeasures {
    pub interval: Interval,
    pub inertia: (f64, f64),
    pub loads: (f64, f64),
    pub summary: ForceSummary,
    pub contact: f64,
    pub rotations: RotationIncrement,
    pub arm: f64,
    /// True if loads may jump at the start of the step and the state of the integrator contains accelerations.
    pub jumps: bool,
    /// Energy that the damper forces returned in the last substep that ran backwards in time [energy].
    pub returned: f64,
    scratch: Vec<f64>,
    pub inertia_solver: Option<Box<InertiaSolver>>,
    pub present: Option<Box<PresentForces>>,
}

impl StepMeasures {
    pub fn new(degrees_of_freedom: usize) -> Self {
        Self {
            interval: Interval::between(0.0, 0.0),
            inertia: (0.0, 0.0),
            loads: (0.0, 0.0),
            summary: ForceSummary::default(),
            contact: 0.0,
            arm: 0.0,
            rotations: RotationIncrement::TangentScaled,
            jumps: false,
            returned: 0.0,
            scratch: vec![0.0; degrees_of_freedom],
            inertia_solver: None,
            present: None,
        }
    }

    /// Prepares a step. `arm` is the largest arm of a rigid link [length].
    pub fn begin(&mut self, interval: Interval, arm: f64, jumps: bool) {
        let (returned, scratch) = (self.returned, std::mem::take(&mut self.scratch));
        let (inertia_solver, present) = (self.inertia_solver.take(), self.present.take());
        let kept = Self { scratch, inertia_solver, present, ..Self::new(0) };
        *self = Self { interval, arm, jumps, returned, ..kept };
    }

    pub fn no_forces(&mut self) -> &mut [f64] {
        self.scratch.fill(0.0);
        &mut self.scratch
    }

    fn force(&self) -> f64 {
        self.summary.force + self.inertia.0 + self.loads.0 + self.contact
    }

    fn moment(&self) -> f64 {
        self.summary.moment + self.inertia.1 + self.loads.1 + self.arm * self.force()
    }

    /// Residual force as a fraction of the force scale [-].
    pub fn relative_force(&self, residual: f64) -> f64 {
        relative(residual, self.force())
    }

    /// Residual moment as a fraction of the moment scale [-].
    pub fn relative_moment(&self, residual: f64) -> f64 {
        relative(residual, self.moment())
    }
}

/// Largest residual that counts as zero. Smaller numbers are close to the smallest normal number, where rounding errors are large.
const LEAST_RESIDUAL: f64 = f64::MIN_POSITIVE / f64::EPSILON;

fn relative(residual: f64, scale: f64) -> f64 {
    if residual.abs() <= LEAST_RESIDUAL { 0.0 } else { residual / scale }
}

//! Integrator that conserves momenta and never increases the energy.

use super::balance::{BalanceCoefficients, StepSolver};
use super::{Integrator, Interval, Mechanism, Stage, StepError};
use crate::newton::{NewtonReport, Tolerance};

/// Energy–momentum method whose section forces follow from the strain at a time after the middle of the step.
/// The energy-decaying method damps high frequencies, and conserves linear and angular momentum to rounding for any step size.
/// A step dissipates or conserves energy. The method is of first order (docs/theory.md, section 8.2).
/// A dissipation parameter of zero gives the energy–momentum method, which is of second order.
///
/// Reference: F. Armero & I. Romero, Comput. Methods Appl. Mech. Eng. 190 (2001) 2603–2649.
#[derive(Debug, Clone)]
pub struct EnergyDecaying {
    solver: StepSolver,
    chi: f64,
}

impl EnergyDecaying {
    /// Stages of a step at which the method evaluates loads.
    pub const STAGES: &[Stage] = &[Stage::Midpoint];

    /// Creates the method with the dissipation `chi` [-], and allocates memory for a mechanism.
    pub fn new(chi: f64, mechanism: &dyn Mechanism, tolerance: Tolerance) -> Self {
        Self { solver: StepSolver::new(mechanism, tolerance), chi }
    }
}

impl Integrator for EnergyDecaying {
    fn step(
        &mut self,
        mechanism: &mut dyn Mechanism,
        interval: Interval,
    ) -> Result<NewtonReport, StepError> {
        mechanism.begin_step(interval, Self::STAGES)?;
        self.solver.predict(mechanism, interval);
        let rule = BalanceCoefficients::mean(Stage::DampedMidpoint(self.chi), 1.0);
        let report = self.solver.solve(mechanism, interval, rule)?;
        self.solver.correct(mechanism, interval);
        Ok(report)
    }
}

//! Trapezoidal rule.

use super::balance::{BalanceCoefficients, StepSolver};
use super::{Integrator, Interval, Mechanism, Stage, StepError};
use crate::newton::{NewtonReport, Tolerance};

/// Trapezoidal rule in terms of the increments of a step: Newmark's method with β = 1/4 and γ = 1/2 (docs/theory.md, section 8.1).
/// The trapezoidal rule is of second order. It conserves linear momentum, and for linear problems also energy and angular momentum.
///
/// Reference: N. M. Newmark, A method of computation for structural dynamics, J. Eng. Mech. Div. ASCE 85 (1959) 67–94.
#[derive(Debug, Clone)]
pub struct Trapezoidal {
    solver: StepSolver,
}

impl Trapezoidal {
    /// Stages of a step at which the rule evaluates forces.
    pub const STAGES: &[Stage] = &[Stage::Start, Stage::End];

    /// Creates the method, and allocates memory for a mechanism.
    pub fn new(mechanism: &dyn Mechanism, tolerance: Tolerance) -> Self {
        Self { solver: StepSolver::new(mechanism, tolerance) }
    }
}

impl Integrator for Trapezoidal {
    fn step(
        &mut self,
        mechanism: &mut dyn Mechanism,
        interval: Interval,
    ) -> Result<NewtonReport, StepError> {
        mechanism.begin_step(interval, Self::STAGES)?;
        self.solver.predict(mechanism, interval);
        self.solver.carry(mechanism, Stage::Start, 0.5);
        let report =
            self.solver.solve(mechanism, interval, BalanceCoefficients::mean(Stage::End, 0.5))?;
        self.solver.correct(mechanism, interval);
        Ok(report)
    }
}

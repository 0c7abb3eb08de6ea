//! Energy–momentum integrator.

use super::balance::{BalanceCoefficients, StepSolver};
use super::{Integrator, Interval, Mechanism, Stage, StepError};
use crate::newton::{NewtonReport, Tolerance};

/// Energy–momentum method, which conserves energy, linear and angular momentum to rounding for any step size.
/// Conservation follows from midpoint kinematics with tangent-scaled rotations and averaged section forces.
/// The energy–momentum method is of second order (docs/theory.md, section 6).
///
/// Reference: N. Stander & E. Stein, Eng. Comput. 13 (1996) 60–85 (planar finite beam element for flexible mechanisms).
/// Reference: J. C. Simo, N. Tarnow & M. Doblaré, Int. J. Numer. Methods Eng. 38 (1995) 1431–1473.
#[derive(Debug, Clone)]
pub struct EnergyMomentum {
    solver: StepSolver,
}

impl EnergyMomentum {
    /// Stages of a step at which the method evaluates forces.
    pub const STAGES: &[Stage] = &[Stage::Midpoint];

    /// Creates the method, and allocates memory for a mechanism.
    pub fn new(mechanism: &dyn Mechanism, tolerance: Tolerance) -> Self {
        Self { solver: StepSolver::new(mechanism, tolerance) }
    }
}

impl Integrator for EnergyMomentum {
    fn step(
        &mut self,
        mechanism: &mut dyn Mechanism,
        interval: Interval,
    ) -> Result<NewtonReport, StepError> {
        mechanism.begin_step(interval, Self::STAGES)?;
        self.solver.predict(mechanism, interval);
        let report = self.solver.solve(
            mechanism,
            interval,
            BalanceCoefficients::mean(Stage::Midpoint, 1.0),
        )?;
        self.solver.correct(mechanism, interval);
        Ok(report)
    }
}

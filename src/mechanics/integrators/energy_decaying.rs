//! Integrator that conserves momenta and never increases the energy.

use super::balance::{BalanceCoefficients, StepSolver};
use super::{Integrator, Interval, Mechanism, Stage, StepError};
use crate::newton::{NewtonReport, Tolerance};

/// Energy–momentum method in which the section forces belong to a strain later than the middle of the step.
/// The method damps high frequencies, and conserves linear and angular momentum to rounding for any step size.
///
/// Balance: `M (v1 - v0)/Δt + F(damped midpoint) = 0` and `(v0 + v1)/2 = Δq/Δt`.
/// Section forces: `N̄ = C (½(Γ0 + Γ1) + χ/2 ΔΓ)` and `M̄ = EI (½(κ0 + κ1) + χ/2 Δκ)` with `χ ≥ 0`.
///
/// A step dissipates exactly the energy `χ/2 ∫ ΔΓ·C ΔΓ + EI Δκ² dX`. The method is of first order.
/// For `χ = 0` the method is the energy–momentum method, which is of second order.
///
/// The method follows F. Armero & I. Romero, Comput. Methods Appl. Mech. Eng. 190 (2001) 2603–2649.
/// The authors add dissipation to the averaged stresses of a conserving method. In this program, the added stress is linear in the strain.
#[derive(Debug, Clone)]
pub struct EnergyDecaying {
    solver: StepSolver,
    chi: f64,
}

impl EnergyDecaying {
    /// Stages at which loads are evaluated.
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

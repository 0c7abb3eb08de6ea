//! Generalized-α integrator.

use super::balance::{BalanceCoefficients, StepSolver};
use super::prescribed::BalancedAt;
use super::{Integrator, Interval, Mechanism, Stage, StepError};
use crate::elementary::square;
use crate::newton::{NewtonReport, Tolerance};

/// Generalized-α method of second order: Newmark's formulas, with inertia and forces balanced at different times (docs/theory.md, section 8.4).
/// The amplitudes of the highest frequencies are multiplied by about `ρ∞` in each step. The damping of low frequencies is very small.
/// Generalized-α conserves neither energy nor momenta.
///
/// A step of the trapezoidal rule determines accelerations that are unknown: at the start, after an impact and at a jump of a load.
///
/// Reference: J. Chung & G. M. Hulbert, J. Appl. Mech. 60 (1993) 371–375.
#[derive(Debug, Clone)]
pub struct GeneralizedAlpha {
    solver: StepSolver,
    weights: Weights,
    accelerations: Vec<f64>,
}

#[derive(Debug, Clone, Copy)]
struct Weights {
    inertia_before: f64,
    forces_before: f64,
    gamma: f64,
    beta: f64,
}

impl Weights {
    fn new(rho_infinity: f64) -> Self {
        let inertia_before = (2.0 * rho_infinity - 1.0) / (rho_infinity + 1.0);
        let forces_before = rho_infinity / (rho_infinity + 1.0);
        let late = forces_before - inertia_before;
        let (gamma, beta) = (0.5 + late, 0.25 * square(1.0 + late));
        Self { inertia_before, forces_before, gamma, beta }
    }

    fn carried(&self) -> f64 {
        0.5 / self.beta - 1.0
    }
}

impl GeneralizedAlpha {
    /// Stages of a step at which the method evaluates forces.
    pub const STAGES: &[Stage] = &[Stage::Start, Stage::End];

    /// Creates the method with the parameter `ρ∞` [-], and allocates memory for a mechanism.
    pub fn new(rho_infinity: f64, mechanism: &mut dyn Mechanism, tolerance: Tolerance) -> Self {
        mechanism.accelerated().enable_accelerations();
        Self {
            solver: StepSolver::new(mechanism, tolerance),
            weights: Weights::new(rho_infinity),
            accelerations: vec![0.0; mechanism.unknowns()],
        }
    }

    fn step_without(
        &mut self,
        mechanism: &mut dyn Mechanism,
        interval: Interval,
    ) -> Result<NewtonReport, StepError> {
        let Self { solver, accelerations, .. } = self;
        solver.carry(mechanism, Stage::Start, 0.5);
        let report =
            solver.solve(mechanism, interval, BalanceCoefficients::mean(Stage::End, 0.5))?;
        let inverse = 1.0 / interval.duration();
        solver.accept(mechanism, |at, start, deviation| {
            accelerations[at] = 2.0 * deviation * inverse * inverse;
            start + 2.0 * deviation * inverse
        });
        Ok(report)
    }

    fn step_with(
        &mut self,
        mechanism: &mut dyn Mechanism,
        interval: Interval,
    ) -> Result<NewtonReport, StepError> {
        let Self { solver, weights, accelerations } = self;
        let Weights { inertia_before, forces_before, gamma, beta } = *weights;
        let carried = weights.carried();
        solver.carry_inertia(
            mechanism,
            inertia_before - (1.0 - inertia_before) * carried,
            accelerations,
        );
        solver.carry(mechanism, Stage::Start, forces_before);
        let rule = BalanceCoefficients {
            inertia: (1.0 - inertia_before) / beta,
            stage: Stage::End,
            weight: 1.0 - forces_before,
            prescribed: BalancedAt::Fraction(1.0 - forces_before),
        };
        let report = solver.solve(mechanism, interval, rule)?;
        let duration = interval.duration();
        let scale = 1.0 / (beta * square(duration));
        solver.accept(mechanism, |at, start, deviation| {
            let before = accelerations[at];
            let after = scale * deviation - carried * before;
            accelerations[at] = after;
            start + duration * ((1.0 - gamma) * before + gamma * after)
        });
        Ok(report)
    }
}

impl Integrator for GeneralizedAlpha {
    fn step(
        &mut self,
        mechanism: &mut dyn Mechanism,
        interval: Interval,
    ) -> Result<NewtonReport, StepError> {
        mechanism.begin_step(interval, Self::STAGES)?;
        self.solver.predict(mechanism, interval);
        let report = match mechanism.accelerated().accelerations() {
            Some(known) => {
                self.accelerations.copy_from_slice(known);
                self.step_with(mechanism, interval)?
            }
            None => self.step_without(mechanism, interval)?,
        };
        mechanism.accelerated().set_accelerations(&self.accelerations);
        Ok(report)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn generalized_alpha_without_damping_equals_the_trapezoidal_rule() {
        let Weights { inertia_before, forces_before, gamma, beta } = Weights::new(1.0);
        assert_eq!([inertia_before, forces_before, gamma, beta], [0.5, 0.5, 0.5, 0.25]);
        assert_eq!(Weights::new(1.0).carried(), 1.0);
    }
}

//! A composition of energy–momentum steps.

use super::balance::{Rule, StepSolver};
use super::{EnergyMomentum, Integrator, Interval, Mechanism, Stage, StepError};
use crate::newton::{NewtonReport, Tolerance};

/// `s = 1/(4 - 4^(1/3))`
const SHARE: f64 = 0.414_490_771_794_375_7;

/// Where the parts of a step end, as shares of it: the third one goes back in time.
const ENDS: [f64; 5] = [SHARE, 2.0 * SHARE, 1.0 - 2.0 * SHARE, 1.0 - SHARE, 1.0];

/// Five energy–momentum steps over the parts `s, s, 1 - 4s, s, s` of a step, `s = 1/(4 - 4^(1/3))`, the third one backwards
/// in time. Each keeps energy, linear and angular momentum to rounding, and so does the whole.
///
/// The error of a symmetric method of second order has no even terms but the first, `Δt³` in a step; it cancels as
/// `4 s³ + (1 - 4s)³ = 0`. Fourth order.
///
/// M. Suzuki, Fractal decomposition of exponential operators, Phys. Lett. A 146 (1990) 319–323.
#[derive(Debug, Clone)]
pub struct FourthOrder {
    solver: StepSolver,
    /// The state at the start of the step, to go back to when a part fails.
    start: Vec<f64>,
}

impl FourthOrder {
    /// Where a step takes forces: once in each part.
    pub const STAGES: &[Stage] = &[Stage::Midpoint; ENDS.len()];

    /// The method with work space for a mechanism.
    pub fn new(mechanism: &dyn Mechanism, tolerance: Tolerance) -> Self {
        let mut start = Vec::new();
        mechanism.write_checkpoint(&mut start);
        Self { solver: StepSolver::new(mechanism, tolerance), start }
    }

    fn take_part(
        &mut self,
        mechanism: &mut dyn Mechanism,
        part: Interval,
    ) -> Result<NewtonReport, StepError> {
        mechanism.begin_step(part, EnergyMomentum::STAGES)?;
        self.solver.predict(mechanism, part);
        let report = self.solver.solve(mechanism, part, Rule::mean(Stage::Midpoint, 1.0))?;
        self.solver.correct(mechanism, part);
        Ok(report)
    }
}

impl Integrator for FourthOrder {
    /// Iterations are those of all parts.
    fn step(
        &mut self,
        mechanism: &mut dyn Mechanism,
        interval: Interval,
    ) -> Result<NewtonReport, StepError> {
        mechanism.write_checkpoint(&mut self.start);
        let mut whole = NewtonReport::default();
        let mut behind = 0.0;
        for end in ENDS {
            match self.take_part(mechanism, interval.part(behind, end)) {
                Ok(report) => whole = whole.then(report),
                Err(error) => {
                    mechanism.return_to_checkpoint(&self.start);
                    return Err(error.of_whole(interval, whole.iterations));
                }
            }
            behind = end;
        }
        Ok(whole)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cubes_of_the_parts_cancel() {
        assert!((SHARE - 1.0 / (4.0 - 4.0_f64.cbrt())).abs() < 1e-16);
        let starts = std::iter::once(0.0).chain(ENDS);
        let cubes: f64 = starts.zip(ENDS).map(|(start, end)| (end - start).powi(3)).sum();
        assert!(cubes.abs() < 1e-15);
    }
}

//! Integrator with a check of the state at the end of every step.

use super::{Integrator, Interval, Mechanism, StepError};
use crate::newton::NewtonReport;

/// Integrator that rejects a step if the state at its end violates a condition of the constraints.
/// The conditions of the constraints depend on the present forces, which are known only after the step. A rejected step is undone.
pub(super) struct EndCheck {
    integrator: Box<dyn Integrator>,
}

impl EndCheck {
    pub(super) fn new(integrator: Box<dyn Integrator>) -> Self {
        Self { integrator }
    }
}

impl Integrator for EndCheck {
    fn step(
        &mut self,
        mechanism: &mut dyn Mechanism,
        interval: Interval,
    ) -> Result<NewtonReport, StepError> {
        mechanism.checkpoint().save_state();
        let report = self.integrator.step(mechanism, interval)?;
        accept_end(mechanism, interval, report.iterations)?;
        Ok(report)
    }
}

/// Checks the state at the end of a step. If the check fails, the mechanism returns to its saved state.
///
/// # Errors
/// Fails if the state violates a condition of the constraints.
pub(super) fn accept_end(
    mechanism: &mut dyn Mechanism,
    interval: Interval,
    iterations: usize,
) -> Result<(), StepError> {
    mechanism.check_end().map_err(|overshoot| {
        mechanism.checkpoint().restore_state();
        StepError::Overshoot { interval, overshoot, iterations }
    })
}

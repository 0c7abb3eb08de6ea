//! Integrator with a check of the state at the end of every step.

use super::{Integrator, Interval, Mechanism, StepError};
use crate::newton::NewtonReport;

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

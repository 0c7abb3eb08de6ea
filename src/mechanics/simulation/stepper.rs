//! What takes the steps of a run.

use super::sensitivities::Sensitivities;
use crate::integrators::{Integrator, Interval, StepError};
use crate::newton::NewtonReport;
use crate::system::System;

/// What takes the steps of a run: its method, and what finds derivatives with them, if that is asked for.
pub(super) struct Stepper {
    pub(super) integrator: Box<dyn Integrator>,
    pub(super) sensitivities: Option<Box<Sensitivities>>,
}

impl Stepper {
    /// Steps of a method and nothing else.
    pub(super) fn of(integrator: Box<dyn Integrator>) -> Self {
        Self { integrator, sensitivities: None }
    }

    /// Takes one step over an interval, with those that derivatives are found by.
    ///
    /// # Errors
    /// Those of the step of the run.
    pub(super) fn step(
        &mut self,
        model: &mut System,
        interval: Interval,
    ) -> Result<NewtonReport, StepError> {
        let Self { integrator, sensitivities } = self;
        match sensitivities {
            None => integrator.step(model, interval),
            Some(sensitivities) => sensitivities.step(model, &mut **integrator, interval),
        }
    }
}

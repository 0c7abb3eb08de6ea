//! Steps of a run, with optional derivatives.

use super::sensitivities::Sensitivities;
use crate::integrators::{Integrator, Interval, StepError};
use crate::newton::NewtonReport;
use crate::system::System;

pub(super) struct Stepper {
    pub(super) integrator: Box<dyn Integrator>,
    pub(super) sensitivities: Option<Box<Sensitivities>>,
}

impl Stepper {
    pub(super) fn of(integrator: Box<dyn Integrator>) -> Self {
        Self { integrator, sensitivities: None }
    }

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

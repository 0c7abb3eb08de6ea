//! Error estimate by step doubling.

use super::controller::TriedStep;
use super::corner_crossings::CornerCrossings;
use crate::elementary::whole_power;
use crate::geometry::larger;
use crate::integrators::{Integrator, Interval, StepError};
use crate::newton::NewtonReport;
use crate::system::{Placement, System, SystemState};

/// Takes two half steps and compares their result with the result of a whole step, which is discarded.
///
/// For a method of order `p`, the error after the half steps is estimated as `1/(2^p - 1)` times their difference from the whole step (Richardson).
/// The result of the half steps is not extrapolated. Extrapolation would be more accurate, but would lose the conservation properties of the method.
#[derive(Default)]
pub(super) struct StepDoubling {
    start: SystemState,
    whole_step: Placement,
    halves: Placement,
    corner_crossings: CornerCrossings,
    /// Length scale of position errors [length].
    length: f64,
    /// Allowed error times `2^p - 1` for a method of order `p` [-].
    allowed: f64,
}

pub(super) struct DoubledStep {
    /// Number of iterations and corrections of the half steps and the whole step together.
    pub(super) report: NewtonReport,
    pub(super) tried_step: TriedStep,
    position_error: f64,
}

impl DoubledStep {
    pub(super) fn judged_by_places(self) -> Self {
        let trial = TriedStep { error: self.position_error, ..self.tried_step };
        Self { tried_step: trial, ..self }
    }

    pub(super) fn resampled(self, report: NewtonReport, error: f64) -> Self {
        let trial = TriedStep { error: larger(self.tried_step.error, error), ..self.tried_step };
        Self { report, tried_step: trial, position_error: larger(self.position_error, error) }
    }
}

pub(super) struct FailedStep {
    pub(super) source: StepError,
    pub(super) before: usize,
}

impl StepDoubling {
    pub(super) fn new(order: u32, length: f64, allowed: f64) -> Self {
        let allowed = (whole_power(2.0, order as i32) - 1.0) * allowed;
        Self { length, allowed, ..Self::default() }
    }

    /// Takes a whole step, then two half steps over the same interval, and returns the error of the half steps.
    /// Stores the state between the half steps in the buffer `between`, if the buffer is given.
    pub(super) fn step(
        &mut self,
        integrator: &mut dyn Integrator,
        model: &mut System,
        interval: Interval,
        between: Option<&mut SystemState>,
    ) -> Result<DoubledStep, FailedStep> {
        let Interval { start, end, .. } = interval;
        let middle = start + 0.5 * interval.duration();
        model.write_state(&mut self.start);
        self.corner_crossings.record_start(model);
        let mut report = take(integrator, model, interval, NewtonReport::default())?;
        model.write_placement(&mut self.whole_step);
        self.corner_crossings.record_whole_step(model);
        model.restore(&self.start);
        report =
            self.take_or_restore(integrator, model, Interval::between(start, middle), report)?;
        self.corner_crossings.record_middle(model);
        if let Some(between) = between {
            model.write_state(between);
        }
        report = self.take_or_restore(integrator, model, Interval::between(middle, end), report)?;
        model.write_placement(&mut self.halves);
        self.corner_crossings.record_half_steps(model);
        let distance = self.whole_step.distance(&self.halves);
        let apart = larger(distance.length / self.length, distance.angle);
        let (of_places, duration) = (apart / self.allowed, interval.duration());
        let of_crossings = self.corner_crossings.difference(duration, self.length) / self.allowed;
        let trial = TriedStep { duration, error: larger(of_places, of_crossings) };
        Ok(DoubledStep { report, tried_step: trial, position_error: of_places })
    }

    /// Takes one of the two half steps of [`step`](Self::step). If it fails, the model is restored to the start of the whole step.
    pub(super) fn take_or_restore(
        &self,
        integrator: &mut dyn Integrator,
        model: &mut System,
        step: Interval,
        before: NewtonReport,
    ) -> Result<NewtonReport, FailedStep> {
        take(integrator, model, step, before).inspect_err(|_| self.restore_start(model))
    }

    pub(super) fn restore_start(&self, model: &mut System) {
        model.restore(&self.start);
    }
}

fn take(
    integrator: &mut dyn Integrator,
    model: &mut System,
    step: Interval,
    before: NewtonReport,
) -> Result<NewtonReport, FailedStep> {
    let report = integrator.step(model, step);
    let report = report.map_err(|source| FailedStep { source, before: before.iterations })?;
    Ok(before.then(report))
}

//! The error of two steps of a method, seen by the side of a single one over the same time.

use super::controller::TriedStep;
use super::corner_crossings::CornerCrossings;
use crate::elementary::whole_power;
use crate::geometry::larger;
use crate::integrators::{Integrator, Interval, StepError};
use crate::newton::NewtonReport;
use crate::system::{Placement, System, SystemState};

/// Takes two steps, each one half of an interval, and compares them with one over all of it, which is thrown away.
///
/// Where a method has order `p`, the two err by `1/(2^p - 1)` of the difference (Richardson). They are kept as they are: what
/// extrapolation would give is more accurate, but no step of the method, and has lost what steps of it keep.
#[derive(Default)]
pub(super) struct StepDoubling {
    start: SystemState,
    whole: Placement,
    halves: Placement,
    blows: CornerCrossings,
    /// What errors of places are relative to [length].
    length: f64,
    /// `2^p - 1` times the error that is allowed [-].
    allowed: f64,
}

/// Two half steps that were taken, with their error.
pub(super) struct DoubledStep {
    /// The work of all three solves: of the two half steps and of the whole one.
    pub(super) report: NewtonReport,
    pub(super) trial: TriedStep,
    /// The error that places show alone, over that allowed [-].
    of_places: f64,
}

impl DoubledStep {
    /// The same step, where none can be shorter: that a blow falls somewhere in it is no reason to refuse it.
    pub(super) fn judged_by_places(self) -> Self {
        let trial = TriedStep { error: self.of_places, ..self.trial };
        Self { trial, ..self }
    }

    /// The same step with its second half taken anew, by the work of all and an error beside that of the method, over that allowed.
    pub(super) fn resampled(self, report: NewtonReport, error: f64) -> Self {
        let trial = TriedStep { error: larger(self.trial.error, error), ..self.trial };
        Self { report, trial, of_places: larger(self.of_places, error) }
    }
}

/// A step of which a half or the whole failed, the mechanism being where it was, and what was solved before that.
pub(super) struct FailedStep {
    pub(super) source: StepError,
    /// The number of Newton iterations that were made before the part that failed.
    pub(super) before: usize,
}

impl StepDoubling {
    /// The comparison of half steps with whole ones for methods of an order `p`, with a length to compare errors with and the error allowed.
    pub(super) fn new(order: u32, length: f64, allowed: f64) -> Self {
        let allowed = (whole_power(2.0, order as i32) - 1.0) * allowed;
        Self { length, allowed, ..Self::default() }
    }

    /// Takes two half steps over an interval, and tells their error; the state between them is written down for who asks for it.
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
        self.blows.look_at_start(model);
        let mut report = take(integrator, model, interval, NewtonReport::default())?;
        model.write_placement(&mut self.whole);
        self.blows.look_at_whole(model);
        model.restore(&self.start);
        report =
            self.take_or_go_back(integrator, model, Interval::between(start, middle), report)?;
        self.blows.look_at_middle(model);
        if let Some(between) = between {
            model.write_state(between);
        }
        report = self.take_or_go_back(integrator, model, Interval::between(middle, end), report)?;
        model.write_placement(&mut self.halves);
        self.blows.look_at_halves(model);
        let distance = self.whole.distance(&self.halves);
        let apart = larger(distance.length / self.length, distance.angle);
        let (of_places, duration) = (apart / self.allowed, interval.duration());
        let of_blows = self.blows.apart(duration, self.length) / self.allowed;
        let trial = TriedStep { duration, error: larger(of_places, of_blows) };
        Ok(DoubledStep { report, trial, of_places })
    }

    /// Takes a step after others that were solved; where it fails, the model is back where the first of them began.
    pub(super) fn take_or_go_back(
        &self,
        integrator: &mut dyn Integrator,
        model: &mut System,
        step: Interval,
        before: NewtonReport,
    ) -> Result<NewtonReport, FailedStep> {
        take(integrator, model, step, before).inspect_err(|_| self.take_back(model))
    }

    /// Takes the model back to where the last pair of half steps began.
    pub(super) fn take_back(&self, model: &mut System) {
        model.restore(&self.start);
    }
}

/// Takes a step, others having been solved before.
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

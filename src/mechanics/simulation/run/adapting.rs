//! Variable steps with an error tolerance.

use super::Simulation;
use super::event_location::MOST_ARRIVALS;
use crate::integrators::{Interval, StepError};
use crate::simulation::adaptive::{Adaptive, StepPlan};
use crate::simulation::controller::StepSizeState;
use crate::simulation::error_estimate::{DoubledStep, FailedStep};
use crate::simulation::resampling::Resampling;
use crate::simulation::step_retry::StepRetry;
use crate::simulation::{Monitor, SimulationError};

impl Simulation {
    /// Planned size of the next step [time].
    pub fn dt(&self) -> f64 {
        self.clock.dt()
    }

    /// End time of the next step, at most `limit` [time].
    pub fn next_stop(&self, limit: f64) -> f64 {
        let now = self.time();
        let stop = self.clock.grid.next(now, limit);
        let planned = self.adaptive.as_ref().zip(self.clock.step_size);
        planned.map_or(stop, |(adaptive, state)| adaptive.plan(&state, now, stop).interval.end)
    }

    pub(super) fn adapt(
        &mut self,
        adaptive: &mut Adaptive,
        limit: f64,
        monitor: &mut dyn Monitor,
    ) -> Result<(), SimulationError> {
        let Adaptive { controller, .. } = *adaptive;
        if let Some(halving) = self.clock.retry.filter(|halving| halving.end() <= limit) {
            return self.cover_uncompared(halving, controller.first, monitor);
        }
        self.clock.retry = None;
        let mut state = self.clock.step_size.unwrap_or_else(|| controller.start());
        if state.tries == 0 && self.model.loads_may_jump() {
            controller.restart(&mut state);
        }
        loop {
            let (plan, tried) = match self.finish_paused_step(adaptive) {
                Some(ended) => ended,
                None => {
                    let now = self.time();
                    let plan = adaptive.plan(&state, now, self.clock.grid.next(now, limit));
                    let tried = self.try_step(adaptive, &plan);
                    match (tried, &mut adaptive.resampling) {
                        (Ok(doubled), Some(resampling)) if doubled.tried_step.error <= 1.0 => {
                            resampling.pause_at_middle(&mut self.model, plan, doubled);
                            self.clock.step_size = Some(state);
                            self.query_monitor(monitor)?;
                            continue;
                        }
                        (tried, _) => (plan, tried),
                    }
                }
            };
            let StepPlan { interval, is_cut, is_least } = plan;
            let dt = interval.duration();
            match tried {
                Ok(DoubledStep { report, tried_step: trial, .. }) if trial.error <= 1.0 => {
                    let tries = state.tries;
                    match is_cut {
                        true => controller.accept_cut(&mut state, trial),
                        false => controller.accept(&mut state, trial),
                    }
                    self.clock.step_size = Some(state);
                    self.count_step(interval, report, tries);
                    self.model.clear_contact_events();
                    self.store_present();
                    return self.query_monitor(monitor);
                }
                Ok(DoubledStep { report, tried_step: trial, .. }) => {
                    adaptive.doubling.restore_start(&mut self.model);
                    self.progress.count_rejection(report.iterations);
                    controller.reject(&mut state, trial);
                    if is_least {
                        return Err(SimulationError::Tolerance {
                            time: interval.start,
                            tolerance: adaptive.tolerance,
                            dt,
                            error: trial.error,
                            smallest: controller.smallest,
                        });
                    }
                }
                Err(FailedStep { source: StepError::Overshoot { iterations, .. }, before }) => {
                    self.progress.count_try(before + iterations);
                    // The error before the event is discarded, because it gives no information about the motion after the event.
                    self.clock.step_size = Some(StepSizeState { error: None, tries: 0, ..state });
                    let start = interval.start;
                    let half = StepRetry::new(Interval::between(start, start + 0.5 * dt));
                    return self.cover_uncompared(half, controller.first, monitor);
                }
                Err(FailedStep { source, .. }) if !source.is_step_size_dependent() => {
                    return Err(SimulationError::Load { source });
                }
                Err(FailedStep { source, before }) => {
                    self.progress.count_failure(before + source.factorisations());
                    controller.fail(&mut state, dt);
                    if is_least {
                        let (time, smallest) = (interval.start, controller.smallest);
                        let (source, conditions) =
                            (Box::new(self.with_name(source)), self.conditions());
                        return Err(SimulationError::Smallest {
                            time,
                            dt,
                            smallest,
                            source,
                            conditions,
                        });
                    }
                }
            }
            self.clock.step_size = Some(state);
            self.query_monitor(monitor)?;
        }
    }

    /// Takes a whole step and its two halves.
    /// If one of the three steps has no solution, all three are repeated with constant friction forces and constant kinks.
    /// A kink is the jump of the tangent of a beam axis under a contact force.
    fn try_step(
        &mut self,
        adaptive: &mut Adaptive,
        plan: &StepPlan,
    ) -> Result<DoubledStep, FailedStep> {
        self.model.unfreeze_contacts();
        match self.try_step_as_it_is(adaptive, plan) {
            Err(FailedStep { source, before }) if self.freezes_contacts_for(&source) => {
                self.progress.count_failure(before + source.factorisations());
                self.try_step_as_it_is(adaptive, plan)
            }
            tried => tried,
        }
    }

    fn try_step_as_it_is(
        &mut self,
        adaptive: &mut Adaptive,
        plan: &StepPlan,
    ) -> Result<DoubledStep, FailedStep> {
        let Adaptive { doubling, resampling, .. } = adaptive;
        let between = resampling.as_mut().map(Resampling::middle_mut);
        let integrator = &mut *self.stepper.integrator;
        let doubled = doubling.step(integrator, &mut self.model, plan.interval, between)?;
        Ok(if plan.is_least { doubled.judged_by_places() } else { doubled })
    }

    fn finish_paused_step(
        &mut self,
        adaptive: &mut Adaptive,
    ) -> Option<(StepPlan, Result<DoubledStep, FailedStep>)> {
        let Adaptive { doubling, resampling, controller, .. } = adaptive;
        let order = controller.order;
        resampling.as_mut()?.resume(doubling, &mut *self.stepper.integrator, &mut self.model, order)
    }

    /// Returns true if a step is paused in its middle to sample controllers.
    pub fn is_paused_in_step(&self) -> bool {
        let adaptive = self.adaptive.as_ref();
        adaptive
            .and_then(|adaptive| adaptive.resampling.as_ref())
            .is_some_and(Resampling::is_paused)
    }

    /// Restores the start of a paused step. The function has no effect if no step is paused.
    pub fn restore_step_start(&mut self) {
        if let Some(adaptive) = &mut self.adaptive
            && adaptive.resampling.as_mut().is_some_and(Resampling::abandon)
        {
            adaptive.doubling.restore_start(&mut self.model);
        }
    }

    fn cover_uncompared(
        &mut self,
        halving: StepRetry,
        first: f64,
        monitor: &mut dyn Monitor,
    ) -> Result<(), SimulationError> {
        let has_rattled = self.progress.arrivals.iter().nth_back(MOST_ARRIVALS - 1);
        if has_rattled.is_some_and(|arrival| arrival.time > self.time() - first) {
            return Err(self.too_many_arrivals());
        }
        self.cover(halving, monitor).map(|_| ())
    }
}

//! Steps of the time grid. Failed steps are halved. Steps end at arrivals of sliders.

use super::Simulation;
use super::event_location::MOST_ARRIVALS;
use crate::integrators::{Interval, StepError};
use crate::newton::NewtonReport;
use crate::simulation::step_retry::StepRetry;
use crate::simulation::{Monitor, SimulationError};
use crate::system::SliderEvent;

#[derive(PartialEq, Eq)]
pub(super) enum IntervalProgress {
    All,
    UntilAnArrival,
}

impl Simulation {
    pub(super) fn cover_with_arrivals(
        &mut self,
        mut halving: StepRetry,
        monitor: &mut dyn Monitor,
    ) -> Result<(), SimulationError> {
        let end = halving.end();
        for _ in 0..MOST_ARRIVALS {
            let covered = self.cover(halving, monitor)?;
            let is_there = self.has_reached(end);
            if covered == IntervalProgress::All || is_there || self.has_ended() {
                return Ok(());
            }
            halving = StepRetry::new(Interval::between(self.time(), end));
        }
        Err(self.too_many_arrivals())
    }

    pub(super) fn too_many_arrivals(&self) -> SimulationError {
        let arrival = self.progress.arrivals.last().map_or_else(
            || format!("a slider is about to reach an end of its beam after t = {}", self.time()),
            |last| self.describe(last),
        );
        SimulationError::TooManyArrivals { arrival, most: MOST_ARRIVALS }
    }

    pub(super) fn cover(
        &mut self,
        mut halving: StepRetry,
        monitor: &mut dyn Monitor,
    ) -> Result<IntervalProgress, SimulationError> {
        while !halving.is_done() {
            let interval = halving.next();
            let mut stepped = self.step_or_freeze_contacts(interval);
            if let Err(StepError::Overshoot { overshoot, iterations, .. }) = stepped {
                self.progress.count_try(iterations);
                self.disable_derivatives(
                    "a slider reaches an end of its beam, leaves a stop, leaves or lands on its beam, or begins to slip or stick",
                );
                match self.locate_arrival(interval, overshoot) {
                    Ok(located) => {
                        self.model.unfreeze_contacts();
                        self.clock.retry = None;
                        if let Some((interval, report)) = located.step {
                            self.count_step(interval, report, halving.retries);
                            self.keep_row();
                        }
                        let arrived = self.execute(&located);
                        // An arrival at the start of the step needs no snapshot: a run from the last snapshot reaches the arrival again.
                        if located.step.is_some() {
                            self.store_snapshot();
                        }
                        arrived?;
                        return self
                            .query_monitor(monitor)
                            .map(|()| IntervalProgress::UntilAnArrival);
                    }
                    Err(source) => stepped = Err(source),
                }
            }
            match stepped {
                Ok(report) => {
                    self.count_step(interval, report, halving.retries);
                    halving.succeed();
                    self.model.clear_contact_events();
                    if self.model.has_friction() {
                        self.model.end_reversed_slips()?;
                    }
                    self.clock.retry = halving.remaining();
                    self.store_present();
                }
                Err(source) if !source.is_step_size_dependent() => {
                    return Err(SimulationError::Load { source });
                }
                Err(source) => {
                    self.progress.count_failure(source.factorisations());
                    let divisions = halving.divisions();
                    if !halving.fail() {
                        return Err(self.no_step(halving.whole.duration(), divisions, source));
                    }
                    self.clock.retry = halving.remaining();
                }
            }
            self.query_monitor(monitor)?;
        }
        Ok(IntervalProgress::All)
    }

    fn step_or_freeze_contacts(&mut self, interval: Interval) -> Result<NewtonReport, StepError> {
        // Kinks and friction forces that were kept constant in the last step become variable again.
        // Constant kinks are kept until the start of the next step, because queries of the last step depend on them.
        self.model.unfreeze_contacts();
        let stepped = self.stepper.step(&mut self.model, interval);
        let stepped = match stepped {
            Err(source) if self.freezes_contacts_for(&source) => {
                self.progress.count_failure(source.factorisations());
                self.stepper.step(&mut self.model, interval)
            }
            other => other,
        };
        if self.stepper.sensitivities.is_some() && self.model.has_frozen_contacts() {
            // The perturbed runs keep no kinks or friction forces constant, so their equations would differ from those of the main run.
            self.disable_derivatives(
                "the kink under a slider or its friction force is kept constant in a step",
            );
        }
        stepped
    }

    /// Freezes contacts after a failed step: friction forces of slipping sliders and kinks that vary with contact forces become constant.
    /// Returns true if this changes the equations of the step.
    pub(super) fn freezes_contacts_for(&mut self, source: &StepError) -> bool {
        match source {
            StepError::Overshoot { .. } | StepError::Load { .. } => false,
            _ => self.model.freeze_contacts(),
        }
    }

    pub(in crate::simulation) fn count_step(
        &mut self,
        interval: Interval,
        report: NewtonReport,
        retries: usize,
    ) {
        self.progress.count_step(interval, report, retries, self.model.returned());
        self.model.end_step(interval.duration());
        if let Some(sensitivities) = &mut self.stepper.sensitivities {
            sensitivities.count_step(interval, report);
        }
    }

    pub(super) fn query_monitor(&self, monitor: &mut dyn Monitor) -> Result<(), SimulationError> {
        let time = self.time();
        if monitor.continues(time) { Ok(()) } else { Err(SimulationError::Interrupted { time }) }
    }

    fn no_step(&self, dt: f64, divisions: u64, source: StepError) -> SimulationError {
        let (time, conditions) = (self.time(), self.conditions());
        if let StepError::Overshoot { overshoot, .. } = &source {
            let (slider, event) = match SliderEvent::of(overshoot.event) {
                SliderEvent::Limit(limit) => {
                    (limit.slider, format!("reaches the {} of its beam", limit.end.name()))
                }
                SliderEvent::SlipEnd(slider) => (slider, "begins to stick".to_owned()),
                SliderEvent::SlipStart(slider) => (slider, "begins to slip".to_owned()),
                SliderEvent::Landing(slider) => (slider, "lands on its beam".to_owned()),
                SliderEvent::TakeOff(slider) => (slider, "leaves its beam".to_owned()),
            };
            return SimulationError::EventLocation {
                slider: self.scene.sliders[slider].name.clone(),
                event,
                time,
                dt,
                divisions,
                conditions,
            };
        }
        let source = Box::new(self.with_name(source));
        SimulationError::Step { time, dt, divisions, source, conditions }
    }
}

//! Steps as long as a tolerance allows.

use super::controller::{Controller, Pace};
use super::doubling::{Doubled, Doubling, Failed};
use super::first_step::{first_step, length_of};
use super::landing::MOST_ARRIVALS;
use super::stepping::Halving;
use super::{Monitor, Simulation, SimulationError, StepControl};
use crate::elementary::power;
use crate::integrators::{Interval, Method, StepError};
use crate::model::{Model, Scene};

/// The smallest step where none is given, as a part of the first one.
const SMALLEST: f64 = 1e-6;

/// The largest one where none is given, as a multiple of the first: a scene at rest sets no other bound.
const LARGEST: f64 = 1e6;

/// No step is shorter than so many times what rounds a time.
const ROUNDINGS: f64 = 64.0;

/// What finds steps of varying size, and does not change from step to step.
pub(super) struct Adaptive {
    pub(super) controller: Controller,
    doubling: Doubling,
    tolerance: f64,
}

/// Where the next step is to end.
struct Plan {
    interval: Interval,
    /// Whether it would be longer if it were not for something else.
    is_cut: bool,
    /// Whether it cannot be shorter.
    is_least: bool,
}

impl Adaptive {
    /// For a scene at its start.
    pub(super) fn new(control: &StepControl, method: Method, scene: &Scene, model: &Model) -> Self {
        let order = method.entry().claims.order;
        let least = control.smallest.unwrap_or(0.0);
        let most = control.largest.unwrap_or(f64::INFINITY);
        let first = control.first.unwrap_or_else(|| first_step(scene, model).clamp(least, most));
        let largest = control.largest.unwrap_or(LARGEST * first);
        let smallest = control.smallest.unwrap_or(SMALLEST * first);
        let controller = Controller { order: f64::from(order + 1), first, smallest, largest };
        let allowed = power(control.tolerance, 1.0 + 1.0 / f64::from(order));
        let doubling = Doubling::new(order, length_of(scene, model), allowed);
        Self { controller, doubling, tolerance: control.tolerance }
    }

    /// The next step, when something stops it at a time at the latest.
    fn plan(&self, pace: &Pace, now: f64, stop: f64) -> Plan {
        let least = self.controller.smallest.max(ROUNDINGS * f64::EPSILON * now);
        let wish = pace.wish.max(least);
        let left = stop - now;
        let (end, is_cut) = if stop <= now + wish {
            (stop, stop < now + wish)
        } else if left < 2.0 * wish {
            // Two equal ones, and not a long and a short one.
            (now + 0.5 * left, true)
        } else {
            (now + wish, false)
        };
        let interval = Interval::between(now, end);
        // The duration is rounded as times are, the wish is not.
        let is_least = wish <= least || interval.duration() <= least;
        Plan { interval, is_cut, is_least }
    }
}

impl Simulation {
    /// The size that the next step has if nothing cuts it [time].
    pub fn dt(&self) -> f64 {
        self.pace.map_or(self.grid.dt(), |pace| pace.wish)
    }

    /// When the next step is to end, if it goes no further than `limit` [time].
    pub fn next_stop(&self, limit: f64) -> f64 {
        let now = self.time();
        let stop = self.grid.next(now, limit);
        let planned = self.adaptive.as_ref().zip(self.pace);
        planned.map_or(stop, |(adaptive, pace)| adaptive.plan(&pace, now, stop).interval.end)
    }

    /// Takes two equal steps of the method that keep the tolerance, trying shorter ones until they do.
    pub(super) fn adapt(
        &mut self,
        adaptive: &mut Adaptive,
        limit: f64,
        monitor: &mut dyn Monitor,
    ) -> Result<(), SimulationError> {
        let Adaptive { controller, .. } = *adaptive;
        if let Some(halving) = self.under_way.filter(|halving| halving.end() <= limit) {
            return self.cover_uncompared(halving, controller.first, monitor);
        }
        self.under_way = None;
        let mut pace = self.pace.unwrap_or_else(|| controller.start());
        if pace.tries == 0 && self.model.loads_may_jump() {
            controller.restart(&mut pace);
        }
        loop {
            let now = self.time();
            let plan = adaptive.plan(&pace, now, self.grid.next(now, limit));
            let Plan { interval, is_cut, is_least } = plan;
            let dt = interval.duration();
            match adaptive.doubling.step(&mut *self.integrator, &mut self.model, interval) {
                Ok(Doubled { report, trial }) if trial.error <= 1.0 => {
                    let tries = pace.tries;
                    match is_cut {
                        true => controller.accept_cut(&mut pace, trial),
                        false => controller.accept(&mut pace, trial),
                    }
                    self.pace = Some(pace);
                    self.count_step(interval, report, tries);
                    if self.is_worth_a_row() {
                        self.keep_row();
                    }
                    self.remember();
                    return self.ask(monitor);
                }
                Ok(Doubled { report, trial }) => {
                    adaptive.doubling.take_back(&mut self.model);
                    self.counts.rejected += 1;
                    self.counts.factorisations += report.iterations;
                    controller.reject(&mut pace, trial);
                    if is_least {
                        return Err(SimulationError::Tolerance {
                            time: now,
                            tolerance: adaptive.tolerance,
                            dt,
                            error: trial.error,
                            smallest: controller.smallest,
                        });
                    }
                }
                Err(Failed { source: StepError::Overshoot { iterations, .. }, before }) => {
                    self.count_try(before + iterations);
                    // Beyond an end there is nothing to compare; what comes after an arrival is not as what was.
                    self.pace = Some(Pace { error: None, tries: 0, ..pace });
                    let middle = now + 0.5 * dt;
                    let half = Halving::new(Interval::between(now, middle));
                    return self.cover_uncompared(half, controller.first, monitor);
                }
                Err(Failed { source, .. }) if !source.may_be_cured_by_a_smaller_step() => {
                    return Err(SimulationError::Load { source });
                }
                Err(Failed { source, before }) => {
                    self.counts.retries += 1;
                    self.counts.factorisations += before + source.factorisations();
                    controller.fail(&mut pace, dt);
                    if is_least {
                        let smallest = controller.smallest;
                        return Err(SimulationError::Smallest { time: now, dt, smallest, source });
                    }
                }
            }
            self.pace = Some(pace);
            self.ask(monitor)?;
        }
    }

    /// Goes on to the end of a step that is compared with nothing, or until a slider arrives: what comes then is compared again.
    fn cover_uncompared(
        &mut self,
        halving: Halving,
        first: f64,
        monitor: &mut dyn Monitor,
    ) -> Result<(), SimulationError> {
        let has_rattled = self.arrivals.iter().nth_back(MOST_ARRIVALS - 1);
        if has_rattled.is_some_and(|arrival| arrival.time > self.time() - first) {
            return Err(self.rattles());
        }
        self.cover(halving, monitor).map(|_| ())
    }
}

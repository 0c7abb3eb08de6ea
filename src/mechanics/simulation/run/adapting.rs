//! Steps as long as a tolerance allows.

use super::Simulation;
use super::landing::MOST_ARRIVALS;
use crate::integrators::{Interval, StepError};
use crate::simulation::adaptive::{Adaptive, Plan};
use crate::simulation::controller::Pace;
use crate::simulation::doubling::{Doubled, Failed};
use crate::simulation::halving::Halving;
use crate::simulation::{Monitor, SimulationError};

impl Simulation {
    /// The size that the next step has if nothing cuts it [time].
    pub fn dt(&self) -> f64 {
        self.clock.dt()
    }

    /// The time at which the next step is to end, if it goes no further than `limit` [time].
    pub fn next_stop(&self, limit: f64) -> f64 {
        let now = self.time();
        let stop = self.clock.grid.next(now, limit);
        let planned = self.adaptive.as_ref().zip(self.clock.pace);
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
        if let Some(halving) = self.clock.under_way.filter(|halving| halving.end() <= limit) {
            return self.cover_uncompared(halving, controller.first, monitor);
        }
        self.clock.under_way = None;
        let mut pace = self.clock.pace.unwrap_or_else(|| controller.start());
        if pace.tries == 0 && self.model.loads_may_jump() {
            controller.restart(&mut pace);
        }
        loop {
            let now = self.time();
            let plan = adaptive.plan(&pace, now, self.clock.grid.next(now, limit));
            let Plan { interval, is_cut, is_least } = plan;
            let dt = interval.duration();
            match adaptive.doubling.step(&mut *self.integrator, &mut self.model, interval) {
                Ok(Doubled { report, trial }) if trial.error <= 1.0 => {
                    let tries = pace.tries;
                    match is_cut {
                        true => controller.accept_cut(&mut pace, trial),
                        false => controller.accept(&mut pace, trial),
                    }
                    self.clock.pace = Some(pace);
                    self.count_step(interval, report, tries);
                    self.keep_present();
                    return self.ask(monitor);
                }
                Ok(Doubled { report, trial }) => {
                    adaptive.doubling.take_back(&mut self.model);
                    self.progress.count_rejection(report.iterations);
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
                    self.progress.count_try(before + iterations);
                    // Beyond an end there is nothing to compare; what comes after an arrival is not as what was.
                    self.clock.pace = Some(Pace { error: None, tries: 0, ..pace });
                    let middle = now + 0.5 * dt;
                    let half = Halving::new(Interval::between(now, middle));
                    return self.cover_uncompared(half, controller.first, monitor);
                }
                Err(Failed { source, .. }) if !source.may_be_cured_by_a_smaller_step() => {
                    return Err(SimulationError::Load { source });
                }
                Err(Failed { source, before }) => {
                    self.progress.count_failure(before + source.factorisations());
                    controller.fail(&mut pace, dt);
                    if is_least {
                        let smallest = controller.smallest;
                        return Err(SimulationError::Smallest { time: now, dt, smallest, source });
                    }
                }
            }
            self.clock.pace = Some(pace);
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
        let has_rattled = self.progress.arrivals.iter().nth_back(MOST_ARRIVALS - 1);
        if has_rattled.is_some_and(|arrival| arrival.time > self.time() - first) {
            return Err(self.rattles());
        }
        self.cover(halving, monitor).map(|_| ())
    }
}

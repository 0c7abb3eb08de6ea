//! Case of a study: scene, settings, and observation times.

use std::borrow::Cow;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};

use serde::{Deserialize, Serialize};

use super::CaseOutcome;
use super::run_limits::{CaseTimer, RunLimits};
use crate::simulation::{
    Monitor, Recording, Simulation, SimulationError, SimulationSettings, StepSize,
};
use crate::system::{Scene, Sensor};

#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Case {
    pub scene: Scene,
    pub settings: SimulationSettings,
    /// Observation times in increasing order [time]. The run ends at the last one.
    pub stops: Vec<f64>,
}

const MOST_ROWS: f64 = 1e5;

/// Largest relative difference of two step sizes that count as equal.
const SAME_STEP: f64 = 1e-9;

struct CaseMonitor<'a> {
    timer: CaseTimer,
    steps: usize,
    should_continue: &'a mut dyn FnMut() -> bool,
    exceeded: Option<String>,
}

impl Monitor for CaseMonitor<'_> {
    fn continues(&mut self, _time: f64) -> bool {
        self.steps += 1;
        self.exceeded = self.timer.exceeded(self.steps);
        self.exceeded.is_none() && (self.should_continue)()
    }
}

impl Case {
    /// Serialised case, without user-defined columns.
    /// The result is `None` if a schedule, of a load or drive for example, depends on a script function, or if a release has no fixed time.
    pub fn to_bytes(&self) -> Option<Vec<u8>> {
        let is_data = self.scene.schedules().all(|(_, schedule)| schedule.can_be_stored())
            && self.scene.release_times().count() == self.scene.releases.len();
        let mut case = Cow::Borrowed(self);
        if !self.scene.sensors.iter().all(Sensor::can_be_stored) {
            case.to_mut().scene.sensors.retain(Sensor::can_be_stored);
        }
        is_data.then(|| postcard::to_stdvec(&*case).ok()).flatten()
    }

    pub fn from_bytes(bytes: &[u8]) -> Option<Self> {
        postcard::from_bytes(bytes).ok()
    }

    /// Runs the case and calls `look` at every observation time.
    /// Returns the outcome and the final simulation; the simulation is `None` if the run could not start.
    pub fn run(
        &self,
        limits: RunLimits,
        stop: &AtomicBool,
        look: impl FnMut(&Simulation),
    ) -> (CaseOutcome, Option<Simulation>) {
        let mut simulation = match self.start(limits) {
            Ok(simulation) => simulation,
            Err(outcome) => return (outcome, None),
        };
        simulation.record(self.recording());
        let mut is_wanted = || !stop.load(Ordering::Relaxed);
        let outcome = self.run_to_stops(&mut simulation, limits, &mut is_wanted, look);
        (outcome, Some(simulation))
    }

    pub fn is_one_step_from_stop_to_stop(&self, dt: f64) -> bool {
        let end = self.stops.last().copied().unwrap_or(0.0);
        let breaks = self.scene.schedules().flat_map(|(_, schedule)| schedule.breaks());
        let cuts = breaks.chain(self.scene.release_times());
        let mut times: Vec<f64> = cuts.filter(|time| *time > 0.0 && *time < end).collect();
        times.extend_from_slice(&self.stops);
        times.sort_by(f64::total_cmp);
        let starts = std::iter::once(&0.0).chain(&times);
        starts.zip(&times).all(|(start, stop)| (stop - start) / dt <= 1.0 + SAME_STEP)
    }

    fn recording(&self) -> Recording {
        let steps = match (self.settings.dt, self.stops.last()) {
            (StepSize::Fixed(dt), Some(end)) => end / dt,
            _ => 0.0,
        };
        let every = NonZeroUsize::new((steps / MOST_ROWS).ceil() as usize);
        every.map_or_else(Recording::default, Recording::Every)
    }

    /// Builds the simulation in its initial state, or returns the reason for failure.
    /// Each simulation uses one thread, because studies run several cases at once or measure run times.
    pub fn start(&self, limits: RunLimits) -> Result<Simulation, CaseOutcome> {
        let wait = limits.begin();
        let started = Simulation::start(self.scene.clone(), self.settings);
        let mut simulation = started.map_err(|error| match wait.exceeded(0) {
            Some(limit) => CaseOutcome::LimitExceeded { time: 0.0, limit },
            None => CaseOutcome::Failed { time: 0.0, reason: error.to_string() },
        })?;
        simulation.use_threads(1);
        Ok(simulation)
    }

    /// Runs a simulation to the last observation time, and calls `look` at every observation time.
    /// If the callback `is_wanted`, called after every step, returns false, the run stops and its outcome is not valid.
    pub fn run_to_stops(
        &self,
        simulation: &mut Simulation,
        limits: RunLimits,
        is_wanted: &mut dyn FnMut() -> bool,
        mut look: impl FnMut(&Simulation),
    ) -> CaseOutcome {
        let mut watch = CaseMonitor {
            timer: limits.begin(),
            steps: 0,
            should_continue: is_wanted,
            exceeded: None,
        };
        for stop in &self.stops {
            let run = simulation.run_to(*stop, &mut watch);
            let time = simulation.time();
            // A step that is cut off by the time limit fails with an error; the limit is reported instead.
            let exceeded = match run {
                Ok(()) => watch.exceeded.take(),
                Err(_) => watch.exceeded.take().or_else(|| watch.timer.exceeded(watch.steps)),
            };
            match (run, exceeded) {
                (_, Some(limit)) => return CaseOutcome::LimitExceeded { time, limit },
                (Err(error), None) => {
                    return CaseOutcome::Failed { time, reason: error.to_string() };
                }
                (Ok(()), None) => match simulation.ending() {
                    Some(ending) if !simulation.has_reached(*stop) => {
                        let reason = SimulationError::Ended { ending }.to_string();
                        return CaseOutcome::Failed { time, reason };
                    }
                    _ => look(simulation),
                },
            }
        }
        CaseOutcome::Finished
    }
}

#[cfg(test)]
mod tests {
    use std::rc::Rc;
    use std::time::Duration;

    use super::super::run_limits::is_past_deadline;
    use super::super::samples::{never, spinning};
    use super::*;
    use crate::loads::{FunctionError, LoadKind, Schedule};

    #[test]
    fn case_read_from_bytes_is_observed_at_the_same_stops() {
        let case = spinning(0.1, &[0.25, 1.0]);
        let again = Case::from_bytes(&case.to_bytes().unwrap()).unwrap();
        let energies = |case: &Case| {
            let mut seen = Vec::new();
            let look = |simulation: &Simulation| {
                let last = simulation.history().samples().last().unwrap();
                seen.push((simulation.time(), last.measures.energy.total()));
            };
            assert!(case.run(RunLimits::default(), &never(), look).0.is_finished());
            seen
        };
        assert_eq!(energies(&case).iter().map(|(time, _)| *time).collect::<Vec<_>>(), [0.25, 1.0]);
        assert_eq!(energies(&case), energies(&again));
        assert!(Case::from_bytes(b"?").is_none());
    }

    #[test]
    fn run_of_a_million_steps_is_recorded_partially() {
        let every = |dt| spinning(dt, &[1.0]).recording();
        assert_eq!(every(1e-5), Recording::default());
        assert_eq!(every(1e-6), Recording::Every(NonZeroUsize::new(10).unwrap()));
        assert_eq!(every(f64::NAN), Recording::default());
    }

    #[test]
    fn steps_that_span_every_interval_between_stops_are_detected() {
        let mut case = spinning(0.1, &[0.5, 2.0]);
        assert!(
            case.is_one_step_from_stop_to_stop(1.5) && !case.is_one_step_from_stop_to_stop(1.0)
        );
        let station = case.scene.station(0, 0.0).unwrap();
        let schedule = Schedule::hold_for(1.0).unwrap();
        case.scene.add_load(LoadKind::Moment { station, moment: 1.0 }, schedule);
        assert!(
            case.is_one_step_from_stop_to_stop(1.0) && !case.is_one_step_from_stop_to_stop(0.9)
        );
    }

    #[test]
    fn outcome_describes_the_reason_of_an_early_end() {
        let (outcome, simulation) =
            spinning(-1.0, &[1.0]).run(RunLimits::default(), &never(), |_| ());
        assert!(outcome.describe().contains("failed at t = 0: the step size"), "{outcome:?}");
        assert!(simulation.is_none());
        let limits = RunLimits { steps: 3, ..RunLimits::default() };
        let (outcome, simulation) = spinning(0.1, &[1.0]).run(limits, &never(), |_| ());
        assert!(outcome.describe().contains("more than 3 steps"), "{outcome:?}");
        assert_eq!(simulation.unwrap().counts().steps, 4);
    }

    #[test]
    fn load_function_that_does_not_return_exceeds_the_time_limit() {
        let mut case = spinning(0.1, &[1.0]);
        let station = case.scene.station(0, 0.0).unwrap();
        let function = Rc::new(|t: f64| match t {
            0.5.. => {
                while !is_past_deadline() {}
                Err(FunctionError::new("stopped"))
            }
            _ => Ok(0.0),
        });
        let schedule = Schedule::Function { function, breaks: Vec::new() };
        case.scene.add_load(LoadKind::Moment { station, moment: 1.0 }, schedule);
        let limits = RunLimits { wall: Duration::from_secs(1), ..RunLimits::default() };
        let (outcome, _) = case.run(limits, &never(), |_| ());
        let message = outcome.describe();
        assert!(message.starts_with("stopped at t = 0.5 by a limit"), "{message}");
        assert!(message.ends_with(": more than 1 s"), "{message}");
        assert!(!is_past_deadline(), "each case has its own time limit");
    }
}

//! What a run of a study shows: the observables, the work, what drifted; and the time it takes.

use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::observable::Observable;
use super::truth::Readings;
use super::{Case, Outcome, Patience};
use crate::simulation::{History, Invariant, Simulation};

/// A run that was looked at.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Trial {
    /// How it ended.
    pub outcome: Outcome,
    /// The observables at the stops that it reached.
    pub readings: Readings,
    /// The unknowns of a step.
    pub unknowns: usize,
    /// Steps that succeeded.
    pub steps: usize,
    /// Newton iterations of these steps.
    pub newton_iterations: usize,
    /// Factorised matrices, failed tries included.
    pub factorisations: usize,
    /// Failed tries.
    pub retries: usize,
    /// The drifts of the whole run, loads accounted for, in the order of [`Invariant::ALL`].
    pub drifts: [f64; 4],
    /// The drift of the energy after the last work of a load; NaN where loads work to the end.
    pub free_energy_drift: f64,
}

impl Trial {
    /// Runs a case and looks at it.
    pub fn of(
        case: &Case,
        observables: &[Observable],
        patience: Patience,
        stop: &AtomicBool,
    ) -> Self {
        let mut readings = Readings::new();
        let look = |simulation: &Simulation| {
            readings.push(observables.iter().map(|of| of.read(simulation)).collect());
        };
        let (outcome, simulation) = case.run(patience, stop, look);
        let Some(simulation) = simulation else { return Self::without_a_run(outcome) };
        let (counts, history) = (simulation.counts(), simulation.history());
        Self {
            outcome,
            readings,
            unknowns: simulation.unknowns(),
            steps: counts.steps,
            newton_iterations: counts.newton_iterations,
            factorisations: counts.factorisations,
            retries: counts.retries,
            drifts: Invariant::ALL.map(|(_, of)| history.drift(of)),
            free_energy_drift: free_energy_drift(history),
        }
    }

    /// A run that never began.
    pub fn without_a_run(outcome: Outcome) -> Self {
        Self {
            outcome,
            readings: Readings::new(),
            unknowns: 0,
            steps: 0,
            newton_iterations: 0,
            factorisations: 0,
            retries: 0,
            drifts: [f64::NAN; 4],
            free_energy_drift: f64::NAN,
        }
    }
}

/// The drift of the energy from the last change of the work of the loads on.
fn free_energy_drift(history: &History) -> f64 {
    let works = || history.samples().iter().map(|row| row.measures.work);
    let Some(last) = works().next_back() else { return f64::NAN };
    let last_change = works().rposition(|work| work != last);
    let free = history.samples().iter().skip(last_change.map_or(0, |row| row + 1));
    let times: Vec<f64> = free.map(|row| row.measures.time).collect();
    match times.as_slice() {
        [first, .., end] => history.between(*first, *end).drift(Invariant::Energy),
        _ => f64::NAN,
    }
}

/// How long a case takes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    /// Median time to build the scene and its model.
    pub setup: Duration,
    /// Median time of the run by the clock.
    pub run: Duration,
    /// The shortest time of the run by the clock.
    pub shortest: Duration,
    /// Median time that the processor worked on the run; none where the system does not tell. On a machine that is busy with
    /// something else this is what the run itself takes.
    pub processor: Option<Duration>,
    /// How often it was run.
    pub repeats: usize,
}

/// A case that has been run for so long is not repeated any more.
pub const ENOUGH: Duration = Duration::from_secs(10);

/// The time that the processor has worked on this thread, as Linux tells it: exact after a pause, else only at every tick.
fn processor_time() -> Option<Duration> {
    std::thread::sleep(Duration::from_nanos(1));
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    told.split_whitespace().next()?.parse().ok().map(Duration::from_nanos)
}

impl Timing {
    /// The time of the run: that of the processor, or by the clock where the system does not tell [s].
    pub fn price(&self) -> f64 {
        self.processor.unwrap_or(self.run).as_secs_f64()
    }

    /// Runs a case several times on this thread and takes medians; fewer times when that takes longer than [`ENOUGH`], but
    /// once at least. None when `is_wanted` says no on the way, or a run fails.
    pub fn of(
        case: &Case,
        patience: Patience,
        repeats: usize,
        is_wanted: &mut dyn FnMut() -> bool,
    ) -> Option<Self> {
        let begun = Instant::now();
        let (mut setups, mut runs, mut works) = (Vec::new(), Vec::new(), Vec::new());
        while runs.is_empty() || (runs.len() < repeats && begun.elapsed() < ENOUGH) {
            let start = Instant::now();
            let mut simulation = case.start().ok()?;
            setups.push(start.elapsed());
            let worked = processor_time();
            let start = Instant::now();
            let outcome = case.go(&mut simulation, patience, is_wanted, |_| ());
            runs.push(start.elapsed());
            works
                .extend(processor_time().zip(worked).map(|(end, start)| end.saturating_sub(start)));
            if !outcome.is_finished() || !is_wanted() {
                return None;
            }
        }
        let shortest = runs.iter().copied().min()?;
        let repeats = runs.len();
        // A clock of the processor that does not move is none.
        let processor = median(works).filter(|time| !time.is_zero());
        Some(Self { setup: median(setups)?, run: median(runs)?, shortest, processor, repeats })
    }
}

/// The one in the middle; of an even number the mean of the two.
fn median(mut durations: Vec<Duration>) -> Option<Duration> {
    durations.sort_unstable();
    let upper = durations.len() / 2;
    let lower = durations.len().checked_sub(1)? / 2;
    Some((durations[lower] + durations[upper]) / 2)
}

#[cfg(test)]
mod tests {
    use super::super::samples::{never, spinning};
    use super::*;
    use crate::beams::Station;
    use crate::loads::{Frame, LoadKind, Schedule};

    #[test]
    fn a_trial_has_readings_at_all_stops_and_counts_its_work() {
        let tip: Vec<_> = Observable::of_station("tip", Station::on_beam(0, 2.0)).collect();
        let trial = Trial::of(&spinning(0.1, &[0.5, 1.0]), &tip, Patience::default(), &never());
        assert_eq!((trial.outcome, trial.steps), (Outcome::Finished, 10));
        assert_eq!((trial.readings.len(), trial.readings[0].len()), (2, 2));
        assert!((trial.readings[1][1].x - 1.0).abs() < 0.01, "{:?}", trial.readings);
        assert!(trial.drifts[..3].iter().all(|drift| *drift < 1e-13));
        assert!(trial.free_energy_drift < 1e-13);
        let failed = Trial::of(&spinning(-0.1, &[0.5]), &tip, Patience::default(), &never());
        assert!(!failed.outcome.is_finished() && failed.readings.is_empty());
    }

    #[test]
    fn the_energy_is_free_after_the_last_work_of_a_load() {
        let pushed_for = |duration: f64| {
            let mut case = spinning(0.1, &[2.0]);
            case.settings.method = crate::integrators::Method::Trapezoidal;
            let station = case.scene.station(0, 2.0).unwrap();
            let force = nalgebra::Vector2::new(0.0, 5.0);
            let kind = LoadKind::Force { station, force, frame: Frame::Dead };
            case.scene.add_load(kind, Schedule::hold_for(duration).unwrap());
            let trial = Trial::of(&case, &[], Patience::default(), &never());
            let history = case.run(Patience::default(), &never(), |_| ()).1.unwrap();
            (trial, history.history().between(duration, 2.0).drift(Invariant::Energy))
        };
        let (trial, expected) = pushed_for(1.0);
        assert!(expected > 0.0 && trial.free_energy_drift == expected, "{trial:?} {expected}");
        assert!(pushed_for(9.0).0.free_energy_drift.is_nan());
    }

    #[test]
    fn a_case_is_timed_as_often_as_asked_unless_nobody_wants_it() {
        let case = spinning(0.1, &[0.2]);
        let timing = Timing::of(&case, Patience::default(), 3, &mut || true).unwrap();
        assert!(timing.repeats == 3 && timing.shortest <= timing.run && timing.price() > 0.0);
        assert_eq!(Timing::of(&case, Patience::default(), 3, &mut || false), None);
        assert_eq!(Timing::of(&spinning(-1.0, &[1.0]), Patience::default(), 3, &mut || true), None);
    }

    #[test]
    fn the_median_of_two_is_their_mean() {
        let of =
            |millis: &[u64]| median(millis.iter().map(|ms| Duration::from_millis(*ms)).collect());
        assert_eq!(of(&[9, 1]), Some(Duration::from_millis(5)));
        assert_eq!(of(&[9, 1, 2]), Some(Duration::from_millis(2)));
        assert_eq!(of(&[]), None);
    }
}

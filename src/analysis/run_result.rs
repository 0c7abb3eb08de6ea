//! Results of a run: observables, solver statistics and drifts.

use std::sync::atomic::AtomicBool;

use serde::{Deserialize, Serialize};

use super::observable::Observable;
use super::reference::Readings;
use super::{Case, CaseOutcome, RunLimits};
use crate::simulation::{History, Invariant, Simulation};

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunResult {
    pub outcome: CaseOutcome,
    pub readings: Readings,
    pub unknowns: usize,
    pub steps: usize,
    pub newton_iterations: usize,
    pub factorisations: usize,
    pub retries: usize,
    pub drifts: [f64; 4],
    /// Energy drift during the last part of the run, in which the history column `work` is constant; NaN if it changes until the end.
    pub free_energy_drift: f64,
}

impl RunResult {
    pub fn of(
        case: &Case,
        observables: &[Observable],
        limits: RunLimits,
        stop: &AtomicBool,
    ) -> Self {
        let mut readings = Readings::new();
        let look = |simulation: &Simulation| {
            readings.push(observables.iter().map(|of| of.read(simulation)).collect());
        };
        let (outcome, simulation) = case.run(limits, stop, look);
        let Some(simulation) = simulation else { return Self::not_started(outcome) };
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

    pub fn not_started(outcome: CaseOutcome) -> Self {
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

#[cfg(test)]
mod tests {
    use super::super::samples::{never, spinning};
    use super::*;
    use crate::beams::Station;
    use crate::loads::{LoadFrame, LoadKind, Schedule};

    #[test]
    fn run_result_has_readings_at_all_stops_and_step_counts() {
        let tip: Vec<_> = Observable::of_station("tip", Station::on_beam(0, 2.0)).collect();
        let trial =
            RunResult::of(&spinning(0.1, &[0.5, 1.0]), &tip, RunLimits::default(), &never());
        assert_eq!((trial.outcome, trial.steps), (CaseOutcome::Finished, 10));
        assert_eq!((trial.readings.len(), trial.readings[0].len()), (2, 2));
        assert!((trial.readings[1][1].x - 1.0).abs() < 0.01, "{:?}", trial.readings);
        assert!(trial.drifts[..3].iter().all(|drift| *drift < 1e-13));
        assert!(trial.free_energy_drift < 1e-13);
        let failed = RunResult::of(&spinning(-0.1, &[0.5]), &tip, RunLimits::default(), &never());
        assert!(!failed.outcome.is_finished() && failed.readings.is_empty());
    }

    #[test]
    fn free_energy_drift_is_measured_after_the_load_ends() {
        let pushed_for = |duration: f64| {
            let mut case = spinning(0.1, &[2.0]);
            case.settings.method = crate::integrators::Method::Trapezoidal;
            let station = case.scene.station(0, 2.0).unwrap();
            let force = nalgebra::Vector2::new(0.0, 5.0);
            let kind = LoadKind::Force { station, force, frame: LoadFrame::Dead };
            case.scene.add_load(kind, Schedule::hold_for(duration).unwrap());
            let trial = RunResult::of(&case, &[], RunLimits::default(), &never());
            let history = case.run(RunLimits::default(), &never(), |_| ()).1.unwrap();
            (trial, history.history().between(duration, 2.0).drift(Invariant::Energy))
        };
        let (trial, expected) = pushed_for(1.0);
        assert!(expected > 0.0 && trial.free_energy_drift == expected, "{trial:?} {expected}");
        assert!(pushed_for(9.0).0.free_energy_drift.is_nan());
    }
}

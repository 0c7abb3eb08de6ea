//! Work–precision studies: cost and error of many combinations, and their Pareto front.

use super::external_results::ExternalResult;
use super::observable::Observable;
use super::pareto::pareto_front;
use super::reference::{Deviation, ReferenceSolution};
use super::run_result::RunResult;
use super::timing::Timing;
use crate::simulation::{SimulationSettings, StepSize};

#[derive(Debug, Clone, PartialEq)]
pub struct PrecisionRow {
    pub mesh: String,
    pub settings: SimulationSettings,
    pub result: RunResult,
    /// Run time; `None` if the run failed.
    pub timing: Option<Timing>,
    /// Largest distance of a station from its reference position, as a fraction of the length scale of the study; `None` if the run failed.
    pub error: Option<Deviation>,
    /// Error of each observable, in its unit; `None` if the run failed or the reference lacks the observable.
    pub deviations: Vec<Option<Deviation>>,
    pub is_on_front: bool,
}

impl PrecisionRow {
    pub fn new(
        (mesh, settings): (String, SimulationSettings),
        result: RunResult,
        timing: Option<Timing>,
        (observables, reference_solution, length): (&[Observable], &ReferenceSolution, f64),
    ) -> Self {
        let is_finished = result.outcome.is_finished();
        let of =
            |index| reference_solution.deviation(index, &result.readings).filter(|_| is_finished);
        let deviations = (0..observables.len()).map(of).collect();
        let error =
            reference_solution.of_positions(observables, &result.readings).filter(|_| is_finished);
        let error = error.map(|error| error.divided_by(length));
        Self { mesh, settings, result, timing, error, deviations, is_on_front: false }
    }

    /// Run time [s] and error [-]; infinite if unknown.
    pub fn cost_and_error(&self) -> (f64, f64) {
        let price = self.timing.map_or(f64::INFINITY, |timing| timing.cost());
        (price, self.error.map_or(f64::INFINITY, |error| error.error()))
    }

    fn is_with_a_smaller_step_than(&self, other: &Self) -> bool {
        let (StepSize::Fixed(own), StepSize::Fixed(others)) = (self.settings.dt, other.settings.dt)
        else {
            return false;
        };
        self.mesh == other.mesh && self.settings.method == other.settings.method && own < others
    }
}

#[derive(Debug, Clone, PartialEq)]
pub struct Precision {
    pub name: String,
    /// Times at which results are compared [time]. Runs end at the last of these times.
    pub times: Vec<f64>,
    /// Length by which errors of positions are divided [length].
    pub length: f64,
    pub observables: Vec<Observable>,
    pub reference: ReferenceSolution,
    pub rows: Vec<PrecisionRow>,
    pub external_results: Vec<ExternalResult>,
}

impl Precision {
    pub fn mark_front(&mut self) {
        let points: Vec<_> = self.rows.iter().map(PrecisionRow::cost_and_error).collect();
        for (row, is_on_front) in self.rows.iter_mut().zip(pareto_front(&points)) {
            row.is_on_front = is_on_front;
        }
    }

    pub fn front(&self) -> Vec<&PrecisionRow> {
        let mut front: Vec<_> = self.rows.iter().filter(|row| row.is_on_front).collect();
        front.sort_by(|a, b| a.cost_and_error().0.total_cmp(&b.cost_and_error().0));
        front
    }

    /// Fastest combination with an error of at most `error` [-].
    pub fn cheapest(&self, error: f64) -> Option<&PrecisionRow> {
        self.front().into_iter().find(|row| row.cost_and_error().1 <= error)
    }

    /// Fastest combination with an error of at most `error` [-] whose runs with smaller steps on the same mesh also meet this limit.
    /// Without runs with smaller steps, the errors of mesh and steps might cancel by chance.
    pub fn cheapest_confirmed(&self, error: f64) -> Option<&PrecisionRow> {
        let is_right = |row: &&PrecisionRow| row.cost_and_error().1 <= error;
        let is_confirmed = |row: &&PrecisionRow| {
            let smaller = |other: &&PrecisionRow| other.is_with_a_smaller_step_than(row);
            let finished = self.rows.iter().filter(|other| other.error.is_some());
            let mut smaller = finished.filter(smaller).peekable();
            smaller.peek().is_some() && smaller.all(|other| is_right(&other))
        };
        let confirmed = self.rows.iter().filter(is_right).filter(is_confirmed);
        confirmed.min_by(|a, b| a.cost_and_error().0.total_cmp(&b.cost_and_error().0))
    }

    pub fn program_names(&self) -> Vec<&str> {
        let mut peers = Vec::new();
        for peer in
            self.external_results.iter().map(|external_result| external_result.program.as_str())
        {
            if !peers.contains(&peer) {
                peers.push(peer);
            }
        }
        peers
    }

    /// Fastest run of another program with an error of at most `error` [-].
    pub fn cheapest_of(&self, peer: &str, error: f64) -> Option<&ExternalResult> {
        let able = self.external_results.iter().filter(|external_result| {
            external_result.program == peer && external_result.error <= error
        });
        able.min_by(|a, b| a.run_time.total_cmp(&b.run_time))
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::super::RunLimits;
    use super::super::samples::{never, spinning};
    use super::*;
    use crate::beams::Station;

    fn study() -> Precision {
        let observables: Vec<_> = Observable::of_station("tip", Station::on_beam(0, 2.0)).collect();
        let trial = |dt| {
            RunResult::of(&spinning(dt, &[0.5, 1.0]), &observables, RunLimits::default(), &never())
        };
        let reference_solution = ReferenceSolution::of_run("own", &trial(0.01).readings);
        let row = |(dt, millis): (f64, u64)| {
            let run = Duration::from_millis(millis);
            let timing = Timing { setup: run, run, shortest: run, processor: None, repeats: 1 };
            let trial = trial(dt);
            let timing = trial.outcome.is_finished().then_some(timing);
            let settings = spinning(dt, &[1.0]).settings;
            PrecisionRow::new(
                ("m".into(), settings),
                trial,
                timing,
                (&observables, &reference_solution, 2.0),
            )
        };
        let rows = [(-0.1, 1), (0.25, 2), (0.125, 4), (0.25, 3)].map(row).to_vec();
        let external_result = |peer: &str, run_time, error| ExternalResult {
            program: peer.into(),
            series: peer.into(),
            setting: String::new(),
            run_time,
            error,
            energy_drift: 0.0,
            machine: "m".into(),
        };
        let external_results = vec![
            external_result("P", 9.0, 1e-9),
            external_result("P", 1.0, 0.5),
            external_result("Q", 1.0, 0.9),
        ];
        let (name, times, length) = ("s".into(), vec![0.5, 1.0], 2.0);
        let mut study = Precision {
            name,
            times,
            length,
            observables,
            reference: reference_solution,
            rows,
            external_results,
        };
        study.mark_front();
        study
    }

    #[test]
    fn smaller_steps_reduce_errors_and_failed_runs_remain_listed() {
        let study = study();
        let errors: Vec<f64> = study.rows.iter().map(|row| row.cost_and_error().1).collect();
        assert!(
            errors[0].is_infinite() && errors[2] < 0.3 * errors[1] && errors[2] > 0.0,
            "{errors:?}"
        );
        let front: Vec<bool> = study.rows.iter().map(|row| row.is_on_front).collect();
        assert_eq!(front, [false, true, true, false]);
        let of_tip = study.rows[1].deviations[0].unwrap().error();
        assert_eq!(of_tip / 2.0, errors[1]);
        assert_eq!(study.cheapest(errors[1]).unwrap(), &study.rows[1]);
        assert_eq!(study.cheapest(0.5 * errors[1]).unwrap(), &study.rows[2]);
        assert!(study.cheapest(0.0).is_none());
    }

    #[test]
    fn result_is_unconfirmed_if_smaller_steps_have_larger_errors() {
        let mut study = study();
        let error = study.rows[1].cost_and_error().1;
        assert_eq!(study.cheapest_confirmed(error).unwrap(), &study.rows[1]);
        assert!(study.cheapest_confirmed(0.5 * error).is_none());
        study.rows[2].error = study.rows[1].error.map(|error| error.divided_by(0.5));
        assert!(study.cheapest_confirmed(error).is_none());
        assert_eq!(study.cheapest(error).unwrap(), &study.rows[1]);
    }

    #[test]
    fn cheapest_run_of_another_program_within_tolerance_is_chosen() {
        let study = study();
        assert_eq!(study.program_names(), ["P", "Q"]);
        assert_eq!(study.cheapest_of("P", 1e-3).unwrap().run_time, 9.0);
        assert_eq!(study.cheapest_of("P", 0.6).unwrap().run_time, 1.0);
        assert!(study.cheapest_of("Q", 0.6).is_none());
    }
}

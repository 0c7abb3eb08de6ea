//! Assessment of runs near the stability limit: outcome, energy growth, and iterations.

use std::sync::atomic::AtomicBool;

use serde::{Deserialize, Serialize};

use super::{Case, CaseOutcome, RunLimits};
use crate::simulation::Simulation;
use crate::system::Scene;

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StabilityVerdict {
    pub outcome: CaseOutcome,
    /// Largest increase of the energy minus the work of the loads above any earlier value of this difference.
    /// The increase is given as a fraction of the largest energy, and is measured after the last jump or kink of a schedule,
    /// or over the whole run if it ends before.
    /// It is NaN if the run did not start or if an energy is NaN.
    pub energy_growth: f64,
    pub steps: usize,
    pub mean_iterations: f64,
    pub most_iterations: usize,
    pub retries: usize,
}

impl StabilityVerdict {
    pub fn of(case: &Case, limits: RunLimits, stop: &AtomicBool) -> Self {
        let (outcome, simulation) = case.run(limits, stop, |_| ());
        match simulation {
            Some(simulation) => Self::on(&simulation, outcome),
            None => Self::not_started(outcome),
        }
    }

    fn on(simulation: &Simulation, outcome: CaseOutcome) -> Self {
        let counts = simulation.counts();
        let free = simulation.history().between(rest(simulation.scene()), f64::INFINITY);
        let rows = if free.samples().len() > 1 { &free } else { simulation.history() };
        Self {
            outcome,
            energy_growth: rows.energy_growth(),
            steps: counts.steps,
            mean_iterations: counts.newton_iterations as f64 / counts.steps.max(1) as f64,
            most_iterations: counts.newton_max,
            retries: counts.retries,
        }
    }

    pub fn not_started(outcome: CaseOutcome) -> Self {
        Self {
            outcome,
            energy_growth: f64::NAN,
            steps: 0,
            mean_iterations: f64::NAN,
            most_iterations: 0,
            retries: 0,
        }
    }
}

fn rest(scene: &Scene) -> f64 {
    scene.schedules().flat_map(|(_, schedule)| schedule.breaks()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::super::samples::{never, spinning};
    use super::*;
    use crate::integrators::Method;
    use crate::loads::{LoadKind, Schedule};

    fn verdict(case: &Case) -> StabilityVerdict {
        StabilityVerdict::of(case, RunLimits::default(), &never())
    }

    #[test]
    fn energy_grows_with_the_trapezoidal_rule_but_not_energy_momentum() {
        let mut case = spinning(0.1, &[4.0]);
        let station = case.scene.station(0, 0.0).unwrap();
        let schedule = Schedule::hold_for(1.0).unwrap();
        case.scene.add_load(LoadKind::Moment { station, moment: 80.0 }, schedule);
        assert_eq!(rest(&case.scene), 1.0);
        let kept = verdict(&case);
        assert!(kept.outcome.is_finished() && kept.energy_growth < 1e-13, "{kept:?}");
        assert!(kept.steps == 40 && kept.mean_iterations > 1.0 && kept.most_iterations < 8);
        case.settings.method = Method::Trapezoidal;
        let grown = verdict(&case);
        assert!(grown.energy_growth > 1e-6, "{grown:?}");
    }

    #[test]
    fn case_that_cannot_start_has_a_reason_and_nan_results() {
        let lost = verdict(&spinning(f64::NAN, &[1.0]));
        assert!(
            matches!(&lost.outcome, CaseOutcome::Failed { reason, .. } if reason.contains("step size"))
        );
        assert!(lost.energy_growth.is_nan() && lost.steps == 0);
    }
}

//! Cost of a time step: its run time, and the sizes of the model on which the run time depends.

use std::time::{Duration, Instant};

use super::timing::median;
use super::{Case, CaseOutcome, RunLimits};
use crate::integrators::Constraints;
use crate::simulation::{Recording, Simulation};

#[derive(Debug, Clone)]
pub struct CostCase {
    pub name: String,
    pub case: Case,
    pub recording: Recording,
    /// Memory for snapshots [bytes].
    pub snapshots: usize,
}

#[derive(Debug, Clone, PartialEq)]
pub struct StepCost {
    pub name: String,
    pub outcome: CaseOutcome,
    pub unknowns: usize,
    pub half_bandwidth: usize,
    pub border: usize,
    pub columns: usize,
    pub iterations: f64,
    pub factorisations: f64,
    pub shortest: Duration,
    pub median: Duration,
}

impl CostCase {
    fn start(&self, limits: RunLimits) -> Result<Simulation, CaseOutcome> {
        let mut simulation = self.case.start(limits)?;
        simulation.record(self.recording);
        simulation.enable_snapshots(self.snapshots);
        Ok(simulation)
    }
}

impl StepCost {
    pub fn unmeasured(case: &CostCase, outcome: CaseOutcome) -> Self {
        Self {
            name: case.name.clone(),
            outcome,
            unknowns: 0,
            half_bandwidth: 0,
            border: 0,
            columns: 0,
            iterations: f64::NAN,
            factorisations: f64::NAN,
            shortest: Duration::ZERO,
            median: Duration::ZERO,
        }
    }
}

/// Measures the time per step of several cases; `None` if `is_wanted` returns false.
/// The cases are run in turn, several times, so that other load on the machine affects all cases equally.
pub fn step_costs(
    cases: &[CostCase],
    limits: RunLimits,
    repeats: usize,
    is_wanted: &mut dyn FnMut() -> bool,
) -> Option<Vec<StepCost>> {
    let mut times: Vec<Vec<Duration>> = vec![Vec::new(); cases.len()];
    let mut costs: Vec<Option<StepCost>> = vec![None; cases.len()];
    for round in 0..=repeats.max(1) {
        for (number, case) in cases.iter().enumerate() {
            let (cost, time) = measure(case, limits, is_wanted);
            if !is_wanted() {
                return None;
            }
            if round > 0 {
                times[number].push(time);
                costs[number] = Some(cost);
            }
        }
    }
    let cost = |(cost, times): (StepCost, Vec<Duration>)| {
        let shortest = times.iter().copied().min().unwrap_or_default();
        StepCost { shortest, median: median(times).unwrap_or_default(), ..cost }
    };
    Some(costs.into_iter().flatten().zip(times).map(cost).collect())
}

fn measure(
    case: &CostCase,
    limits: RunLimits,
    is_wanted: &mut dyn FnMut() -> bool,
) -> (StepCost, Duration) {
    let mut simulation = match case.start(limits) {
        Ok(simulation) => simulation,
        Err(outcome) => return (StepCost::unmeasured(case, outcome), Duration::ZERO),
    };
    let begun = Instant::now();
    let outcome = case.case.run_to_stops(&mut simulation, limits, is_wanted, |_| ());
    let elapsed = begun.elapsed();
    let counts = simulation.counts();
    let steps = counts.steps.max(1);
    let a_step = |count: usize| count as f64 / steps as f64;
    let cost = StepCost {
        unknowns: simulation.unknowns(),
        half_bandwidth: simulation.half_bandwidth(),
        border: simulation.model().constraint_shape().width,
        columns: simulation.history().columns().count(),
        iterations: a_step(counts.newton_iterations),
        factorisations: a_step(counts.factorisations),
        ..StepCost::unmeasured(case, outcome)
    };
    (cost, elapsed.div_f64(steps as f64))
}

#[cfg(test)]
mod tests {
    use super::super::samples::spinning;
    use super::*;

    fn case(name: &str, dt: f64) -> CostCase {
        let case = spinning(dt, &[1.0]);
        let recording = Recording::Nothing;
        CostCase { name: name.into(), case, recording, snapshots: 0 }
    }

    #[test]
    fn step_costs_have_the_order_of_the_cases() {
        let mut never_enough = || true;
        let cases = [case("first", 0.1), case("lost", -1.0), case("second", 0.05)];
        let costs = step_costs(&cases, RunLimits::default(), 2, &mut never_enough).unwrap();
        assert_eq!(
            costs.iter().map(|cost| &*cost.name).collect::<Vec<_>>(),
            ["first", "lost", "second"]
        );
        assert!(costs[0].iterations >= 1.0 && costs[0].unknowns == 15, "{:?}", costs[0]);
        assert!(costs[0].shortest > Duration::ZERO && costs[0].shortest <= costs[0].median);
        assert!(!costs[1].outcome.is_finished());
        assert_eq!(step_costs(&cases, RunLimits::default(), 2, &mut || false), None);
        let impatient = RunLimits { steps: 3, ..RunLimits::default() };
        let costs = step_costs(&cases, impatient, 1, &mut || true).unwrap();
        assert!(matches!(costs[0].outcome, CaseOutcome::LimitExceeded { .. }), "{:?}", costs[0]);
    }
}

//! What a run has done so far: its work, its last step, and arrivals of sliders.

use std::rc::Rc;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::{Arrival, ArrivalKind, ReleaseEvent, Sample};
use crate::integrators::Interval;
use crate::newton::NewtonReport;

/// The work of a run so far.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct WorkCounts {
    /// The number of steps that succeeded; two halves that are compared with a whole one count as one.
    pub steps: usize,
    /// The number of Newton iterations of the steps that succeeded, each with new factors; for steps of varying size those of all three
    /// solves that a pair of half steps takes.
    pub newton_iterations: usize,
    /// The number of corrections of the steps that succeeded, with factors at hand.
    pub corrections: usize,
    /// The most Newton iterations of one step: of one solve where steps are fixed, of its three solves together where they vary.
    pub newton_max: usize,
    /// The number of factorised matrices of the run, failed tries included.
    pub factorisations: usize,
    /// The number of failed tries of steps.
    pub retries: usize,
    /// The number of steps that erred by more than a tolerance allowed.
    pub rejected: usize,
    /// The number of steps that were tried to find when a slider arrives at the end of its master.
    pub arrival_tries: usize,
    /// The time that this program spent in steps: it is not in files, which would differ from run to run.
    #[serde(skip)]
    pub wall: Duration,
}

/// What the last step of a run took.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct StepTaken {
    /// The length of the last step; zero before there is one [time].
    pub(super) dt: f64,
    pub(super) newton_iterations: usize,
    pub(super) retries: usize,
}

impl StepTaken {
    /// What the step that led to a row of the history took.
    pub(super) fn of(row: &Sample) -> Self {
        Self { dt: row.dt, newton_iterations: row.newton_iterations, retries: row.retries }
    }
}

/// What a run has done so far: its work, its last step, its arrivals, its releases.
#[derive(Debug, Clone, Default)]
pub(super) struct RunProgress {
    pub(super) counts: WorkCounts,
    pub(super) last_step: StepTaken,
    pub(super) arrivals: Vec<Arrival>,
    /// In the order in which it let go; shared with the states to go back to.
    pub(super) let_go: Rc<[ReleaseEvent]>,
}

impl RunProgress {
    /// Counts a step that succeeded after some failed tries.
    pub(super) fn count_step(&mut self, interval: Interval, report: NewtonReport, retries: usize) {
        let NewtonReport { iterations, corrections, .. } = report;
        let counts = &mut self.counts;
        counts.steps += 1;
        counts.newton_iterations += iterations;
        counts.corrections += corrections;
        counts.newton_max = counts.newton_max.max(iterations);
        counts.factorisations += iterations;
        self.last_step =
            StepTaken { dt: interval.duration(), newton_iterations: iterations, retries };
    }

    /// Counts a step that passes without being solved.
    pub(super) fn count_pretended(&mut self, dt: f64) {
        self.counts.steps += 1;
        self.last_step = StepTaken { dt, ..StepTaken::default() };
    }

    /// Counts a step that was tried to find when a slider arrives.
    pub(super) fn count_try(&mut self, iterations: usize) {
        self.counts.arrival_tries += 1;
        self.counts.factorisations += iterations;
    }

    /// Counts a step that failed.
    pub(super) fn count_failure(&mut self, factorisations: usize) {
        self.counts.retries += 1;
        self.counts.factorisations += factorisations;
    }

    /// Counts a step that erred by more than a tolerance allows.
    pub(super) fn count_rejection(&mut self, iterations: usize) {
        self.counts.rejected += 1;
        self.counts.factorisations += iterations;
    }

    /// The arrival of a slider that ended the run, if there was one: nothing happens after it.
    pub(super) fn stopped(&self) -> Option<&Arrival> {
        self.arrivals.last().filter(|last| last.kind == ArrivalKind::Stopped)
    }
}

//! Progress of a run: solver statistics, last step, and arrivals of sliders.

use std::rc::Rc;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::{Arrival, ArrivalKind, ReleaseEvent, Sample};
use crate::integrators::Interval;
use crate::newton::NewtonReport;

/// Solver statistics of a run.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct WorkCounts {
    /// Number of successful steps. Two half steps that are compared with a whole step count as one step.
    pub steps: usize,
    /// Number of Newton iterations of successful steps.
    /// For variable steps, the Newton iterations of the whole step and its two halves are included.
    pub newton_iterations: usize,
    /// Number of corrections in successful steps. Corrections reuse earlier factors of the matrix.
    pub corrections: usize,
    /// Largest number of Newton iterations in one step. The iterations of a whole variable step and its two halves are added.
    pub newton_max: usize,
    /// Number of factorisations, including those of failed attempts.
    pub factorisations: usize,
    /// Number of failed attempts at steps.
    pub retries: usize,
    /// Number of steps rejected by the tolerance.
    pub rejected: usize,
    /// Number of steps that were attempted in order to find the times at which sliders arrive.
    pub arrival_tries: usize,
    /// Wall-clock time spent in steps. It is not stored in files, so that equal runs write equal files.
    #[serde(skip)]
    pub wall: Duration,
}

#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct StepTaken {
    /// Length of the last step [time]; zero before the first step.
    pub(super) dt: f64,
    pub(super) newton_iterations: usize,
    pub(super) retries: usize,
    /// Energy that dampers returned in the last step, in the backward substep of the fourth-order method [energy].
    pub(super) returned: f64,
}

impl StepTaken {
    pub(super) fn of(row: &Sample) -> Self {
        let Sample { dt, newton_iterations, retries, returned, .. } = *row;
        Self { dt, newton_iterations, retries, returned }
    }
}

#[derive(Debug, Clone, Default)]
pub(super) struct RunProgress {
    pub(super) counts: WorkCounts,
    pub(super) last_step: StepTaken,
    pub(super) arrivals: Vec<Arrival>,
    pub(super) releases: Rc<[ReleaseEvent]>,
}

impl RunProgress {
    pub(super) fn count_step(
        &mut self,
        interval: Interval,
        report: NewtonReport,
        retries: usize,
        returned: f64,
    ) {
        let NewtonReport { iterations, corrections, .. } = report;
        let counts = &mut self.counts;
        counts.steps += 1;
        counts.newton_iterations += iterations;
        counts.corrections += corrections;
        counts.newton_max = counts.newton_max.max(iterations);
        counts.factorisations += iterations;
        self.last_step =
            StepTaken { dt: interval.duration(), newton_iterations: iterations, retries, returned };
    }

    pub(super) fn count_dry_run(&mut self, dt: f64) {
        self.counts.steps += 1;
        self.last_step = StepTaken { dt, ..StepTaken::default() };
    }

    pub(super) fn count_try(&mut self, iterations: usize) {
        self.counts.arrival_tries += 1;
        self.counts.factorisations += iterations;
    }

    pub(super) fn count_failure(&mut self, factorisations: usize) {
        self.counts.retries += 1;
        self.counts.factorisations += factorisations;
    }

    pub(super) fn count_rejection(&mut self, iterations: usize) {
        self.counts.rejected += 1;
        self.counts.factorisations += iterations;
    }

    pub(super) fn stopped(&self) -> Option<&Arrival> {
        self.arrivals.last().filter(|last| last.kind == ArrivalKind::Stopped)
    }
}

//! Limits of runs in studies.

use std::cell::Cell;
use std::time::{Duration, Instant};

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunLimits {
    pub steps: usize,
    pub wall: Duration,
}

impl Default for RunLimits {
    fn default() -> Self {
        Self { steps: 10_000_000, wall: Duration::from_secs(600) }
    }
}

thread_local! {
    static DEADLINE: Cell<Option<Instant>> = const { Cell::new(None) };
}

/// Returns true if the time limit of the case on this thread has passed.
/// Long calculations within a step, such as script functions of loads, must call this function; the solver checks only after steps.
pub fn is_past_deadline() -> bool {
    DEADLINE.get().is_some_and(|deadline| Instant::now() > deadline)
}

pub(super) struct CaseTimer {
    start: Instant,
    limits: RunLimits,
    before: Option<Instant>,
}

impl RunLimits {
    pub(super) fn begin(self) -> CaseTimer {
        let begun = Instant::now();
        CaseTimer {
            start: begun,
            limits: self,
            before: DEADLINE.replace(begun.checked_add(self.wall)),
        }
    }
}

impl CaseTimer {
    pub(super) fn exceeded(&self, steps: usize) -> Option<String> {
        let RunLimits { steps: most, wall } = self.limits;
        if steps > most {
            Some(format!("more than {most} steps"))
        } else if self.start.elapsed() > wall {
            Some(format!("more than {} s", wall.as_secs_f64()))
        } else {
            None
        }
    }
}

impl Drop for CaseTimer {
    fn drop(&mut self) {
        DEADLINE.set(self.before);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nested_run_limits_restore_the_outer_deadline() {
        let patient = RunLimits::default().begin();
        assert!(!is_past_deadline() && patient.exceeded(3).is_none());
        {
            let wall = Duration::ZERO;
            let impatient = RunLimits { steps: 2, wall }.begin();
            while !is_past_deadline() {}
            assert_eq!(impatient.exceeded(3).unwrap(), "more than 2 steps");
            assert_eq!(impatient.exceeded(2).unwrap(), "more than 0 s");
        }
        assert!(!is_past_deadline());
        drop(patient);
        assert_eq!(DEADLINE.get(), None);
    }
}

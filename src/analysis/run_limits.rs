//! How long a study waits for a run.

use std::cell::Cell;
use std::time::{Duration, Instant};

/// How much a case of a study may take before it is given up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunLimits {
    /// The largest number of steps and failed tries of a case together.
    pub steps: usize,
    /// The longest time of a case by the clock.
    pub wall: Duration,
}

impl Default for RunLimits {
    fn default() -> Self {
        Self { steps: 10_000_000, wall: Duration::from_secs(600) }
    }
}

thread_local! {
    /// When patience with the case that runs on this thread ends.
    static DEADLINE: Cell<Option<Instant>> = const { Cell::new(None) };
}

/// Whether the case that runs on this thread should have ended by now. A case asks after every step itself; this is for whoever is
/// called within a step and may not come back, such as a load that is a function of a script.
pub fn is_out_of_patience() -> bool {
    DEADLINE.get().is_some_and(|deadline| Instant::now() > deadline)
}

/// The wait of a study for a case: it lasts as long as this lives.
pub(super) struct CaseTimer {
    begun: Instant,
    patience: RunLimits,
    before: Option<Instant>,
}

impl RunLimits {
    /// Begins to wait for a case, on this thread.
    pub(super) fn begin(self) -> CaseTimer {
        let begun = Instant::now();
        CaseTimer { begun, patience: self, before: DEADLINE.replace(begun.checked_add(self.wall)) }
    }
}

impl CaseTimer {
    /// What a case took too much of after so many steps, in words, if it did.
    pub(super) fn exceeded(&self, steps: usize) -> Option<String> {
        let RunLimits { steps: most, wall } = self.patience;
        if steps > most {
            Some(format!("more than {most} steps"))
        } else if self.begun.elapsed() > wall {
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
    fn waits_end_one_within_the_other() {
        let patient = RunLimits::default().begin();
        assert!(!is_out_of_patience() && patient.exceeded(3).is_none());
        {
            let wall = Duration::ZERO;
            let impatient = RunLimits { steps: 2, wall }.begin();
            while !is_out_of_patience() {}
            assert_eq!(impatient.exceeded(3).unwrap(), "more than 2 steps");
            assert_eq!(impatient.exceeded(2).unwrap(), "more than 0 s");
        }
        assert!(!is_out_of_patience());
        drop(patient);
        assert_eq!(DEADLINE.get(), None);
    }
}

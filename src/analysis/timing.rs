//! Run times of cases.

use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::{Case, RunLimits};

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    /// Median time to build the scene and its model.
    pub setup: Duration,
    pub run: Duration,
    pub shortest: Duration,
    /// Median processor time of the run; `None` if not available. The time of other processes on a busy machine is not included.
    pub processor: Option<Duration>,
    pub repeats: usize,
}

/// Total run time of the repetitions of a case after which the case is not run again.
pub const LONGEST_REPETITION: Duration = Duration::from_secs(10);

/// Processor time of this thread on Linux. The system updates this time when the thread pauses, and otherwise only at ticks of the scheduler.
/// The thread is paused before its processor time is read, because the system then updates this time.
fn processor_time() -> Option<Duration> {
    std::thread::sleep(Duration::from_nanos(1));
    let statistics = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    statistics.split_whitespace().next()?.parse().ok().map(Duration::from_nanos)
}

impl Timing {
    /// Cost of the case: the processor time or, if it is not available, the wall-clock time [s].
    pub fn cost(&self) -> f64 {
        self.processor.unwrap_or(self.run).as_secs_f64()
    }

    /// Runs a case several times on this thread, and computes medians of the times. After [`LONGEST_REPETITION`], the case is not run again.
    /// Returns `None` if `is_wanted` returns false or a run fails.
    pub fn of(
        case: &Case,
        limits: RunLimits,
        repeats: usize,
        is_wanted: &mut dyn FnMut() -> bool,
    ) -> Option<Self> {
        let begun = Instant::now();
        let (mut setups, mut runs, mut works) = (Vec::new(), Vec::new(), Vec::new());
        while runs.is_empty() || (runs.len() < repeats && begun.elapsed() < LONGEST_REPETITION) {
            let start = Instant::now();
            let mut simulation = case.start(limits).ok()?;
            setups.push(start.elapsed());
            let worked = processor_time();
            let start = Instant::now();
            let outcome = case.run_to_stops(&mut simulation, limits, is_wanted, |_| ());
            runs.push(start.elapsed());
            works
                .extend(processor_time().zip(worked).map(|(end, start)| end.saturating_sub(start)));
            if !outcome.is_finished() || !is_wanted() {
                return None;
            }
        }
        let shortest = runs.iter().copied().min()?;
        let repeats = runs.len();
        // A processor time of zero is ignored, because the clock has not advanced.
        let processor = median(works).filter(|time| !time.is_zero());
        Some(Self { setup: median(setups)?, run: median(runs)?, shortest, processor, repeats })
    }
}

pub(super) fn median(mut durations: Vec<Duration>) -> Option<Duration> {
    durations.sort_unstable();
    let upper = durations.len() / 2;
    let lower = durations.len().checked_sub(1)? / 2;
    Some((durations[lower] + durations[upper]) / 2)
}

#[cfg(test)]
mod tests {
    use super::super::samples::spinning;
    use super::*;

    #[test]
    fn a_case_is_timed_as_often_as_asked_unless_nobody_wants_it() {
        let case = spinning(0.1, &[0.2]);
        let timing = Timing::of(&case, RunLimits::default(), 3, &mut || true).unwrap();
        assert!(timing.repeats == 3 && timing.shortest <= timing.run && timing.cost() > 0.0);
        assert_eq!(Timing::of(&case, RunLimits::default(), 3, &mut || false), None);
        assert_eq!(
            Timing::of(&spinning(-1.0, &[1.0]), RunLimits::default(), 3, &mut || true),
            None
        );
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

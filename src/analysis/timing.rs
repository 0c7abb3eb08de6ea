//! Run times of cases.

use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::{Case, RunLimits};

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    pub setup: Duration,
    pub run: Duration,
    pub shortest: Duration,
    /// Median processor time of the run, without the time of other processes; `None` if not available.
    pub processor: Option<Duration>,
    pub repeats: usize,
}

/// Total time of the repetitions of a case, including their setup, after which it is not repeated again.
pub const LONGEST_REPETITION: Duration = Duration::from_secs(10);

/// Processor time of this thread on Linux.
/// The thread sleeps briefly before the time is read, because the system otherwise updates it only at scheduler ticks.
fn processor_time() -> Option<Duration> {
    std::thread::sleep(Duration::from_nanos(1));
    let statistics = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    statistics.split_whitespace().next()?.parse().ok().map(Duration::from_nanos)
}

impl Timing {
    /// Processor time of the run, or the wall-clock time if the processor time is not available [s].
    pub fn cost(&self) -> f64 {
        self.processor.unwrap_or(self.run).as_secs_f64()
    }

    /// Median times of repeated runs of a case on this thread; `None` if `is_wanted` returns false or a run fails.
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
        // A measured time of zero is ignored, because it shows only that the clock has not advanced.
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
    fn case_is_timed_the_requested_number_of_times_unless_cancelled() {
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

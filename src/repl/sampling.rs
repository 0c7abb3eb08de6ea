//! Repeated measurements of a run time, and their statistics.

use std::rc::Rc;
use std::time::Duration;

use rhai::Dynamic;

use super::clock::Clock;
use super::session::Rounds;

pub const LONGEST: Duration = Duration::from_secs(1);
/// Total run time after which an evaluation is not repeated again.
const TOTAL_TIME_LIMIT: Duration = Duration::from_secs(2);
const LEAST_TIME: Duration = Duration::from_millis(200);
const LEAST_RUNS: usize = 7;
const MOST_RUNS: usize = 10_000;
/// Relative error of the median run time below which an evaluation is not repeated again.
const KNOWN: f64 = 0.01;

pub struct Sampling {
    clock: Rc<dyn Clock>,
    start: Option<Duration>,
    round_start: Duration,
    durations: Vec<Duration>,
    next_evaluation: usize,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Figures {
    pub runs: usize,
    pub least: Duration,
    pub median: Duration,
    pub quartiles: (Duration, Duration),
}

impl Sampling {
    pub fn new(clock: Rc<dyn Clock>) -> Self {
        Self {
            clock,
            start: None,
            round_start: Duration::ZERO,
            durations: Vec::new(),
            next_evaluation: LEAST_RUNS,
        }
    }

    /// Statistics of the runs so far; `None` before the first run.
    pub fn figures(&self) -> Option<Figures> {
        let mut sorted = self.durations.clone();
        sorted.sort_unstable();
        let at = |quarters: usize| sorted.get((sorted.len().checked_sub(1)?) * quarters / 4);
        Some(Figures {
            runs: sorted.len(),
            least: *sorted.first()?,
            median: *at(2)?,
            quartiles: (*at(1)?, *at(3)?),
        })
    }

    fn is_enough(&mut self, now: Duration) -> bool {
        let spent = now.saturating_sub(self.start.unwrap_or(now));
        if spent >= TOTAL_TIME_LIMIT || self.durations.len() >= MOST_RUNS {
            return true;
        }
        if spent < LEAST_TIME || self.durations.len() < self.next_evaluation {
            return false;
        }
        self.next_evaluation += self.next_evaluation.div_ceil(4);
        self.figures().is_some_and(|figures| figures.error() <= KNOWN)
    }
}

impl Figures {
    fn error(&self) -> f64 {
        let (low, high) = self.quartiles;
        let deviation = (high - low).as_secs_f64() / 1.349;
        let median = self.median.as_secs_f64();
        if median > 0.0 { 1.2533 * deviation / (self.runs as f64).sqrt() / median } else { 0.0 }
    }
}

impl Rounds for Sampling {
    fn begin(&mut self) -> bool {
        let now = self.clock.now();
        self.start.get_or_insert(now);
        if self.is_enough(now) {
            return false;
        }
        self.round_start = self.clock.now();
        true
    }

    fn end(&mut self, _: Dynamic) {
        self.durations.push(self.clock.now().saturating_sub(self.round_start));
    }
}

#[cfg(test)]
mod tests {
    use std::cell::{Cell, RefCell};
    use std::collections::VecDeque;

    use super::*;

    struct ReplayClock {
        now: Cell<Duration>,
        runs: RefCell<VecDeque<u64>>,
    }

    impl Clock for ReplayClock {
        fn now(&self) -> Duration {
            self.now.get()
        }
    }

    fn figures(micros: &[u64]) -> Figures {
        let runs = RefCell::new(micros.iter().copied().collect());
        let clock = Rc::new(ReplayClock { now: Cell::default(), runs });
        let mut sampling = Sampling::new(clock.clone());
        while sampling.begin() {
            let mut runs = clock.runs.borrow_mut();
            runs.rotate_left(1);
            let took = Duration::from_micros(*runs.back().expect("a time"));
            clock.now.set(clock.now.get() + took);
            drop(runs);
            sampling.end(Dynamic::UNIT);
        }
        sampling.figures().expect("runs")
    }

    #[test]
    fn timing_of_equal_runs_stops_after_a_fifth_of_a_second() {
        let message = figures(&[10_000]);
        let ten = Duration::from_millis(10);
        assert_eq!(message, Figures { runs: 20, least: ten, median: ten, quartiles: (ten, ten) });
        assert_eq!(figures(&[1]).runs, MOST_RUNS);
    }

    #[test]
    fn timing_repeats_more_often_if_runs_vary() {
        let (calm, wild) = (figures(&[10_000, 10_100, 10_200]), figures(&[5_000, 10_000, 15_000]));
        assert!(calm.runs < 40 && wild.runs > 100, "{calm:?} {wild:?}");
        assert_eq!(
            (wild.least, wild.median),
            (Duration::from_millis(5), Duration::from_millis(10))
        );
        assert_eq!(wild.quartiles, (Duration::from_millis(5), Duration::from_millis(15)));
    }

    #[test]
    fn timing_stops_at_the_time_limit() {
        assert_eq!(figures(&[400_000, 900_000]).runs, 4);
    }
}

//! Clocks for measuring run times.

use std::time::{Duration, Instant};

/// Clock that measures the time since an arbitrary fixed moment.
pub trait Clock {
    /// Time since the moment at which the clock started.
    fn now(&self) -> Duration;
}

/// Monotonic clock of the machine.
pub struct Stopwatch(Instant);

impl Default for Stopwatch {
    fn default() -> Self {
        Self(Instant::now())
    }
}

impl Clock for Stopwatch {
    fn now(&self) -> Duration {
        self.0.elapsed()
    }
}

//! Clocks for timing.

use std::time::{Duration, Instant};

/// A clock that measures time since a fixed moment.
pub trait Clock {
    /// Time since the fixed moment of the clock.
    fn now(&self) -> Duration;
}

/// The monotonic clock of the machine.
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

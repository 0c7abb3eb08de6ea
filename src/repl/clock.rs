//! What times are taken with.

use std::time::{Duration, Instant};

/// A clock: something that tells the time since a moment that does not change.
pub trait Clock {
    /// The time that has passed since the clock's fixed moment.
    fn now(&self) -> Duration;
}

/// The clock of the machine.
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

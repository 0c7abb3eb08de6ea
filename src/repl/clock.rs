//! What times are taken with.

use std::time::{Duration, Instant};

/// Something that tells the time since a moment that does not change.
pub trait Clock {
    /// How long that moment is past.
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

//! The span of time of one step.

/// The interval of one step [time].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Where it begins.
    pub start: f64,
    /// Where it ends.
    pub end: f64,
    /// Known to more digits than the difference of two late times.
    duration: f64,
}

impl Interval {
    /// From one time to another.
    pub const fn between(start: f64, end: f64) -> Self {
        Self { start, end, duration: end - start }
    }

    /// From a time on; its end is rounded, its duration is not.
    pub fn lasting(start: f64, duration: f64) -> Self {
        Self { start, end: start + duration, duration }
    }

    /// Its length `Δt` [time].
    pub fn duration(&self) -> f64 {
        self.duration
    }
}

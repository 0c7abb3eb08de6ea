//! The span of time of one step.

/// The interval of one step [time].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Where it begins.
    pub start: f64,
    /// Where it ends.
    pub end: f64,
}

impl Interval {
    /// Its length `Δt` [time].
    pub fn duration(&self) -> f64 {
        self.end - self.start
    }
}

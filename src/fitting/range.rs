//! Start value and bounds of a parameter.

/// Start value and bounds, which may be infinite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SearchRange {
    pub start: f64,
    pub low: f64,
    pub high: f64,
}

impl SearchRange {
    /// Start value, or the nearest bound if it is outside the bounds.
    pub fn first(self) -> f64 {
        self.clip(self.start)
    }

    /// Nearest value within the bounds.
    pub fn clip(self, x: f64) -> f64 {
        x.max(self.low).min(self.high)
    }

    /// Scale of the values: the width of the range; if it is unbounded, the size of the start value.
    pub fn width(self) -> f64 {
        let range = self.high - self.low;
        if range.is_finite() && range > 0.0 { range } else { self.size(self.start) }
    }

    /// Magnitude of a significant change: the value itself, or a hundredth of the range near zero.
    pub fn size(self, x: f64) -> f64 {
        let range = self.high - self.low;
        let least = if range.is_finite() { 0.01 * range } else { 1e-3 * self.start.abs() };
        match x.abs().max(least) {
            size if size > 0.0 => size,
            _ => 1.0,
        }
    }
}

//! Where a parameter begins, and between which bounds it stays.

/// The start and the bounds of a parameter; these may be infinite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SearchRange {
    /// Where the search begins.
    pub start: f64,
    /// The smallest value.
    pub low: f64,
    /// The largest value.
    pub high: f64,
}

impl SearchRange {
    /// The value to begin with: the start, or the bound nearest to it.
    pub fn first(self) -> f64 {
        self.clip(self.start)
    }

    /// The nearest value within the bounds.
    pub fn clip(self, x: f64) -> f64 {
        x.max(self.low).min(self.high)
    }

    /// How far apart its values lie: the range where that is bounded, else the size of the start.
    pub fn width(self) -> f64 {
        let range = self.high - self.low;
        if range.is_finite() && range > 0.0 { range } else { self.size(self.start) }
    }

    /// How large a change of the parameter is that matters, about: the value itself, or a hundredth of its range where it is near zero.
    pub fn size(self, x: f64) -> f64 {
        let range = self.high - self.low;
        let least = if range.is_finite() { 0.01 * range } else { 1e-3 * self.start.abs() };
        match x.abs().max(least) {
            size if size > 0.0 => size,
            _ => 1.0,
        }
    }
}

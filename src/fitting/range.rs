//! Start value and bounds of a parameter in a search.

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SearchRange {
    pub start: f64,
    pub low: f64,
    pub high: f64,
}

impl SearchRange {
    pub fn first(self) -> f64 {
        self.clip(self.start)
    }

    pub fn clip(self, x: f64) -> f64 {
        x.max(self.low).min(self.high)
    }

    pub fn width(self) -> f64 {
        let range = self.high - self.low;
        if range.is_finite() && range > 0.0 { range } else { self.size(self.start) }
    }

    /// Size of a parameter: `|x|`, but at least 1/100 of the distance of its bounds or, if one is infinite, 1/1000 of the start value.
    /// The size is 1 if it would be zero.
    pub fn size(self, x: f64) -> f64 {
        let range = self.high - self.low;
        let least = if range.is_finite() { 0.01 * range } else { 1e-3 * self.start.abs() };
        match x.abs().max(least) {
            size if size > 0.0 => size,
            _ => 1.0,
        }
    }
}

//! Sums of increments with compensated rounding.

/// Largest rounding error of increments, as a multiple of the machine precision.
const MOST_ROUNDING: f64 = 16.0;

/// Bound of the rounding error of a sum of increments, each of them at most `largest_increment` in magnitude.
pub fn rounding_error(largest_increment: f64) -> f64 {
    MOST_ROUNDING * f64::EPSILON * largest_increment
}

/// Length, angle or rate, accumulated from increments and stored together with the rounding error of the sum.
///
/// The method is compensated summation (N. J. Higham, Accuracy and Stability of Numerical Algorithms (2002), section 4.3).
/// Without compensated summation, the elongation of a 1 m rope stretched by a micrometre, and its stored energy, would have only ten accurate digits.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Coordinate {
    pub value: f64,
    pub rest: f64,
}

impl From<f64> for Coordinate {
    fn from(value: f64) -> Self {
        Self { value, rest: 0.0 }
    }
}

impl Coordinate {
    pub fn after(self, change: f64) -> Self {
        let value = self.value + change;
        let part = value - self.value;
        let lost = (self.value - (value - part)) + (change - part);
        Self { value, rest: self.rest + lost }
    }

    /// Difference between the accumulated sum and a number. Its rounding error is proportional to the difference, not to the sum.
    pub fn difference(self, number: f64) -> f64 {
        (self.value - number) + self.rest
    }

    pub fn difference_from(self, other: Self) -> f64 {
        (self.value - other.value) + (self.rest - other.rest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinate_accumulates_changes_below_rounding() {
        let mut followed = Coordinate::from(1.0);
        for _ in 0..1000 {
            followed = followed.after(1e-17);
        }
        assert_eq!(followed.value, 1.0);
        assert!((followed.difference(1.0) - 1e-14).abs() < 1e-27);
        let other = Coordinate::from(1.0).after(-3e-20);
        assert!((followed.difference_from(other) - 1.000_003e-14).abs() < 1e-27);
    }
}

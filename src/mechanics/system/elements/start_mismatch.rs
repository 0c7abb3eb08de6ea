//! Difference between a static solution and the prescribed values from which a motion starts.

use crate::geometry::larger;

/// Largest difference of two values that count as equal [length, rad]. For values above 1, it is a fraction of the values [-].
const SAME: f64 = 1e-12;

/// Position of a drive, or rest length of a spring, that differs from its function of time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StartMismatch {
    /// Value in the static solution [length, rad].
    pub at_rest: f64,
    /// Value of the function of time [length, rad].
    pub prescribed: f64,
}

impl StartMismatch {
    /// Compares two values. Returns `None` if they are equal up to rounding.
    pub fn between(at_rest: f64, prescribed: f64) -> Option<Self> {
        let size = larger(1.0, larger(at_rest.abs(), prescribed.abs()));
        let differs = (at_rest - prescribed).abs() > SAME * size;
        differs.then_some(Self { at_rest, prescribed })
    }
}

//! Step size: fixed, or controlled by a tolerance.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::system::rounded;

/// Step size of a run: fixed or variable.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum StepSize {
    /// Fixed step size [time].
    Fixed(f64),
    /// Variable steps. Their size is controlled by a tolerance of the local error.
    Adaptive(StepControl),
}

/// Tolerance and bounds of variable steps.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct StepControl {
    /// Allowed error that accumulates while the scene moves by about its own length.
    /// The allowed error of a position is relative to the length of the scene [-]. The allowed error of an angle is in rad.
    ///
    /// In one step of a method of order `p`, the allowed error is the tolerance to the power `(p + 1)/p`.
    pub tolerance: f64,
    /// Size of the first step, and largest size of the first step after a jump of a load or a release [time]. The default is derived from the scene.
    pub first: Option<f64>,
    /// Smallest step size [time]. The default is a millionth of the first step.
    pub smallest: Option<f64>,
    /// Largest step size [time]. The default is a million times the first step.
    pub largest: Option<f64>,
}

#[expect(missing_docs, reason = "the messages describe the variants and their fields")]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StepSizeError {
    #[error("the step size dt is {dt}, but must be a positive finite number [time]")]
    Fixed {
        /// Rejected step size [time].
        dt: f64,
    },
    #[error(
        "the tolerance of adaptive steps is {tolerance}, but must be from {} to {}; 1e-4 is a good start",
        rounded(StepControl::LEAST_TOLERANCE),
        rounded(StepControl::MOST_TOLERANCE)
    )]
    Tolerance {
        /// Rejected tolerance [-].
        tolerance: f64,
    },
    #[error(
        "the {name} step of adaptive steps is {value}, but must be a positive finite number [time]"
    )]
    Bound {
        name: &'static str,
        /// Rejected value [time].
        value: f64,
    },
    #[error(
        "the {name} step of adaptive steps is {value}, but the {next} one is {limit}: they must increase from smallest to first to largest"
    )]
    Order {
        name: &'static str,
        /// Value of the bound `name` [time], which is larger than `limit`.
        value: f64,
        next: &'static str,
        /// Value of the bound `next` [time], which must not be smaller than `value`.
        limit: f64,
    },
}

impl From<f64> for StepSize {
    fn from(dt: f64) -> Self {
        Self::Fixed(dt)
    }
}

impl From<StepControl> for StepSize {
    fn from(control: StepControl) -> Self {
        Self::Adaptive(control)
    }
}

impl StepSize {
    /// Checks all values of the step size.
    ///
    /// # Errors
    /// Fails if a number of the step size is out of range.
    pub fn check(&self) -> Result<(), StepSizeError> {
        match *self {
            Self::Fixed(dt) if dt.is_finite() && dt > 0.0 => Ok(()),
            Self::Fixed(dt) => Err(StepSizeError::Fixed { dt }),
            Self::Adaptive(control) => control.check(),
        }
    }
}

impl fmt::Display for StepSize {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fixed(dt) => write!(f, "dt = {dt}"),
            Self::Adaptive(control) => write!(f, "dt {control}"),
        }
    }
}

impl fmt::Display for StepControl {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "adaptive, tolerance {:e}", self.tolerance)?;
        let bounds =
            [("first", self.first), ("smallest", self.smallest), ("largest", self.largest)];
        bounds.iter().try_for_each(|(name, value)| match value {
            Some(value) => write!(f, ", {name} {value}"),
            None => Ok(()),
        })
    }
}

impl StepControl {
    /// Smallest tolerance of variable steps [-]. Rounding errors of positions prevent smaller tolerances.
    pub const LEAST_TOLERANCE: f64 = 1e-9;

    /// Largest tolerance of variable steps [-]. The error estimate is not valid for larger errors.
    pub const MOST_TOLERANCE: f64 = 0.1;

    /// Returns variable steps with the given tolerance [-] and default bounds.
    pub fn to(tolerance: f64) -> Self {
        Self { tolerance, first: None, smallest: None, largest: None }
    }

    fn check(&self) -> Result<(), StepSizeError> {
        let tolerance = self.tolerance;
        if !(Self::LEAST_TOLERANCE..=Self::MOST_TOLERANCE).contains(&tolerance) {
            return Err(StepSizeError::Tolerance { tolerance });
        }
        let bounds =
            [("smallest", self.smallest), ("first", self.first), ("largest", self.largest)];
        let mut given = bounds.into_iter().filter_map(|(name, value)| Some((name, value?)));
        let mut before: Option<(&'static str, f64)> = None;
        given.try_for_each(|(next, limit)| {
            if !(limit.is_finite() && limit > 0.0) {
                return Err(StepSizeError::Bound { name: next, value: limit });
            }
            match before.replace((next, limit)) {
                Some((name, value)) if value > limit => {
                    Err(StepSizeError::Order { name, value, next, limit })
                }
                _ => Ok(()),
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn step_sizes_out_of_range_are_rejected_by_name() {
        let message = |size: StepSize| size.check().unwrap_err().to_string();
        assert!(StepSize::Fixed(0.1).check().is_ok());
        for dt in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(message(dt.into()).contains(&format!("dt is {dt}")));
        }
        for tolerance in [0.0, 1e-12, 1.0, f64::NAN] {
            assert!(message(StepControl::to(tolerance).into()).contains("from 1e-9 to 0.1"));
        }
        let control = StepControl::to(1e-4);
        assert!(StepSize::from(control).check().is_ok());
        let first = StepControl { first: Some(-1.0), ..control };
        assert!(message(first.into()).contains("the first step of adaptive steps is -1"));
        let wide = StepControl { smallest: Some(2.0), largest: Some(1.0), ..control };
        assert!(
            message(wide.into()).contains("smallest step of adaptive steps is 2, but the largest")
        );
        let right = StepControl { smallest: Some(1e-3), first: Some(1e-3), ..control };
        assert!(StepSize::from(right).check().is_ok());
    }
}

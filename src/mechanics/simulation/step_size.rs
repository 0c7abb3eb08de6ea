//! How long steps are: always the same, or as a tolerance allows.

use std::fmt;

use serde::{Deserialize, Serialize};

/// How long the steps of a run are.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum StepSize {
    /// All steps of the run are equally long [time].
    Fixed(f64),
    /// Steps are as long as a tolerance of the local error allows.
    Adaptive(StepControl),
}

/// The tolerance that steps of varying size keep to, and their bounds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct StepControl {
    /// The error that may gather while the scene moves about as far as it is long, as a part of that length, and in rad [-].
    ///
    /// A step with a method of order `p` may err by its power `(p + 1)/p`: then the step size goes with its power `1/p`, and what
    /// gathers over many steps goes with itself.
    pub tolerance: f64,
    /// The size of the first step, and of the first one after a jump of a load [time]; found from the scene where it is not given.
    pub first: Option<f64>,
    /// The size below which no step is that a tolerance asks for [time]; a millionth of the first where it is not given.
    pub smallest: Option<f64>,
    /// The size above which no step is [time]; a million times the first where it is not given.
    pub largest: Option<f64>,
}

/// A number of a [`StepSize`] that is out of its range.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StepSizeError {
    /// A fixed step size that is not positive.
    #[error("the step size dt is {dt}, but must be a positive finite number [time]")]
    Fixed {
        /// The value of the fixed step size [time].
        dt: f64,
    },
    /// A tolerance that no steps can keep, or that says nothing.
    #[error(
        "the tolerance of adaptive steps is {tolerance}, but must be from {} to {}; 1e-4 is a good start",
        StepControl::LEAST_TOLERANCE,
        StepControl::MOST_TOLERANCE
    )]
    Tolerance {
        /// The value of the refused tolerance [-].
        tolerance: f64,
    },
    /// A bound of step sizes that is not positive.
    #[error(
        "the {name} step of adaptive steps is {value}, but must be a positive finite number [time]"
    )]
    Bound {
        /// The name of the refused bound: smallest, first or largest.
        name: &'static str,
        /// The value of the refused bound [time].
        value: f64,
    },
    /// Bounds of step sizes in the wrong order.
    #[error(
        "the {name} step of adaptive steps is {value}, but the {next} one is {limit}: they must increase from smallest to first to largest"
    )]
    Order {
        /// The name of the bound that should be smaller.
        name: &'static str,
        /// The value of the bound that should be smaller [time].
        value: f64,
        /// The name of the bound that should be larger.
        next: &'static str,
        /// The value of the bound that should be larger [time].
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
    /// Checks the numbers of the step size.
    ///
    /// # Errors
    /// When one is out of its range.
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
    /// The smallest tolerance of steps of varying size [-]: below it the rounding of places counts.
    pub const LEAST_TOLERANCE: f64 = 1e-9;

    /// The largest tolerance of steps of varying size [-]: beyond it an error is no longer small.
    pub const MOST_TOLERANCE: f64 = 0.1;

    /// The control of steps that keep a tolerance [-], with bounds from the scene.
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
    fn numbers_out_of_range_are_refused_and_named() {
        let told = |size: StepSize| size.check().unwrap_err().to_string();
        assert!(StepSize::Fixed(0.1).check().is_ok());
        for dt in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(told(dt.into()).contains(&format!("dt is {dt}")));
        }
        for tolerance in [0.0, 1e-12, 1.0, f64::NAN] {
            assert!(told(StepControl::to(tolerance).into()).contains("from 0.000000001 to 0.1"));
        }
        let control = StepControl::to(1e-4);
        assert!(StepSize::from(control).check().is_ok());
        let first = StepControl { first: Some(-1.0), ..control };
        assert!(told(first.into()).contains("the first step of adaptive steps is -1"));
        let wide = StepControl { smallest: Some(2.0), largest: Some(1.0), ..control };
        assert!(
            told(wide.into()).contains("smallest step of adaptive steps is 2, but the largest")
        );
        let right = StepControl { smallest: Some(1e-3), first: Some(1e-3), ..control };
        assert!(StepSize::from(right).check().is_ok());
    }
}

//! What every method offers.

use super::{Interval, Mechanism, StepError};
use crate::newton::NewtonReport;

/// A time integrator: one way to take a step of a mechanism.
pub trait Integrator {
    /// Advances the mechanism over the interval; on an error it is left as it was.
    ///
    /// # Errors
    /// When no solution is found, the rotation increment is too large, a constraint ends within the interval, or a load
    /// cannot be evaluated.
    fn step(
        &mut self,
        mechanism: &mut dyn Mechanism,
        interval: Interval,
    ) -> Result<NewtonReport, StepError>;
}

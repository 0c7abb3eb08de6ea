//! Interface of integrators.

use super::{Interval, Mechanism, StepError};
use crate::newton::NewtonReport;

/// Time integrator, which takes steps of a mechanism.
pub trait Integrator {
    /// Advances the mechanism over the interval. If the step fails, the mechanism is unchanged.
    ///
    /// # Errors
    /// Fails if the equations have no solution, a rotation increment is too large, or a load or a prescribed motion has no valid value.
    /// Also fails if the mechanism rejects the step, for example because a slider would pass a limit within the interval.
    fn step(
        &mut self,
        mechanism: &mut dyn Mechanism,
        interval: Interval,
    ) -> Result<NewtonReport, StepError>;
}

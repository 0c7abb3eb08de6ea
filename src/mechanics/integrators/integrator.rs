//! Interface of integrators.

use super::{Interval, Mechanism, StepError};
use crate::newton::NewtonReport;

/// Time integrator, which takes steps of a mechanism.
pub trait Integrator {
    /// Advances the mechanism over the interval. After an error the mechanism is unchanged.
    ///
    /// # Errors
    /// Fails if the equations have no solution, a rotation increment is too large, a constraint limit lies within the interval,
    /// or a load cannot be evaluated.
    fn step(
        &mut self,
        mechanism: &mut dyn Mechanism,
        interval: Interval,
    ) -> Result<NewtonReport, StepError>;
}

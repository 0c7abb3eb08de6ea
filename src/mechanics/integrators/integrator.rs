//! Interface of integrators.

use super::{Interval, Mechanism, StepError};
use crate::newton::NewtonReport;

/// Time integrator: takes steps of a mechanism.
pub trait Integrator {
    /// Advances the mechanism over the interval. On an error it is unchanged.
    ///
    /// # Errors
    /// Fails without a solution, with too large a rotation increment, at a constraint limit within the interval, or with a load that cannot be
    /// evaluated.
    fn step(
        &mut self,
        mechanism: &mut dyn Mechanism,
        interval: Interval,
    ) -> Result<NewtonReport, StepError>;
}

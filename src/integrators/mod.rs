//! Time steps over an abstract mechanism: predict, solve, correct. No integrator mentions a beam.

mod balance;
mod energy_decaying;
mod energy_momentum;
mod error;
mod fourth_order;
mod generalized_alpha;
mod interval;
mod mechanism;
mod registry;
mod trapezoidal;

pub use energy_decaying::EnergyDecaying;
pub use energy_momentum::EnergyMomentum;
pub use error::{Cause, StepError};
pub use fourth_order::FourthOrder;
pub use generalized_alpha::GeneralizedAlpha;
pub use interval::{Ending, Interval};
pub use mechanism::{
    Accelerated, Checkpoint, Constraints, Forces, Inertia, Mechanism, Overshoot, Solution, Stage,
};
pub use registry::{
    Claims, EnergyClaim, INTEGRATORS, IntegratorEntry, Method, MethodError, MethodParameter,
};
pub use trapezoidal::Trapezoidal;

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

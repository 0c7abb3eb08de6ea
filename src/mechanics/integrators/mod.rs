//! Time integrators for an abstract mechanism, independent of beams.

mod balance;
mod end_check;
mod energy_decaying;
mod energy_momentum;
mod error;
mod fourth_order;
mod generalized_alpha;
mod integrator;
mod interval;
mod mechanism;
mod phase_error;
mod prescribed;
mod registry;
mod shared_factor_stepper;
mod trapezoidal;

pub use energy_decaying::EnergyDecaying;
pub use energy_momentum::EnergyMomentum;
pub use error::{ExternalError, FailureSource, StepError};
pub use fourth_order::FourthOrder;
pub use generalized_alpha::GeneralizedAlpha;
pub use integrator::Integrator;
pub use interval::{Interval, IntervalEnd};
pub use mechanism::{
    Accelerated, Checkpoint, Constraints, Forces, Inertia, Mechanism, Overshoot, Solution, Stage,
};
pub use prescribed::PrescribedKinematics;
pub use registry::{
    Claims, EnergyClaim, INTEGRATORS, IntegratorEntry, Method, MethodError, MethodParameter,
};
pub use shared_factor_stepper::{SharedFactorStepper, SharedFactorWork};
pub use trapezoidal::Trapezoidal;

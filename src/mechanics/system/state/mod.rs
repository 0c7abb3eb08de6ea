//! Motion of a model: rates, prediction of the next step, and force scales of the present step.

mod accelerations;
mod forecast;
mod inertia_solver;
mod present;
mod present_forces;
mod resolution;
mod step;
mod unknowns;
mod watched;

pub use forecast::Prediction;
pub use inertia_solver::InertiaSolver;
pub use present::MotionState;
pub use present_forces::{ContactResponse, PresentForces};
pub use resolution::Resolution;
pub use step::StepMeasures;
pub use unknowns::{UnknownKind, Unknowns};
pub use watched::MonitoredBody;

//! How a model moves: its rates, what its last steps tell of the next, and what is met in the present one.

mod accelerations;
mod forecast;
mod present;
mod resolution;
mod step;
mod unknowns;
mod watched;

pub use forecast::Trend;
pub use present::MotionState;
pub use resolution::Resolution;
pub use step::StepMeasures;
pub use unknowns::{UnknownKind, Unknowns};
pub use watched::MonitoredBody;

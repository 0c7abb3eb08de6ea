//! How a model moves, and what its last steps tell of the next.

mod accelerations;
mod forecast;
mod resolution;
mod scales;

pub(super) use accelerations::Accelerations;
pub(super) use forecast::Forecast;
pub(super) use resolution::Missed;
pub use resolution::Resolution;
pub(super) use scales::{StepScales, largest, relative};

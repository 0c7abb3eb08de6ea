//! Newton's method for equations that provide a residual and a tangent.

mod equations;
mod error;
mod solver;

pub use equations::{Equations, ResidualNorms, ResidualPart};
pub use error::NewtonError;
pub use solver::{Newton, NewtonReport, Tolerance};

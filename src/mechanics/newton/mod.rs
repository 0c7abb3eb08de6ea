//! The nonlinear solve. It knows no time and no beam: equations offer a residual and a tangent.

mod equations;
mod error;
mod solver;

pub use equations::{Equations, ResidualNorms, ResidualPart};
pub use error::NewtonError;
pub use solver::{Newton, NewtonReport, Tolerance};

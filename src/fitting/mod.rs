//! Parameter estimation from runs: least squares, constrained minimisation, root finding. The functions are treated as black boxes that return
//! numbers.
//!
//! ```text
//! least_squares → evaluator → differences
//!               → estimate → student
//! descent → design
//! root
//! ```

#![cfg_attr(test, allow(clippy::unwrap_used))]

mod descent;
mod design;
mod differences;
mod estimate;
mod evaluator;
mod gradient_check;
mod least_squares;
mod range;
mod root;
mod student;

pub use descent::{SlopedRating, SlopesOfRating};
pub use design::{Design, Designed, Rating};
pub use differences::RELATIVE_STEP;
pub use estimate::Estimate;
pub use least_squares::{Fitted, LeastSquares, TerminationReason};
pub use range::SearchRange;
pub use root::{RootError, root};
pub use student::student_quantile;

/// Values of a function at a point, or the reason of failure.
pub type Evaluation = Result<Vec<f64>, String>;

/// Values with derivatives with respect to all parameters, or the reason for missing derivatives.
pub type Sloped = Result<Vec<(f64, Vec<f64>)>, String>;

/// A function with optional derivatives. An error ends the whole search.
pub type Slopes<'s, E> = dyn FnMut(&[f64]) -> Result<Sloped, E> + 's;

/// A function that is evaluated at several points together, for parallel execution. An error ends the whole search.
pub type Evaluate<'e, E> = dyn FnMut(&[Vec<f64>]) -> Result<Vec<Evaluation>, E> + 'e;

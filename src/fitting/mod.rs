//! Parameter estimation from runs by least squares, constrained minimisation and root finding.

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

/// Values of a function at a point, or the reason why they could not be computed.
pub type Evaluation = Result<Vec<f64>, String>;

pub type Sloped = Result<Vec<(f64, Vec<f64>)>, String>;

pub type Slopes<'s, E> = dyn FnMut(&[f64]) -> Result<Sloped, E> + 's;

pub type Evaluate<'e, E> = dyn FnMut(&[Vec<f64>]) -> Result<Vec<Evaluation>, E> + 'e;

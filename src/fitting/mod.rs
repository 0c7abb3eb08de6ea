//! Parameters found by runs: least squares, the least of a function within constraints, a root. It sees numbers, and a function that gives some.
//!
//! ```text
//! least_squares → asking → differences
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

pub use descent::{Rate, RateWithSlopes, SlopedRating, SlopesOfRating};
pub use design::{Design, Designed, Rating};
pub use differences::RELATIVE_STEP;
pub use estimate::Estimate;
pub use least_squares::{Fitted, LeastSquares, TerminationReason};
pub use range::SearchRange;
pub use root::{Root, RootError, root};
pub use student::student_quantile;

/// What a function gave at a point: numbers, or why there are none.
pub type Evaluation = Result<Vec<f64>, String>;

/// The values of a function at a point, each with its derivatives by all parameters, or why it does not know them.
pub type Sloped = Result<Vec<(f64, Vec<f64>)>, String>;

/// A function that may know its derivatives, asked at a point; an error ends the whole search.
pub type Slopes<'s, E> = dyn FnMut(&[f64]) -> Result<Sloped, E> + 's;

/// A function that is asked at several points at once, so that they can be worked on beside each other; an error ends the whole search.
pub type Evaluate<'e, E> = dyn FnMut(&[Vec<f64>]) -> Result<Vec<Evaluation>, E> + 'e;

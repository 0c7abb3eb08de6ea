//! What every other wing says: errors and their places, numbers, nouns, what may have been meant, what was checked, what stops a run.

pub mod advice;
pub mod brief;
pub mod checks;
pub mod error;
pub mod nouns;
pub mod numbers;
pub mod progress;
pub mod raised;
pub mod reports;
pub mod stop;
pub mod suggest;

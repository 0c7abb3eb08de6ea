//! Common vocabulary of the language modules: errors, numbers, nouns, suggestions, checks, stop reasons.

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

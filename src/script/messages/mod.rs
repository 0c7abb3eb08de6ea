//! Building blocks of messages for all language modules: errors, numbers, nouns, suggestions, checks, and reasons for a stop.

pub mod advice;
pub(crate) mod brief;
pub(crate) mod checks;
pub mod error;
pub(crate) mod nouns;
pub mod numbers;
pub(crate) mod progress;
pub(crate) mod raised;
pub mod reports;
pub mod stop;
pub(crate) mod suggest;

//! Editing of inputs: detection of complete inputs, completion, hints and colours.
//!
//! The modules of the editor have no side effects. They use the tokens of [`scanner`](crate::script::source::scanner).

pub(crate) mod candidates;
mod commands;
pub mod completeness;
pub mod completion;
pub mod definition;
mod expected;
pub mod highlight;
pub mod hints;
mod input;
mod members;
mod paths;
#[cfg(test)]
pub(super) mod samples;
pub mod surroundings;
mod types;

pub(crate) use types::type_before;

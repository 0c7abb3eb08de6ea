//! Editing of inputs, without side effects: detection of complete inputs, completion, hints and colours.

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

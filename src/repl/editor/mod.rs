//! Line editing at the prompt: detection of complete inputs, completion, hints, colours and history.
//!
//! Code that depends on the language has no side effects. It uses the tokens of [`scanner`](crate::script::source::scanner).
//! [`line_editor`] configures rustyline for the terminal.

mod assistant;
pub(crate) mod candidates;
mod commands;
pub mod completeness;
pub mod completion;
mod expected;
pub mod highlight;
pub mod hints;
pub(crate) mod history;
mod input;
mod keys;
pub(crate) mod line_editor;
mod members;
mod paths;
#[cfg(test)]
mod samples;
pub mod surroundings;
pub(crate) mod typed_ahead;
mod types;

pub(crate) use line_editor::{Editor, EditorInput, EditorOptions, Keys};
pub(crate) use types::type_before;

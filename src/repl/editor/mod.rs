//! Typing at the prompt: whether an input is complete, completion, hints, colours and history.
//!
//! All that knows the language is pure and works on the tokens of [`scanner`](crate::script::source::scanner); the terminal is left to rustyline, which
//! [`line_editor`] sets up.

mod assistant;
pub mod candidates;
mod commands;
pub mod completeness;
pub mod completion;
mod expected;
pub mod highlight;
pub mod hints;
pub mod history;
mod input;
mod keys;
pub mod line_editor;
mod members;
mod paths;
#[cfg(test)]
mod samples;
pub mod surroundings;
pub mod typed_ahead;
mod types;

pub use line_editor::{Editor, EditorInput, EditorOptions, Keys};
pub use types::type_before;

//! Line editing at the prompt: detection of complete inputs, completion, hints, colours and history.
//!
//! Code that depends on the language has no side effects and uses the tokens of [`scanner`](crate::script::source::scanner). [`line_editor`]
//! configures rustyline for the terminal.

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

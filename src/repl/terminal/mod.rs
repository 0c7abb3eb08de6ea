//! Prompt at a terminal: line editing with rustyline, history of inputs, and pages for long replies.

mod assistant;
mod history;
mod keys;
pub(crate) mod line_editor;
pub(crate) mod pager;
pub(crate) mod prompt;
pub(crate) mod typed_ahead;

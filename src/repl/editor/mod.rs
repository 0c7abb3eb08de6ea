//! Typing at the prompt: whether an input is complete, completion, hints, colours and history.
//!
//! All that knows the language is pure and works on the tokens of [`scanner`]; the terminal is left to rustyline.

pub mod completeness;
pub mod scanner;
pub mod surroundings;

//! Recognition of syntax from other languages, and of mistakes that the parser reports far from their cause. Each pattern suggests a replacement.
//!
//! A pattern examines the tokens around the position of the syntax error. The first match is used.
//! Patterns are tried only for sources with a syntax error.

mod blocks;
mod brackets;
mod declarations;
mod expressions;
mod fix;
mod signs;
mod token_window;

pub use fix::explain;

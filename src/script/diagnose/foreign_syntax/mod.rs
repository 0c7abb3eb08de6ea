//! Recognition of syntax from other languages, and of mistakes that the parser reports far from their cause.
//! Patterns are tried one after the other on the tokens around a syntax error, and the first match is used.

mod blocks;
mod brackets;
mod declarations;
mod expressions;
mod fix;
mod signs;
mod token_window;

pub use fix::explain;

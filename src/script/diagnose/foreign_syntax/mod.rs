//! Recognition of the syntax of other languages, and of mistakes that the parser reports far from their cause, with replacements.
//!
//! A pattern inspects the tokens around the parse error. The first match is used. Patterns are tried only for invalid sources.

mod blocks;
mod brackets;
mod declarations;
mod expressions;
mod fix;
mod signs;
mod token_window;

pub use fix::explain;

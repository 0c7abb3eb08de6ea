//! From the text of a script to its tokens: the text, the lexer, what a text declares, tokens, rounds and choices that Rhai has not.

pub mod choices;
pub mod definitions;
pub mod keywords;
pub mod lexing;
pub mod outline;
pub mod program;
pub mod rounds;
pub mod scanner;
pub mod syntax;
pub mod text;

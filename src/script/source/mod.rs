//! From the text of a script to its tokens: the text, the lexer, what a text declares, tokens, rounds and choices that Rhai has not.

pub mod definitions;
pub mod keywords;
pub mod lexing;
pub mod loop_scoping;
pub mod outline;
pub mod program;
pub mod scanner;
pub mod switch_rewrite;
pub mod syntax;
pub mod text;

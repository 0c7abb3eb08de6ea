//! Text of a script and its tokens: source text, lexer, declarations, and syntax extensions of Rhai.

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

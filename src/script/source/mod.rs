//! Text of a script and its tokens, without execution.

pub(crate) mod definitions;
pub(crate) mod keywords;
pub(crate) mod lexing;
pub(crate) mod loop_scoping;
pub(crate) mod outline;
pub(crate) mod pitfalls;
pub mod program;
pub(crate) mod scanner;
pub(crate) mod switch_rewrite;
pub(crate) mod syntax;
pub(crate) mod text;

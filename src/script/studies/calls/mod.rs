//! Calls of script functions by studies on worker threads.

pub mod calling;
pub mod evaluator;
pub mod function;
pub mod portable;

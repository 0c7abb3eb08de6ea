//! Functions of the script, called by studies on the engines of all cores.

pub mod calling;
pub mod evaluator;
pub mod function;
pub mod portable;

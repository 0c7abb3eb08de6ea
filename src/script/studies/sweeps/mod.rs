//! Sweeps: calls of a script function for each row of a design.

pub mod design;
pub mod keeping;
pub mod pictures;
pub mod rows;
pub mod run;
pub mod sweep_progress;
pub mod table;

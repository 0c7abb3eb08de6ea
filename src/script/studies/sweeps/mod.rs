//! Sweeps: a function of the script, called with the values of each row.

pub mod design;
pub mod keeping;
pub mod pictures;
pub mod rows;
pub mod run;
pub mod sweep_progress;
pub mod table;

//! Sweeps: a function of the script, called with the values of each row, on the engines of all cores.

pub mod design;
pub mod function;
pub mod pictures;
pub mod portable;
pub mod rows;
pub mod run;
pub mod table;

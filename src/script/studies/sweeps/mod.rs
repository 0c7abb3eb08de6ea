//! Sweeps: a function of the script, called with the values of each row.

pub mod design;
pub mod keeping;
pub mod ledger;
pub mod pictures;
pub mod rows;
pub mod run;
pub mod table;

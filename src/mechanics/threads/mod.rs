//! Work that several threads do at once, with the very bits that one thread gives: who calls it cuts the work such that no sum depends on who made it.

mod at_once;
mod pool;

pub use at_once::{at_once, both};

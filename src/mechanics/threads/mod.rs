//! Multithreading with results identical to those of one thread.
//! Callers must divide their work so that no sum depends on the number of threads.

mod at_once;
mod pool;

pub use at_once::{both, run_concurrently};

//! Multithreading with results identical to those of one thread: the callers partition work such that no sum depends on the thread.

mod at_once;
mod pool;

pub use at_once::{both, run_concurrently};

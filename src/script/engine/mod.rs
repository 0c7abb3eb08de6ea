//! Engine of a run: construction, parsing, execution, imports, and worker threads.

mod build;
mod imports;
pub mod inputs;
pub mod parse;
pub mod runner;
pub mod script_engine;
pub mod stack;
pub(crate) mod workers;

pub use build::build;

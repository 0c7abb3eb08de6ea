//! The engine of a run: built, asked to read and to run, and what it imports.

mod build;
mod imports;
pub mod parse;
pub mod runner;
pub mod script_engine;
pub mod stack;
pub mod workers;

pub use build::build;

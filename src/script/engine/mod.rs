//! The engine of a run: built, asked to read and to run, and what it imports.

mod build;
pub mod host;
mod imports;
pub mod parse;
pub mod runner;
pub mod stack;
pub mod workers;

pub use build::build;

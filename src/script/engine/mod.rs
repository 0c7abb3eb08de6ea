//! The engine of a run: built, asked to read and to run, and what it imports.

mod build;
mod imports;
pub mod runner;

pub use build::{build, import_from};

//! Memory use of runs.

#[path = "../common/mod.rs"]
mod common;

mod allocation;
mod long_flight;

//! What runs take of memory.

#[path = "../common/mod.rs"]
mod common;

mod allocation;
mod long_flight;

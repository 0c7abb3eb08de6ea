//! withy: planar dynamics of flexible beams, and its scripting language.
//!
//! Layers; each uses only those to its right:
//!
//! ```text
//! main → cli → repl, exercises → script → output, analysis → sampling, fitting, mechanics: simulation → … → system → …
//! ```
//!
//! The mechanics is a crate of its own, so that changes of the language do not rebuild it. Its main layers are listed here too. The bottom
//! layers are `sandbox_fs`, which opens all files, and `panics`, which catches and reports internal errors.

#![forbid(unsafe_code)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub use withy_mechanics::{
    beams, elementary, geometry, integrators, joints, linalg, loads, newton, simulation, statics,
    system, vibration,
};

pub mod analysis;
pub mod cli;
pub mod exercises;
mod fitting;
pub mod output;
mod panics;
pub mod repl;
mod sampling;
mod sandbox_fs;
pub mod script;

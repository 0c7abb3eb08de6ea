//! withy: planar dynamics of flexible beams, and the language to script it.
//!
//! Layers, each using only those to its right:
//!
//! ```text
//! main → cli → repl, exercises → script → output, analysis → sampling, fitting, mechanics: simulation → … → model → …
//! ```
//!
//! The mechanics is a crate of its own, so that a change of the language does not build it anew; its layers are named here as they are there. At the bottom
//! stand [`folders`], which opens files for all that touch any, and [`panics`], which catches our mistakes and tells of them.

#![forbid(unsafe_code)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub use withy_mechanics::{
    beams, elementary, geometry, integrators, joints, linalg, loads, newton, simulation, statics,
    system, vibration,
};

pub mod analysis;
pub mod cli;
pub mod exercises;
pub mod fitting;
pub mod output;
pub mod panics;
pub mod repl;
pub mod sampling;
pub mod sandbox_fs;
pub mod script;

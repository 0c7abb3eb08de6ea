//! withy: planar dynamics of flexible beams, and its scripting language.
//!
//! The layers of the program are described in docs/architecture.md.
//! The mechanics is a separate crate, so that it is not compiled again after changes of the language.

#![forbid(unsafe_code)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// Without the command line, some functions of the lower layers are unused.
#![cfg_attr(not(feature = "terminal"), allow(dead_code, unused_imports))]

pub use withy_mechanics::{
    beams, elementary, geometry, integrators, joints, linalg, loads, newton, simulation, statics,
    system, vibration,
};

pub mod analysis;
#[cfg(feature = "terminal")]
pub mod cli;
pub mod exercises;
mod fitting;
pub mod output;
mod panics;
#[cfg(feature = "playground")]
pub mod playground;
pub mod repl;
mod sampling;
mod sandbox_fs;
pub mod script;

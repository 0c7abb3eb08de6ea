//! withy: planar dynamics of flexible beams, and the language to script it.
//!
//! Layers, each using only those to its right:
//!
//! ```text
//! main → cli → repl, exercises → script → output, analysis → simulation → statics → vibration → model ┬→ joints, loads → beams → geometry
//!                                                                                                     └→ integrators → newton → linalg
//! ```
//!
//! At the bottom of all stand [`elementary`]: sine, logarithm and power with the same bits on every machine, and [`folders`], which opens files for all that
//! touch any, and [`panics`], which catches our mistakes and tells of them.

#![forbid(unsafe_code)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod analysis;
pub mod beams;
pub mod cli;
pub mod elementary;
pub mod exercises;
pub mod folders;
pub mod geometry;
pub mod integrators;
pub mod joints;
pub mod linalg;
pub mod loads;
pub mod model;
pub mod newton;
pub mod output;
pub mod panics;
pub mod repl;
pub mod script;
pub mod simulation;
pub mod statics;
pub mod vibration;

//! Planar dynamics of flexible beams with sliding joints: the solver below the scripting language of withy.
//!
//! Layers; each layer uses only the layers to its right:
//!
//! ```text
//! simulation → statics → vibration → system ┬→ joints, loads → beams → geometry
//!                                           └→ integrators → newton → linalg
//! ```
//!
//! The lowest level consists of [`elementary`] and `threads`. [`elementary`] contains functions with identical results on every machine.
//! The module `threads` processes beams, bands and bodies concurrently.

#![forbid(unsafe_code)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod beams;
pub mod elementary;
pub mod geometry;
pub mod integrators;
pub mod joints;
pub mod linalg;
pub mod loads;
pub mod newton;
pub mod simulation;
pub mod statics;
pub mod system;
pub(crate) mod threads;
pub mod vibration;

//! Planar dynamics of flexible beams that slide on each other: all of withy that the language stands on.
//!
//! Layers, each using only those to its right:
//!
//! ```text
//! simulation → statics → vibration → model ┬→ joints, loads → beams → geometry
//!                                          └→ integrators → newton → linalg
//! ```
//!
//! At the bottom of all stand [`elementary`]: sine, logarithm and power with the same bits on every machine; and [`threads`], for beams, bands and bodies
//! that are worked on in parts.

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
pub mod threads;
pub mod vibration;

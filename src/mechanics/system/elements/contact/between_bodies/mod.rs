//! Contact between beams, particles and points of rigid bodies.
//!
//! Each contact point of a body touches the nearest point of the axis of another body.
//! Submodules: `definition` (scene object), `shape` (geometry of a body), `gap` (change of a gap), `slip` (slip along an axis), `smallest_gap` (smallest gap between the bodies), `pair` (one contact), and `forces` (all contacts).

mod definition;
mod forces;
mod gap;
mod pair;
mod shape;
mod slip;
mod smallest_gap;

pub use definition::{ContactMember, PairContact};

//! Contact between beams, particles and points of rigid bodies.
//!
//! Each contact point of a body touches the nearest point of the axis of another body.

mod definition;
mod forces;
mod gap;
mod pair;
mod shape;
mod slip;
mod smallest_gap;

pub use definition::{ContactMember, PairContact};

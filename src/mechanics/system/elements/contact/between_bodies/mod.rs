//! Contact between beams, particles and points of rigid bodies.
//!
//! Each contact point of a body touches the nearest point of the axis of another body.
//! The definition is in `definition`, the geometry of a body in `shape`, the change of a gap in `gap`, one contact in `pair`, and the sum of all contacts in `forces`.

mod definition;
mod forces;
mod gap;
mod pair;
mod shape;

pub use definition::{ContactMember, PairContact};

//! Points that slide along beams.

mod blow;
mod connection;
mod limits;
mod sliding;

pub(super) use connection::Connection;
pub use limits::TrackLimit;
pub(super) use limits::contact_unknowns;
pub(super) use sliding::{LANDED, Sliding};
pub use sliding::{SliderState, TrackEnd};

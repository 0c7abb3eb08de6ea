//! Beams and particles among the unknowns of the model.

mod body;
mod tracker;

pub(super) use body::Body;
pub(super) use tracker::Tracker;

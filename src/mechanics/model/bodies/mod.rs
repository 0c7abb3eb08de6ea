//! Beams, particles and rigid bodies, and where their movements stand among the unknowns of the model.

mod all;
mod body;
mod halves;
mod momenta;
mod places;
mod tracker;
mod work;

pub use all::Bodies;
pub use body::Body;
pub use momenta::Momenta;
pub use tracker::Tracker;

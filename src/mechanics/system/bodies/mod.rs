//! Beams, particles and rigid bodies, with their degrees of freedom. Strains and section forces are computed in `beams`.

mod all;
mod body;
mod degrees_of_freedom;
mod halves;
mod momenta;
mod places;
mod tracker;
mod work;

pub use all::Bodies;
pub use body::Body;
pub use degrees_of_freedom::DegreesOfFreedom;
pub use momenta::Momenta;
pub use tracker::Tracker;

//! From a scene, as the user describes it, to a mechanism that integrators can advance.

mod accelerations;
mod applied;
mod assemble;
mod at_rest;
mod body;
mod connection;
mod error;
mod explain;
mod forces;
mod forecast;
mod impact;
mod inertia;
mod likeness;
mod measures;
mod mechanism;
pub mod names;
mod numbering;
mod placement;
mod queries;
mod redundancy;
mod resolution;
mod scales;
mod scene;
mod slider_error;
mod sliders;
mod sliding;
mod stiffness;
mod stored;
mod tracker;
mod waves;

pub use at_rest::StaticForces;
pub use error::ModelError;
pub use explain::{Part, Usage};
pub use impact::Blow;
pub use measures::{Energy, Measures};
pub use mechanism::Model;
pub use placement::{Distance, Placement};
pub use queries::ModelState;
pub use resolution::Resolution;
pub use scene::{
    BeamDefinition, ParticleDefinition, PointMass, Scene, StartMotion, StationVelocity,
};
pub use slider_error::{SliderError, SliderParts};
pub use sliders::TrackLimit;
pub use sliding::{SliderState, TrackEnd};
pub use stiffness::add_resistance;

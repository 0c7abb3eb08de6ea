//! From a scene, as the user describes it, to a mechanism that integrators can advance.

mod assembly;
mod bodies;
mod elements;
mod looking;
mod mechanism;
mod motion;
mod scene;
mod sliders;
mod words;

pub use looking::{Distance, Energy, Measures, ModelState, Part, Placement, Usage};
pub use mechanism::{Blow, Model, StaticForces, add_resistance};
pub use motion::Resolution;
pub use scene::{
    BeamDefinition, ParticleDefinition, PointMass, Scene, StartMotion, StationVelocity,
};
pub use sliders::{SliderState, TrackEnd, TrackLimit};
pub use words::{ModelError, SliderError, SliderParts};

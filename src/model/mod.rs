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

pub use elements::{Element, PointMass};
pub use looking::{
    BeamPlaces, BeamSample, CrossSection, Distance, Part, Placement, SectionSample, Usage,
};
pub use mechanism::{Energy, Measures, Model, ModelState, StaticForces, add_resistance};
pub use motion::Resolution;
pub use scene::{BeamDefinition, ParticleDefinition, Scene, StartMotion, StationVelocity};
pub use sliders::{Blow, SliderState, TrackEnd, TrackLimit};
pub use words::{
    Approach, ModelError, SliderError, SliderParts, Turning, refusal as refusal_of_name,
};

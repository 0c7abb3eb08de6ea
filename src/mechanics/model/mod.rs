//! From a scene, as the user describes it, to a mechanism that integrators can advance.

mod assembly;
mod bodies;
mod elements;
mod links;
mod looking;
mod mechanism;
mod motion;
mod scene;
mod sliders;
mod words;

pub use elements::{
    Along, Anchor, Bend, Branch, DampingLaw, Drag, Dragged, Drive, DriveKind, DriveState, Element,
    LoadAccount, MaterialDamping, Origin, PointMass, RestoringLaw, ShortBounce, SpeedLaw, Spring,
    SpringKind,
};
pub use looking::{
    BeamPlaces, BeamSample, CrossSection, Distance, Part, Placement, SectionSample, Sensing,
    SpringState, Transmission, Usage,
};
pub use mechanism::{
    Arriving, BodyEnergy, Energy, Given, Instant, Measures, Model, ModelState, OrderAtRest,
    RESOLVED_BLOW, StaticForces, add_resistance,
};
pub use motion::{Resolution, UnknownKind};
pub use scene::{
    BeamDefinition, ParticleDefinition, Probe, Quantity, RigidBodyDefinition, Scene, Sensor,
    StartMotion, StationVelocity, Value,
};
pub use sliders::{Blow, MasterEnd, MasterLimit, SliderState};
pub use words::{
    Approach, ModelError, SliderError, SliderParts, TrackError, Turning, refusal as refusal_of_name,
};

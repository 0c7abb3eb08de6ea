//! Scenes, and their assembly into mechanisms for integrators.

mod assembly;
mod bodies;
mod elements;
mod errors;
mod links;
mod mechanism;
mod queries;
mod scene;
mod sensors;
mod sliders;
mod state;
mod step_mean;

pub use elements::{
    Along, Anchor, BrakeLaw, Branch, ContactMember, ContactState, ContactTarget, DampingLaw, Drag,
    Dragged, Drive, DriveKind, DriveState, Element, LawArgument, LoadAccount, MaterialDamping,
    MotionCurvature, Obstacle, ObstacleShape, Origin, OutsideLaw, PairContact, Penetration,
    PointMass, PrescribedRest, ShortBounce, SpeedLaw, Spring, SpringKind, SpringLaw, StartMismatch,
    UnsampledChange,
};
pub(crate) use errors::rounded;
pub use errors::{
    Approach, SliderError, SliderParts, SystemError, TrackError, Turning, check_name,
    refusal as refusal_of_name, with_article,
};
pub use mechanism::{
    Arriving, BodyEnergy, Energy, Instant, Measures, RESOLVED_IMPACT, Reactions, StartImpact,
    StaticForces, StaticOrder, System, SystemState, add_resistance,
};
pub use queries::{
    BeamPlaces, BeamSample, CrossSection, Distance, Placement, SectionSample, SensorReader,
    SpringState, SystemFeature, Transmission, Usage,
};
pub use scene::{
    BeamDefinition, ParticleDefinition, RigidBodyDefinition, Scene, StartMotion, StationVelocity,
};
pub use sensors::{
    Quantity, RECORDABLE, Sensor, SensorSource, ValueTime, body_energies, section_values,
};
pub(crate) use sliders::END_TOLERANCE;
pub use sliders::{AxialImpact, ContactChange, MasterEnd, MasterLimit, SliderEvent, SliderState};
pub use state::{Resolution, UnknownKind};

//! The description of what is simulated, and its checks.

mod description;
mod stored;

pub use description::{
    BeamDefinition, ParticleDefinition, PointMass, Scene, StartMotion, StationVelocity,
};

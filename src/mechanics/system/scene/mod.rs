//! Definition of the simulated system, and checks of this definition.

mod columns;
mod definitions;
mod description;
mod drives;
mod extent;
mod likeness;
mod loads;
mod mesh_choice;
mod mesh_order;
mod releases;
mod resisting;
mod rigid_bodies;
mod sensors;
mod sliders;
mod stored;
mod ties;
mod tracks;

pub use definitions::{
    BeamDefinition, ParticleDefinition, RigidBodyDefinition, StartMotion, StationVelocity,
};
pub use description::Scene;
pub use ties::{Ties, same_place};

//! The description of what is simulated, and its checks.

mod definitions;
mod description;
mod likeness;
mod sliders;
mod stored;
mod ties;

pub use definitions::{BeamDefinition, ParticleDefinition, StartMotion, StationVelocity};
pub use description::Scene;
pub use ties::{Ties, same_place};

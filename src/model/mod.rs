//! From a scene, as the user describes it, to a mechanism that integrators can advance.

mod applied;
mod assemble;
mod body;
mod error;
mod inertia;
mod measures;
mod mechanism;
mod numbering;
mod queries;
mod scene;
mod tracker;

pub use error::ModelError;
pub use measures::{Energy, Measures};
pub use mechanism::Model;
pub use queries::ModelState;
pub use scene::{BeamDefinition, PointMass, Scene, StartMotion, StationVelocity};

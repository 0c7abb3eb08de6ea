//! Queries of a model: positions, motion and features in use. Queries do not change the model.

mod beam_places;
mod drives;
mod explain;
mod joint_forces;
mod placement;
mod section_forces;
mod sensing;
mod sliders;
mod springs;
mod state;

pub use beam_places::{BeamPlaces, BeamSample};
pub use explain::{SystemFeature, Usage};
pub use joint_forces::Transmission;
pub use placement::{Distance, Placement};
pub use section_forces::{CrossSection, SectionSample};
pub use sensing::SensorReader;
pub use springs::SpringState;

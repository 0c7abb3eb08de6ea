//! Looking at a model: where it is, how it moves, and what it uses.

mod beam_places;
mod drives;
mod explain;
mod joint_forces;
mod placement;
mod queries;
mod section_forces;
mod sensing;
mod sliders;
mod springs;

pub use beam_places::{BeamPlaces, BeamSample};
pub use explain::{Part, Usage};
pub use joint_forces::Transmission;
pub use placement::{Distance, Placement};
pub use section_forces::{CrossSection, SectionSample};
pub use sensing::Sensing;
pub use springs::SpringState;

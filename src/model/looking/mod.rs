//! Looking at a model: where it is, how it moves, and what it uses.

mod along;
mod explain;
mod placement;
mod queries;
mod section_forces;
mod sliders;

pub use along::{BeamPlaces, BeamSample};
pub use explain::{Part, Usage};
pub use placement::{Distance, Placement};
pub use section_forces::{CrossSection, SectionSample};

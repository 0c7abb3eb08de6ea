//! Looking at a model: where it is, how it moves, and what it uses.

mod explain;
mod placement;
mod queries;
mod sliders;
mod springs;

pub use explain::{Part, Usage};
pub use placement::{Distance, Placement};
pub use springs::SpringState;

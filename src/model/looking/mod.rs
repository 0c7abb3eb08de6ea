//! Looking at a model.

mod explain;
mod measures;
mod placement;
mod queries;

pub use explain::{Part, Usage};
pub use measures::{Energy, Measures};
pub use placement::{Distance, Placement};
pub use queries::ModelState;

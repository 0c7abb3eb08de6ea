//! What a model says: its errors, and what may be a name.

mod error;
pub(super) mod names;
mod slider_error;

pub use error::ModelError;
pub use slider_error::{SliderError, SliderParts};

//! Parameter searches: fits to data, and designs under constraints. The algorithms are in `fitting`.

pub mod design;
pub mod fit;
pub mod ranges;
pub mod root;
mod scales;

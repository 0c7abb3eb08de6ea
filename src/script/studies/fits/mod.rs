//! Parameter searches: fits to data, and designs under constraints.

pub mod design;
pub mod fit;
pub mod ranges;
pub mod root;
mod scales;

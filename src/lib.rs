//! withy: planar dynamics of flexible beams that slide on each other, and the language to script it.
//!
//! Layers, each using only those to its right:
//!
//! ```text
//! main → cli → script → output → simulation → model ┬→ joints, loads → beams → geometry
//!                                                   └→ integrators → newton → linalg
//! ```

pub mod geometry;
pub mod output;

//! Random sampling of parameters: distributions, sets of points, and sensitivity indices.
//!
//! Equal seeds give equal points on every machine, because the generator (ChaCha with twelve rounds) is defined bit by bit.
//! Random bits are converted to numbers here, because the conversion in a library may change with its version.

#![cfg_attr(test, allow(clippy::unwrap_used))]

mod distribution;
mod latin_hypercube;
mod normal;
mod random;
mod saltelli;
mod sensitivity;
mod sobol;

pub use distribution::Distribution;
pub use latin_hypercube::latin_hypercube;
pub use normal::normal_quantile;
pub use random::Random;
pub use saltelli::saltelli;
pub use sensitivity::{VarianceShare, grid_indices, rank_indices, saltelli_indices};
pub use sobol::{MOST_DIMENSIONS, sobol};

//! Matrices of one step: banded storage with a pivoted LU, and the ordering that keeps the band narrow.

mod banded;
mod error;
mod ordering;

pub use banded::{BandedLu, BandedMatrix};
pub use error::LinearError;
pub use ordering::{Ordering, reverse_cuthill_mckee};

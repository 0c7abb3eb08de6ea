//! Matrices of one step: banded storage with a pivoted LU, a border for what reaches further, and the ordering that
//! keeps the band narrow.

mod band_rows;
mod banded;
mod bordered;
mod elimination;
mod error;
mod ordering;
mod substitution;
mod sylvester;

pub use band_rows::BandRows;
pub use banded::{BandedLu, BandedMatrix};
pub use bordered::{Border, BorderShape, BorderedLu, BorderedMatrix};
pub use error::LinearError;
pub use ordering::{Ordering, reverse_cuthill_mckee};
pub use sylvester::negative_eigenvalues;

//! Matrices of a time step: banded storage, LU factorisation with row exchanges, borders for couplings across the band, and bandwidth reduction.

mod arrangement;
mod band_rows;
mod banded;
mod block;
mod bordered;
mod complementarity;
mod distant;
mod double_double;
mod elimination;
mod error;
mod fixed_band;
mod full_border;
mod joint_elimination;
mod local_border;
mod ordering;
mod precise_band;
mod profile;
mod sparse;
mod storage;
mod strips;
mod substitution;
mod symmetric_factors;
mod two_ended;

pub(crate) use band_rows::BandRows;
pub use banded::{BandedLu, BandedMatrix};
pub use bordered::{Border, BorderShape, BorderUnit, BorderedLu, BorderedMatrix};
pub(crate) use complementarity::{Pairing, complementary};
pub use error::LinearError;
pub(crate) use full_border::FullBorder;
pub(crate) use local_border::{BlockLayout, LocalBorder};
pub(crate) use ordering::reverse_cuthill_mckee;
pub(crate) use precise_band::PreciseBand;
pub(crate) use sparse::SymmetricSparse;
pub(crate) use strips::{
    STRIP_WIDTH, Square4, VectorStrip, combine, products, subtract_combination,
};
pub(crate) use symmetric_factors::SymmetricFactors;

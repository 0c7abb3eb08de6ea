//! Versioned and checksummed files of simulations.

mod envelope;
mod error;

pub(super) use envelope::{unwrap, wrap};
pub use error::ArchiveError;

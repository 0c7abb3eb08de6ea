//! Simulations as files that survive a restart: versioned and checksummed.

mod envelope;
mod error;

pub(super) use envelope::{unwrap, wrap};
pub use error::ArchiveError;

//! Simulations as files that survive a restart: bit for bit, versioned, checksummed.

mod content;
mod envelope;
mod error;

pub use error::ArchiveError;

//! Studies: many runs, and what they say together. Nothing here draws or prints.
//!
//! ```text
//! studies → case, outcome → workers → journal
//! ```

#![cfg_attr(test, allow(clippy::unwrap_used))]

mod case;
mod journal;
mod outcome;
mod workers;

#[cfg(test)]
mod samples;

pub use case::{Case, Patience};
pub use journal::{Journal, JournalError};
pub use outcome::Outcome;
pub use workers::on_all_cores;

//! Studies: many runs, and what they say together. Nothing here draws or prints.
//!
//! ```text
//! studies → case, outcome → workers → journal
//! ```

#![cfg_attr(test, allow(clippy::unwrap_used))]

mod case;
mod cost;
mod features;
mod journal;
mod outcome;
mod stability;
mod workers;

#[cfg(test)]
mod samples;

pub use case::{Case, Patience};
pub use cost::{CostCase, StepCost, step_costs};
pub use features::{FEATURES, Feature};
pub use journal::{Journal, JournalError};
pub use outcome::Outcome;
pub use stability::Verdict;
pub use workers::on_all_cores;

//! Studies: many runs, and what they say together. Nothing here draws or prints.
//!
//! ```text
//! stability, cost → features
//! precision, convergence → combination, truth, rivals → trial, observable, sheet
//! trial, timing → case, outcome → patience, workers → journal
//! ```

#![cfg_attr(test, allow(clippy::unwrap_used))]

mod case;
mod combination;
mod convergence;
mod cost;
mod features;
mod journal;
mod observable;
mod outcome;
mod pareto;
mod patience;
mod precision;
mod rivals;
mod row_journal;
mod sheet;
mod stability;
mod sweep;
mod timing;
mod trial;
mod truth;
mod workers;

#[cfg(test)]
mod samples;

pub use case::Case;
pub use combination::{
    Combination, PART_OF_THE_SMALLEST_STEP, Subject, all_combinations, finest_mesh, highest_order,
};
pub use convergence::{ALL_POSITIONS, Convergence, Ladder, Refined};
pub use cost::{CostCase, StepCost, step_costs};
pub use features::{FEATURES, Feature};
pub use journal::{Journal, JournalError};
pub use observable::{Observable, ObservableKind, SYMBOLS};
pub use outcome::Outcome;
pub use pareto::pareto_front;
pub use patience::{Patience, is_out_of_patience};
pub use precision::{Precision, PrecisionRow};
pub use rivals::{Rival, RivalError, machines};
pub use row_journal::{RowEntry, RowJournal, read_rows, remove_rows};
pub use sheet::{Sheet, SheetError};
pub use stability::Verdict;
pub use sweep::{
    Arrangement, Choice, Sweep, SweepColumn, SweepDesign, SweepResults, SweptParameter, SweptValues,
};
pub use timing::Timing;
pub use trial::Trial;
pub use truth::{Deviation, Readings, Truth, TruthError};
pub use workers::on_all_cores;

//! Studies: series of runs and their evaluation. Nothing here draws or prints.
//!
//! ```text
//! stability, cost → features
//! error_estimate → trace
//! precision, convergence → combination, truth, rivals → trial, observable, sheet
//! trial, timing → case, outcome → patience, workers → journal
//! ```

#![cfg_attr(test, allow(clippy::unwrap_used))]

mod case;
mod combination;
mod convergence;
mod cost;
mod csv_table;
mod error_estimate;
mod external_results;
mod features;
mod journal;
mod observable;
mod outcome;
mod pareto;
mod precision;
mod reference;
mod row_journal;
mod run_limits;
mod run_result;
mod stability;
mod sweep;
mod timing;
mod trace;
mod workers;

#[cfg(test)]
mod samples;

pub use case::Case;
pub use combination::{
    Combination, ObservedScene, PART_OF_THE_SMALLEST_STEP, all_combinations, finest_mesh,
    highest_order,
};
pub use convergence::{ALL_POSITIONS, Convergence, RefinedParameter, Refinement};
pub use cost::{CostCase, StepCost, step_costs};
pub use csv_table::{ParsedCsv, ParsedCsvError};
pub use error_estimate::{DirectionError, ErrorVerdict, Levels};
pub use external_results::{ExternalResult, ExternalResultError, machines};
pub use features::{FEATURES, Feature};
pub use journal::{Journal, JournalError};
pub use observable::{Observable, ObservableKind, SYMBOLS, is_of_the_motion};
pub use outcome::CaseOutcome;
pub use pareto::pareto_front;
pub use precision::{Precision, PrecisionRow};
pub use reference::{Deviation, Readings, ReferenceError, ReferenceSolution};
pub use row_journal::{RowEntry, RowJournal, read_rows, remove_rows};
pub use run_limits::{RunLimits, is_past_deadline};
pub use run_result::RunResult;
pub use stability::StabilityVerdict;
pub use sweep::{
    Choice, RowLayout, Sweep, SweepColumn, SweepDesign, SweepResults, SweptParameter, SweptValues,
};
pub use timing::Timing;
pub use trace::{Trace, TraceSource, TracedQuantity};
pub use workers::on_all_cores;

//! Studies: series of runs and their evaluation. This module neither draws nor prints.

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

pub(crate) use case::Case;
pub(crate) use combination::{
    ObservedScene, PART_OF_THE_SMALLEST_STEP, all_combinations, finest_mesh, highest_order,
};
pub(crate) use convergence::{ALL_POSITIONS, Convergence, RefinedParameter, Refinement};
pub(crate) use cost::{CostCase, StepCost, step_costs};
pub(crate) use csv_table::ParsedCsv;
pub(crate) use error_estimate::{
    DiscretisationError, ErrorVerdict, ExpectedOrder, RefinementLevels,
};
pub(crate) use external_results::{ExternalResult, machines};
pub use features::{FEATURES, Feature};
pub use journal::{Journal, JournalError};
pub(crate) use observable::{Observable, SYMBOLS, is_of_the_motion};
pub(crate) use outcome::CaseOutcome;
pub(crate) use pareto::pareto_front;
pub(crate) use precision::{Precision, PrecisionRow};
pub(crate) use reference::{Deviation, ReferenceSolution};
pub(crate) use row_journal::{RowEntry, RowJournal, read_rows, remove_rows};
pub(crate) use run_limits::{RunLimits, is_past_deadline};
pub(crate) use run_result::RunResult;
pub(crate) use stability::StabilityVerdict;
pub(crate) use sweep::{
    Choice, RowLayout, Sweep, SweepColumn, SweepDesign, SweepResults, SweptParameter, SweptValues,
};
pub(crate) use timing::Timing;
pub(crate) use trace::{Trace, TraceSource, TracedQuantity};
pub(crate) use workers::on_all_cores;

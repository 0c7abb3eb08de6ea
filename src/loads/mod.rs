//! Loads and how they change with time.

mod error;
mod load;
mod schedule;
mod stored_schedule;

pub use error::{FunctionError, LoadError};
pub use load::{Frame, Load, LoadKind};
pub use schedule::{Operation, Schedule, ScheduleFunction, Side, VALUES_OF_A_MEAN};

//! Loads and how they change with time, and motions that are given.

mod course;
mod error;
mod load;
mod schedule;
mod stored_schedule;

pub use course::{Beginning, Course, Piece};
pub use error::{FunctionError, LoadError};
pub use load::{Frame, Load, LoadKind};
pub use schedule::{Operation, Schedule, ScheduleFunction, Side, VALUES_OF_A_MEAN};

//! Loads and how they change with time, and motions that are given.

mod beat;
mod continuity;
mod error;
mod load;
mod multiples;
mod prescribed_motion;
mod schedule;
mod stored_schedule;

pub use beat::Beat;
pub use error::{FunctionError, LoadError};
pub use load::{Frame, Load, LoadKind};
pub use multiples::multiple;
pub use prescribed_motion::{MotionAtStart, MotionInStep, PrescribedMotion};
pub use schedule::{Operation, Schedule, ScheduleFunction, Side, VALUES_OF_A_MEAN};

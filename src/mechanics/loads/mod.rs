//! Loads as functions of time, and prescribed motions.

mod continuity;
mod error;
mod load;
mod multiples;
mod prescribed_motion;
mod sample_clock;
mod schedule;
mod stored_schedule;

pub use error::{FunctionError, LoadError};
pub use load::{Load, LoadFrame, LoadKind};
pub use multiples::multiple;
pub(crate) use prescribed_motion::DeclaredJump;
pub use prescribed_motion::{MotionAtStart, MotionInStep, PrescribedMotion};
pub use sample_clock::SampleClock;
pub use schedule::{LimitSide, Operation, Schedule, StepMean, TimeFunction, VALUES_OF_A_MEAN};

//! Exercises: start files with a gap, judges that check the physics of an attempt, hints, and solutions.

pub(crate) mod attempt;
pub(crate) mod captured_output;
pub mod catalogue;
pub(crate) mod class;
pub(crate) mod error;
pub mod exercise;
pub(crate) mod fingerprint;
pub(crate) mod grading;
pub(crate) mod judge;
pub mod judging;
pub(crate) mod marks;
pub(crate) mod progress;
pub(crate) mod report;
mod silenced_writer;
pub(crate) mod submissions;
pub(crate) mod task;
pub(crate) mod watch;
pub(crate) mod workbook;

//! Exercises. An exercise consists of a start file with a gap, a judge that checks the physics of the attempt, hints, and a solution.
//!
//! [`catalogue`] lists all exercises, and [`judging`] runs an attempt and its judge. [`workbook`] is the folder of a student.
//! [`submissions`] are the folders of a class, and [`marks`] is the file of marks. The module `cli` displays the results.

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

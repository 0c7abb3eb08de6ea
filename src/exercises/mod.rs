//! Exercises: a start file with a gap, a judge that looks at the physics of the attempt, hints in steps, a solution.
//!
//! [`catalogue`] is the table of all; [`judging`] runs an attempt and its judge; [`workbook`] is the folder of a student,
//! [`submissions`] are the folders of a class, [`marks`] the file of their marks. Nothing is printed here: `cli` does that.

pub mod attempt;
pub mod captured_output;
pub mod catalogue;
pub mod class;
pub mod error;
pub mod exercise;
pub mod fingerprint;
pub mod grading;
pub mod judge;
pub mod judging;
pub mod marks;
pub mod progress;
pub mod report;
mod silenced_writer;
pub mod submissions;
pub mod task;
pub mod watch;
pub mod workbook;

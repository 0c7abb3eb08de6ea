//! Exercises: a start file with a gap, a judge that checks the physics of the attempt, hints, and a solution.
//!
//! [`catalogue`] lists all exercises; [`judging`] runs an attempt and its judge; [`workbook`] is the folder of a student, [`submissions`]
//! are the folders of a class, [`marks`] is the file of their marks. Output is left to `cli`.

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

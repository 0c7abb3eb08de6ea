//! Tests of the language in this process: outputs of scripts, sessions and exercises.

#[path = "../common/mod.rs"]
mod common;

mod derivatives;
mod domains;
mod exercises;
mod explain;
mod exports;
mod motion_pictures;
mod newcomer;
mod present;
mod prompt;
mod science_pictures;
mod session;
mod standard_library;
mod suite;
mod viewers;

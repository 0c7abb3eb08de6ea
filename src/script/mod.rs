//! The language: Rhai with numbers as in science, tables of functions, and errors that say what to do.
//!
//! A domain is a [`Table`](table::Table) of rows; [`engine`] registers the tables; [`runner`] runs a script on a
//! large stack; [`diagnose`] turns every error into a message at the script's line and column.
//! There is no mechanics here: bodies of rows are short and call the library.

pub mod accept;
pub mod arguments;
mod brief;
pub mod built_in;
pub mod builtins;
pub mod call;
pub mod catalog;
pub mod checks;
mod constants;
pub mod context;
pub mod definitions;
mod details;
pub mod diagnose;
mod elements;
mod elsewhere;
pub mod engine;
pub mod error;
pub mod files;
pub mod foundation;
pub mod help;
pub mod highlight;
pub mod imports;
mod instead;
pub mod journals;
pub mod kind;
pub mod lexing;
pub mod library;
pub mod limits;
pub mod naming;
pub mod numbers;
pub mod operators;
pub mod options;
pub mod packages;
pub mod panics;
pub mod parameter;
pub mod present;
pub mod program;
pub mod progress;
pub mod reading;
pub mod reference;
pub mod register;
mod repetitions;
mod replacing;
mod reports;
mod rounds;
pub mod runner;
pub mod scanner;
pub mod settings;
pub mod sight;
pub mod sorting;
pub mod sources;
pub mod stored;
pub mod studies;
pub mod suggest;
pub mod syntax;
pub mod table;
pub mod topics;
pub mod watchdog;
pub mod words;

//! The language: Rhai with numbers as in science, tables of functions, and errors that say what to do.
//!
//! A domain is a [`Table`](rows::table::Table) of rows; [`engine`] registers the tables and runs a script on a large stack;
//! [`diagnose`] turns every error into a message at the script's line and column. There is no mechanics here: bodies of rows are
//! short and call the library.
//!
//! Its wings use one another one way only: [`words`], [`source`], [`state`], [`rows`], [`dialect`], [`library`], [`diagnose`],
//! [`engine`], [`pages`], [`looks`], [`handles`], [`studies`], [`packages`].

pub mod bindings;
pub mod diagnose;
pub mod dialect;
pub mod engine;
pub mod handles;
pub mod help;
pub mod library;
pub mod messages;
pub mod packages;
pub mod presentation;
pub mod source;
pub mod state;
pub mod studies;

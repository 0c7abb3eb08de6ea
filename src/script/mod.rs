//! The scripting language: Rhai with numbers as in scientific languages and with helpful errors.
//! Tables list the functions that scripts can call.
//!
//! A domain is a [`BindingTable`](bindings::table::BindingTable) of bindings. [`engine`] registers the tables and runs a script on a large stack.
//! [`diagnose`] converts every error to a message with line and column of the script.
//! The modules of the language contain no mechanics: bindings are short and call the solver library.
//!
//! Each module may use only the modules before it in this list:
//! `messages, source, state, bindings, dialect, library, diagnose, engine, help, presentation, handles, studies, packages`.

pub mod bindings;
pub mod diagnose;
pub(crate) mod dialect;
pub mod engine;
pub(crate) mod handles;
pub mod help;
pub mod library;
pub mod messages;
pub mod packages;
pub mod presentation;
pub mod source;
pub mod state;
pub(crate) mod studies;

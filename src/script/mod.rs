//! The scripting language: Rhai with numbers as in scientific languages and with helpful errors.
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

//! The scripting language: Rhai with scientific number semantics and helpful errors. Tables list the functions that scripts can call.
//!
//! A domain is a [`BindingTable`](bindings::table::BindingTable) of bindings; [`engine`] registers the tables and runs a script on a large stack;
//! [`diagnose`] turns every error into a message at the script's line and column. There is no mechanics here: bindings are short and call
//! the solver library.
//!
//! Modules depend on one another in this order only: [`messages`], [`source`], [`state`], [`bindings`], `dialect`, [`library`], [`diagnose`],
//! [`engine`], [`help`], [`presentation`], `handles`, `studies`, [`packages`].

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

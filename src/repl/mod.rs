//! Interactive sessions. Inputs are evaluated and recorded, and the effects of failed inputs are undone.

pub(crate) mod batch;
pub mod clock;
pub(crate) mod commands;
mod curves;
pub mod document;
pub mod editor;
mod effects;
mod history_expression;
pub mod pager;
pub(crate) mod record;
mod sampling;
mod scope;
pub mod session;
pub mod shell;
mod statements;
mod surroundings;
#[cfg(feature = "terminal")]
pub(crate) mod terminal;
pub(crate) mod transcript;

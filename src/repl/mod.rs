//! Interactive sessions. Inputs are evaluated and recorded, and the effects of failed inputs are undone.
//! [`session`] and [`shell`] do not depend on a terminal. [`editor`] provides line editing.

pub(crate) mod batch;
pub mod clock;
pub(crate) mod commands;
mod curves;
pub mod editor;
mod effects;
mod history_expression;
pub mod pager;
pub(crate) mod prompt;
pub(crate) mod record;
mod sampling;
mod scope;
pub mod session;
pub mod shell;
mod statements;
mod surroundings;
pub(crate) mod transcript;

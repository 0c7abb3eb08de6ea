//! The session: what is typed is evaluated, remembered, and can be gone back from. [`session`] and [`shell`] know no terminal;
//! [`editor`] is how lines are typed at one.

pub mod batch;
pub mod clock;
pub mod commands;
mod curves;
pub mod editor;
mod effects;
mod history_expression;
pub mod pager;
pub mod prompt;
pub mod record;
mod sampling;
mod scope;
pub mod session;
pub mod shell;
mod statements;
mod surroundings;
pub mod transcript;

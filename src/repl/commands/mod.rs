//! The commands of the prompt: one table, and what they do.

mod help;
mod looking;
mod names;
mod plotting;
mod session;
mod stepping;
mod table;
mod timing;
mod words;

pub use table::{COMMANDS, Command, HELP, QUIT, find};
pub use words::meant;

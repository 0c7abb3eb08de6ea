//! Commands of the prompt.

mod help;
mod inspection;
mod names;
mod plain_commands;
mod plotting;
mod session;
mod stepping;
mod table;
mod timing;

pub use help::help_on;
pub use plain_commands::meant;
pub use table::{COMMANDS, Command, HELP, QUIT, find};

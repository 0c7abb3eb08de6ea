//! Help pages on names, for display in a terminal.

mod compose;
mod find;
mod library;
mod page;
mod rows;
mod unknown;

pub use compose::page;
pub use find::{HelpSubject, find, names};
pub use page::{HelpPage, HelpSection, HelpStyle, StyledText, WIDTH};
pub use rows::{maps, presence};
pub use unknown::UnknownTopic;

#[cfg(test)]
mod tests;

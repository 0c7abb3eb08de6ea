//! Help pages on names, for display in a terminal.

mod compose;
mod find;
mod library;
mod page;
mod rows;
mod unknown;

pub use compose::page;
pub(crate) use find::find;
pub use find::names;
pub use page::WIDTH;
pub(crate) use page::{HelpPage, StyledText};
pub(crate) use rows::{maps, presence};

#[cfg(test)]
mod tests;

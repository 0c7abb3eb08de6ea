//! Help: what a name means, as a page that a terminal can show.

mod compose;
mod find;
mod library;
mod page;
mod rows;
mod unknown;

pub use compose::page;
pub use find::{Subject, find, names};
pub use page::{Page, Part, Span, Style, WIDTH};
pub use rows::{maps, presence};
pub use unknown::Unknown;

#[cfg(test)]
mod tests;

//! Names that other languages and other programs have: what is written here instead. They are asked only where a name is unknown.

mod entry;
mod languages;
mod mechanics;

pub use entry::{ForeignName, called_with, find, find_exactly};

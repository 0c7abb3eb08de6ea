//! Names of other languages and programs, with their replacements. They are searched only if a name is unknown.

mod entry;
mod languages;
mod mechanics;

pub use entry::{called_with, find, find_exactly};

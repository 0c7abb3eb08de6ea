//! Names from other languages and programs, with their replacements, for messages about unknown names.

mod entry;
mod languages;
mod mechanics;

pub use entry::{called_with, find, find_exactly};

//! Names from other languages and programs, with their replacements. They are used only if a script contains an unknown name.

mod entry;
mod languages;
mod mechanics;

pub use entry::{called_with, find, find_exactly};

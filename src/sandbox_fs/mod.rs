//! File access below an open folder, by its descriptor. The folder cannot be exchanged, links are not followed, and only regular files are opened, so
//! that no pipe or device can block the program.
//!
//! Paths on the command line are trusted and may lead anywhere. Paths in scripts must be accessed through this module.

mod entries;
mod folder;
mod reading;
mod scratch;
mod whole;
mod written_files;

pub use folder::{Folder, is_plain};
pub use reading::{read_file, read_text};
pub use scratch::Scratch;
pub use written_files::{ChecksumWriter, FileChecksum, WrittenFiles};

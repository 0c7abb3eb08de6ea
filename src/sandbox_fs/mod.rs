//! Files below an open folder: opened from its descriptor, so that nobody can put another folder in its place, without following
//! links, and never anything but ordinary files: no pipe or device makes the program wait.
//!
//! What stands on a command line is a person's own word and may lead anywhere; what stands in a script goes through here.

mod entries;
mod folder;
mod reading;
mod scratch;
mod whole;
mod written_files;

pub use entries::FolderEntry;
pub use folder::{Folder, is_plain};
pub use reading::{read_file, read_text};
pub use scratch::Scratch;
pub use written_files::{ChecksumWriter, FileChecksum, WrittenFiles};

//! Access to files below an open folder through its file descriptor, so that the folder cannot be exchanged meanwhile.
//! Links are not followed, and only regular files are opened, because a pipe or a device could block the program.
//!
//! Paths in scripts are not trusted and must be accessed through this module. Paths on the command line are trusted.

#[cfg_attr(target_family = "wasm", path = "dir_wasm.rs")]
mod dir;
mod entries;
mod folder;
mod reading;
#[cfg(feature = "terminal")]
mod scratch;
mod whole;
mod written_files;

pub use folder::{Folder, is_plain};
pub use reading::{read_file, read_text};
#[cfg(feature = "terminal")]
pub use scratch::Scratch;
pub use written_files::{ChecksumWriter, FileChecksum, WrittenFiles};

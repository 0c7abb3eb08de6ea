//! Access to files below an open folder through the file descriptor of the folder.
//! The folder cannot be exchanged during the access, and links are not followed.
//! Only regular files are opened, so that a pipe or a device cannot block the program.
//!
//! Paths on the command line are trusted and may lead anywhere. Paths in scripts are not trusted, and must be accessed through this module.

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

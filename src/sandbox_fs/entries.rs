//! What lies in an open folder.

use std::ffi::{OsStr, OsString};
use std::io::{self, ErrorKind};
use std::path::Path;
use std::time::SystemTime;

use super::folder::{Folder, is_plain};

/// Something that lies in an open folder.
#[derive(Debug)]
pub struct FolderEntry {
    /// The name of the entry in its folder.
    pub name: OsString,
    /// The length of the entry [bytes].
    pub length: u64,
    /// The time of the last change of the entry, where the system tells it.
    pub changed: Option<SystemTime>,
    /// Whether the entry is a folder.
    pub is_folder: bool,
}

impl Folder {
    /// What lies in this folder, by name and in its order: length, time of the last change, and whether it is a folder. Links count as
    /// themselves. What cannot be looked at is left out.
    ///
    /// # Errors
    /// When the folder cannot be read.
    pub fn entries(&self) -> io::Result<Vec<FolderEntry>> {
        let entry = |entry: cap_std::fs::DirEntry| {
            let about = self.0.symlink_metadata(entry.file_name()).ok()?;
            let changed = about.modified().ok().map(cap_std::time::SystemTime::into_std);
            let (name, length) = (entry.file_name(), about.len());
            Some(FolderEntry { name, length, changed, is_folder: about.is_dir() })
        };
        let mut all: Vec<_> = self.0.entries()?.flatten().filter_map(entry).collect();
        all.sort_by(|a, b| a.name.cmp(&b.name));
        Ok(all)
    }

    /// Opens a folder that lies in this one, by its name; a link is not followed.
    ///
    /// # Errors
    /// When there is no folder of this name, or it is a link.
    pub fn below(&self, name: &OsStr) -> io::Result<Self> {
        match is_plain(Path::new(name)) {
            true => self.enter(name),
            false => Err(io::Error::new(ErrorKind::InvalidInput, "it leads out of the folder")),
        }
    }
}

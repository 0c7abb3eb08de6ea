//! Lists the files and subfolders of an open folder.

use std::ffi::{OsStr, OsString};
use std::io::{self, ErrorKind};
use std::path::Path;
use std::time::SystemTime;

use super::dir::time_of_change;
use super::folder::{Folder, is_plain};

#[derive(Debug)]
pub struct FolderEntry {
    pub name: OsString,
    /// Length of the file [bytes].
    pub length: u64,
    /// Time of the last change; `None` if the system does not provide it.
    pub changed: Option<SystemTime>,
    pub is_folder: bool,
}

impl Folder {
    /// Files and subfolders of this folder, sorted by name. A link is listed as a link, not as its target.
    /// An entry whose type and size cannot be read is omitted.
    pub fn entries(&self) -> io::Result<Vec<FolderEntry>> {
        let entry = |name: OsString| {
            let about = self.0.metadata(&name).ok()?;
            let (length, changed) = (about.len(), time_of_change(&about));
            Some(FolderEntry { name, length, changed, is_folder: about.is_dir() })
        };
        let mut all: Vec<_> = self.0.names()?.into_iter().filter_map(entry).collect();
        all.sort_by(|a, b| a.name.cmp(&b.name));
        Ok(all)
    }

    /// Opens a subfolder by its name, without following a link.
    pub fn below(&self, name: &OsStr) -> io::Result<Self> {
        match is_plain(Path::new(name)) {
            true => self.enter(name),
            false => {
                Err(io::Error::new(ErrorKind::InvalidInput, "it is outside the allowed folder"))
            }
        }
    }
}

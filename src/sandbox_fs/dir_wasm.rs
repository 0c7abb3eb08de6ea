//! Operations on the entries of a folder in WebAssembly, whose file system has no links and no other processes.

use std::ffi::{OsStr, OsString};
pub use std::fs::Metadata;
use std::fs::{self, OpenOptions};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

#[derive(Debug)]
pub struct Dir(PathBuf);

impl Dir {
    pub fn open(path: &Path) -> io::Result<Self> {
        match fs::metadata(path)?.is_dir() {
            true => Ok(Self(path.to_owned())),
            false => Err(ErrorKind::NotADirectory.into()),
        }
    }

    pub fn open_dir(&self, name: &OsStr) -> io::Result<Self> {
        Self::open(&self.0.join(name))
    }

    pub fn try_clone(&self) -> io::Result<Self> {
        Ok(Self(self.0.clone()))
    }

    pub fn metadata(&self, name: &OsStr) -> io::Result<Metadata> {
        fs::symlink_metadata(self.0.join(name))
    }

    pub fn create_dir(&self, name: &OsStr) -> io::Result<()> {
        fs::create_dir(self.0.join(name))
    }

    pub fn open_file(&self, name: &OsStr) -> io::Result<fs::File> {
        open_file(&self.0.join(name))
    }

    pub fn create_file(&self, name: &OsStr) -> io::Result<fs::File> {
        fs::File::create_new(self.0.join(name))
    }

    pub fn append_to_file(&self, name: &OsStr) -> io::Result<fs::File> {
        OpenOptions::new().append(true).create(true).open(self.0.join(name))
    }

    pub fn rename(&self, name: &OsStr, new: &OsStr) -> io::Result<()> {
        fs::rename(self.0.join(name), self.0.join(new))
    }

    pub fn remove_file(&self, name: &OsStr) -> io::Result<()> {
        fs::remove_file(self.0.join(name))
    }

    pub fn names(&self) -> io::Result<Vec<OsString>> {
        Ok(fs::read_dir(&self.0)?.flatten().map(|entry| entry.file_name()).collect())
    }

    /// Has no effect.
    pub fn sync(&self) -> io::Result<()> {
        Ok(())
    }
}

pub fn open_file(path: &Path) -> io::Result<fs::File> {
    fs::File::open(path)
}

/// Time of the last change; `None` if the system does not provide it.
pub fn time_of_change(about: &Metadata) -> Option<SystemTime> {
    about.modified().ok()
}

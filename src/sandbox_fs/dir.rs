//! Operations on the entries of an open folder through its file descriptor, without following links.

use std::ffi::{OsStr, OsString};
use std::fs;
use std::io;
use std::path::Path;
use std::time::SystemTime;

use cap_fs_ext::{DirExt, FollowSymlinks, OpenOptionsFollowExt, OpenOptionsSyncExt};
use cap_std::ambient_authority;
pub use cap_std::fs::Metadata;
use cap_std::fs::{File, OpenOptions};

#[derive(Debug)]
pub struct Dir(cap_std::fs::Dir);

impl Dir {
    pub fn open(path: &Path) -> io::Result<Self> {
        cap_std::fs::Dir::open_ambient_dir(path, ambient_authority()).map(Self)
    }

    pub fn open_dir(&self, name: &OsStr) -> io::Result<Self> {
        self.0.open_dir_nofollow(name).map(Self)
    }

    pub fn try_clone(&self) -> io::Result<Self> {
        self.0.try_clone().map(Self)
    }

    pub fn metadata(&self, name: &OsStr) -> io::Result<Metadata> {
        self.0.symlink_metadata(name)
    }

    pub fn create_dir(&self, name: &OsStr) -> io::Result<()> {
        self.0.create_dir(name)
    }

    pub fn open_file(&self, name: &OsStr) -> io::Result<fs::File> {
        self.open_with(name, &reading(FollowSymlinks::No))
    }

    pub fn create_file(&self, name: &OsStr) -> io::Result<fs::File> {
        let mut options = OpenOptions::new();
        options.write(true).create_new(true).follow(FollowSymlinks::No);
        self.open_with(name, &options)
    }

    pub fn append_to_file(&self, name: &OsStr) -> io::Result<fs::File> {
        let mut options = OpenOptions::new();
        options.append(true).create(true).nonblock(true).follow(FollowSymlinks::No);
        self.open_with(name, &options)
    }

    fn open_with(&self, name: &OsStr, options: &OpenOptions) -> io::Result<fs::File> {
        self.0.open_with(name, options).map(File::into_std)
    }

    pub fn rename(&self, name: &OsStr, new: &OsStr) -> io::Result<()> {
        self.0.rename(name, &self.0, new)
    }

    pub fn remove_file(&self, name: &OsStr) -> io::Result<()> {
        self.0.remove_file_or_symlink(name)
    }

    pub fn names(&self) -> io::Result<Vec<OsString>> {
        Ok(self.0.entries()?.flatten().map(|entry| entry.file_name()).collect())
    }

    /// Writes the folder to disk, if the system supports it.
    pub fn sync(&self) -> io::Result<()> {
        #[cfg(unix)]
        {
            let open = self.0.open(".")?.into_std();
            match open.sync_all() {
                Err(error) if error.kind() != io::ErrorKind::InvalidInput => return Err(error),
                _ => (),
            }
        }
        Ok(())
    }
}

fn reading(follow: FollowSymlinks) -> OpenOptions {
    let mut options = OpenOptions::new();
    options.read(true).nonblock(true).follow(follow);
    options
}

/// Opens a file for reading at a path given by the user. Links are followed.
pub fn open_file(path: &Path) -> io::Result<fs::File> {
    let options = reading(FollowSymlinks::Yes);
    File::open_ambient_with(path, &options, ambient_authority()).map(File::into_std)
}

/// Time of the last change; `None` if the system does not provide it.
pub fn time_of_change(about: &Metadata) -> Option<SystemTime> {
    about.modified().ok().map(cap_std::time::SystemTime::into_std)
}

//! Open folder, whose files are accessed through its file descriptor, not through its path.

use std::ffi::OsStr;
use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Component, Path};

use super::dir::Dir;
use super::reading;

/// Open folder. It remains the same folder even if it is renamed or replaced by a link.
#[derive(Debug)]
pub struct Folder(pub(super) Dir);

/// Returns true if a path is relative and contains no `..`, so that it cannot leave a folder.
pub fn is_plain(name: &Path) -> bool {
    let mut parts = name.components();
    name.components().next().is_some() && parts.all(|part| matches!(part, Component::Normal(_)))
}

impl Folder {
    /// Opens a folder at a path given by the user, following links.
    pub fn open(path: &Path) -> io::Result<Self> {
        let path = if path.as_os_str().is_empty() { Path::new(".") } else { path };
        Dir::open(path).map(Self)
    }

    /// Opens a folder for writing; the folder and its parents are created if necessary.
    /// A link in place of the folder is rejected, because it could lead anywhere.
    pub fn open_or_create(path: &Path) -> io::Result<Self> {
        let above = path.parent().filter(|above| !above.as_os_str().is_empty());
        let above = above.unwrap_or(Path::new("."));
        match path.components().next_back() {
            Some(Component::Normal(name)) => {
                fs::create_dir_all(above)?;
                Self::open(above)?.enter_or_create(name)
            }
            _ => Self::open(path),
        }
    }

    /// Opens an existing folder that is not a link.
    pub fn find(path: &Path) -> io::Result<Self> {
        match path.components().next_back() {
            Some(Component::Normal(name)) => {
                Self::open(path.parent().unwrap_or(Path::new(".")))?.enter(name)
            }
            _ => Self::open(path),
        }
    }

    pub(super) fn enter(&self, name: &OsStr) -> io::Result<Self> {
        self.0.open_dir(name).map(Self).map_err(|error| {
            match self.0.metadata(name).is_ok_and(|about| about.is_symlink()) {
                true => io::Error::other(format!(
                    "'{}' is a link, and links are not followed; give the folder itself",
                    name.display()
                )),
                false => error,
            }
        })
    }

    pub(super) fn enter_or_create(&self, name: &OsStr) -> io::Result<Self> {
        match self.enter(name) {
            Err(error) if error.kind() == ErrorKind::NotFound => {
                match self.0.create_dir(name) {
                    Err(error) if error.kind() != ErrorKind::AlreadyExists => return Err(error),
                    _ => (),
                }
                self.enter(name)
            }
            entered => entered,
        }
    }

    pub(super) fn parent_of<'n>(
        &self,
        name: &'n Path,
        enter: fn(&Self, &OsStr) -> io::Result<Self>,
    ) -> io::Result<(Self, &'n OsStr)> {
        let refused =
            || io::Error::new(ErrorKind::InvalidInput, "it is outside the allowed folder");
        if !is_plain(name) {
            return Err(refused());
        }
        let mut folder = Self(self.0.try_clone()?);
        for part in name.parent().into_iter().flat_map(Path::components) {
            folder = enter(&folder, part.as_os_str())?;
        }
        Ok((folder, name.file_name().ok_or_else(refused)?))
    }

    /// Reads a regular file of at most `most` bytes below this folder, without following links.
    pub fn read(&self, name: &Path, most: u64) -> io::Result<Vec<u8>> {
        reading::read(self.open_file(name)?, most)
    }

    /// Opens a regular file below this folder for reading, without following links.
    pub fn open_file(&self, name: &Path) -> io::Result<fs::File> {
        let (folder, name) = self.parent_of(name, Self::enter)?;
        let about = folder.0.metadata(name)?;
        if about.is_symlink() {
            return Err(io::Error::other("it is a link, and links are not followed"));
        }
        reading::expect_ordinary(about.is_file())?;
        let file = folder.0.open_file(name)?;
        reading::expect_ordinary(file.metadata()?.is_file())?;
        Ok(file)
    }

    pub fn has(&self, name: &Path) -> bool {
        let found = self.parent_of(name, Self::enter);
        found.is_ok_and(|(folder, name)| folder.0.metadata(name).is_ok())
    }

    pub fn is_unlocked(&self, name: &Path) -> io::Result<bool> {
        Ok(self.open_file(name)?.try_lock().is_ok())
    }

    pub fn create(&self, name: &Path) -> io::Result<fs::File> {
        let (folder, name) = self.parent_of(name, Self::enter_or_create)?;
        folder.0.create_file(name)
    }

    /// Opens a regular file for appending, and creates it if it does not exist.
    pub fn append(&self, name: &Path) -> io::Result<fs::File> {
        let (folder, name) = self.parent_of(name, Self::enter_or_create)?;
        let file = folder.0.append_to_file(name)?;
        reading::expect_ordinary(file.metadata()?.is_file())?;
        Ok(file)
    }

    pub fn replace(&self, name: &Path, new: &Path) -> io::Result<()> {
        self.0.rename(name.as_os_str(), new.as_os_str())?;
        self.sync()
    }

    pub fn remove(&self, name: &Path) -> io::Result<()> {
        self.0.remove_file(name.as_os_str())
    }

    /// Writes the folder to disk, if the system supports it, so that renamed files keep their new names after a power failure.
    pub(super) fn sync(&self) -> io::Result<()> {
        self.0.sync()
    }
}

#[cfg(test)]
#[cfg(unix)]
mod tests {
    use super::*;
    use crate::sandbox_fs::whole::TRIES;
    use std::os::unix::fs::symlink;
    use std::path::PathBuf;
    use std::sync::atomic::{AtomicBool, Ordering};

    fn home() -> (tempfile::TempDir, PathBuf, PathBuf) {
        let home = tempfile::tempdir().unwrap();
        let (own, other) = (home.path().join("own"), home.path().join("other"));
        fs::create_dir(&own).unwrap();
        fs::create_dir(&other).unwrap();
        fs::write(other.join("secret"), "secret").unwrap();
        (home, own, other)
    }

    #[test]
    fn folder_operations_follow_no_links() {
        let (_home, own, other) = home();
        symlink(&other, own.join("way")).unwrap();
        symlink(other.join("secret"), own.join("file")).unwrap();
        symlink(&own, other.join("out")).unwrap();
        let folder = Folder::open(&own).unwrap();
        for name in ["way/secret", "file", "../other/secret", "a/../../other/secret", ""] {
            assert!(folder.read(Path::new(name), 100).is_err(), "{name}");
            assert!(folder.append(Path::new(name)).is_err(), "{name}");
            assert!(folder.create(Path::new(name)).is_err(), "{name}");
        }
        assert!(folder.write_atomic(Path::new("way/new"), b"x").is_err());
        folder.write_atomic(Path::new("file"), b"mine").unwrap();
        assert_eq!(fs::read(other.join("secret")).unwrap(), b"secret");
        assert_eq!(folder.read(Path::new("file"), 100).unwrap(), b"mine");
        let message = Folder::open_or_create(&other.join("out")).unwrap_err().to_string();
        assert!(message.contains("'out' is a link"), "{message}");
    }

    #[test]
    fn existing_links_named_as_partial_files_are_not_followed() {
        let (_home, own, other) = home();
        for count in 0..TRIES - 2 {
            let name = format!(".a.{}-{count}.part", std::process::id());
            symlink(other.join("secret"), own.join(name)).unwrap();
        }
        let folder = Folder::open(&own).unwrap();
        folder.write_atomic(Path::new("a"), b"mine").unwrap();
        assert_eq!(fs::read(own.join("a")).unwrap(), b"mine");
        assert_eq!(fs::read(other.join("secret")).unwrap(), b"secret");
    }

    #[test]
    fn folders_pipes_and_devices_are_not_replaced() {
        let (_home, own, _) = home();
        fs::create_dir(own.join("below")).unwrap();
        let pipe = own.join("pipe");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let folder = Folder::open(&own).unwrap();
        for name in ["below", "pipe"] {
            assert!(folder.write_atomic(Path::new(name), b"x").is_err(), "{name}");
            assert!(folder.read(Path::new(name), 100).is_err(), "{name}");
            assert!(folder.append(Path::new(name)).is_err(), "{name}");
        }
        assert_eq!(fs::read_dir(&own).unwrap().count(), 2, "no partial file is left");
    }

    #[test]
    fn kept_file_gets_an_unused_name() {
        let (_home, own, _) = home();
        let folder = Folder::open(&own).unwrap();
        fs::write(own.join("a"), "old").unwrap();
        fs::write(own.join("a.1"), "older").unwrap();
        let kept = folder.keep_as(Path::new("a"), |n| format!("a.{n}").into()).unwrap();
        assert_eq!(kept, Path::new("a.2"));
        assert!(!own.join("a").exists());
        assert_eq!(fs::read(own.join("a.2")).unwrap(), b"old");
    }

    /// While files are read and written, another thread repeatedly replaces folders and files by links.
    #[test]
    fn concurrent_link_replacement_does_not_escape_the_folder() {
        let (home, own, other) = home();
        fs::create_dir(own.join("way")).unwrap();
        fs::write(own.join("way/secret"), "mine").unwrap();
        symlink(&other, home.path().join("link")).unwrap();
        let stop = AtomicBool::new(false);
        let (tries, mut read, mut wrong) = (20_000, 0, None);
        std::thread::scope(|scope| {
            scope.spawn(|| {
                let (way, aside, link) =
                    (own.join("way"), home.path().join("aside"), home.path().join("link"));
                while !stop.load(Ordering::Relaxed) {
                    if aside.exists() {
                        let _ = fs::remove_dir_all(&way).and_then(|()| fs::rename(&aside, &way));
                    }
                    let _ = fs::rename(&way, &aside).and_then(|()| fs::rename(&link, &way));
                    let _ = fs::rename(&way, &link).and_then(|()| fs::rename(&aside, &way));
                }
            });
            let folder = Folder::open(&own).unwrap();
            for number in 0..tries {
                if let Ok(found) = folder.read(Path::new("way/secret"), 100) {
                    read += 1;
                    wrong = wrong.or((found != b"mine").then_some(number));
                }
                if number % 50 == 0 {
                    let name = PathBuf::from(format!("way/new-{number}"));
                    let _ = folder.create(&name);
                }
            }
            stop.store(true, Ordering::Relaxed);
        });
        assert_eq!(wrong, None, "somebody else's file was read");
        assert!(read > 0, "the file was never there");
        assert_eq!(fs::read_dir(&other).unwrap().count(), 1, "something was written outside");
    }
}

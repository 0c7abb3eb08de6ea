//! Temporary folders with unpredictable names. The folder of a killed process is removed by a later process.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use tempfile::TempDir;

use super::Folder;

const PREFIX: &str = "withy-scratch-";
const HELD: &str = ".held";
/// Age from which a temporary folder without lock file counts as abandoned; a younger one may belong to a starting process.
const BEGINNING: Duration = Duration::from_secs(3600);

#[derive(Debug)]
pub struct Scratch {
    folder: TempDir,
    /// Locked file in the folder. The lock ends with the process, even if the process is killed.
    _held: File,
}

impl Scratch {
    pub fn new() -> io::Result<Self> {
        Self::within(&std::env::temp_dir())
    }

    fn within(home: &Path) -> io::Result<Self> {
        let folder = tempfile::Builder::new().prefix(PREFIX).tempdir_in(home)?;
        let open = Folder::open(folder.path())?;
        let (begun, held) = (Path::new(".begun"), Path::new(HELD));
        let file = open.create(begun)?;
        file.lock()?;
        open.replace(begun, held)?;
        let scratch = Self { folder, _held: file };
        scratch.remove_stale(home);
        Ok(scratch)
    }

    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    pub fn part(&self) -> io::Result<TempDir> {
        tempfile::Builder::new().prefix("part-").tempdir_in(self.path())
    }

    fn remove_stale(&self, home: &Path) {
        for path in stale(home, self.path()).unwrap_or_default() {
            let _ = fs::remove_dir_all(path);
        }
    }
}

fn stale(home: &Path, own: &Path) -> io::Result<Vec<PathBuf>> {
    let mine = fs::symlink_metadata(own)?;
    let mut found = Vec::new();
    for entry in fs::read_dir(home)?.flatten() {
        let path = entry.path();
        let is_scratch = entry.file_name().to_string_lossy().starts_with(PREFIX);
        let about = entry.metadata().ok().filter(|about| about.is_dir());
        let Some(about) = about.filter(|about| is_scratch && has_owner_of(about, &mine)) else {
            continue;
        };
        let is_old = || about.modified().ok()?.elapsed().ok().map(|age| age > BEGINNING);
        let is_stale =
            match Folder::find(&path).and_then(|folder| folder.is_unlocked(HELD.as_ref())) {
                Err(error) if error.kind() == io::ErrorKind::NotFound => is_old().unwrap_or(false),
                asked => asked.unwrap_or(false),
            };
        if is_stale {
            found.push(path);
        }
    }
    Ok(found)
}

#[cfg(unix)]
fn has_owner_of(a: &fs::Metadata, b: &fs::Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    a.uid() == b.uid()
}

#[cfg(not(unix))]
fn has_owner_of(_: &fs::Metadata, _: &fs::Metadata) -> bool {
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(home: &Path) -> usize {
        fs::read_dir(home).unwrap().count()
    }

    #[test]
    fn scratch_folder_is_deleted_by_its_owner_or_a_later_run() {
        let home = tempfile::tempdir().unwrap();
        let living = Scratch::within(home.path()).unwrap();
        fs::create_dir(living.path().join("deep")).unwrap();
        let Scratch { folder, _held } = Scratch::within(home.path()).unwrap();
        fs::write(folder.path().join("big"), "left behind").unwrap();
        let left = folder.keep();
        drop(_held);
        fs::create_dir(home.path().join("withy-scratch-begun")).unwrap();
        fs::write(home.path().join("withy-scratch-file"), "").unwrap();
        let next = Scratch::within(home.path()).unwrap();
        assert!(!left.exists() && living.path().join("deep").exists());
        assert_eq!(names(home.path()), 4);
        drop((living, next));
        assert_eq!(names(home.path()), 2);
    }
}

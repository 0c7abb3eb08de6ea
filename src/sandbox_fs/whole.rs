//! Writes files atomically and durably, and keeps files of other programs under new names instead of replacing them.

use std::ffi::{OsStr, OsString};
use std::fs;
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use super::folder::Folder;
use super::reading;

pub(super) const TRIES: usize = 100;

/// Age from which an unlocked temporary file counts as abandoned; a younger one may not have been locked yet.
const ABANDONED: Duration = Duration::from_secs(60);

/// Complete file under a temporary name, removed when this value is dropped unless it was [renamed](Self::rename_to_final).
#[derive(Debug)]
pub struct Prepared {
    folder: Folder,
    partial: OsString,
    name: OsString,
}

impl Prepared {
    /// Gives the file its final name, replaces an existing file with this name, and writes the folder to disk.
    ///
    /// # Errors
    /// Fails if the file cannot be renamed, and nothing is then changed. Also fails after renaming if the folder cannot be written to disk.
    pub fn rename_to_final(self) -> io::Result<()> {
        self.folder.0.rename(&self.partial, &self.name)?;
        self.folder.sync()
    }
}

impl Drop for Prepared {
    fn drop(&mut self) {
        // The error is ignored, because after `rename_to_final` no file has the temporary name.
        let _ = self.folder.0.remove_file(&self.partial);
    }
}

impl Folder {
    /// Writes a file below this folder atomically and durably, and creates missing parent folders.
    /// An existing file or link with the same name is replaced; the link is not followed.
    ///
    /// # Errors
    /// Fails if `name` is that of a folder, a pipe or a device, or if writing or renaming fails. Existing files are then unchanged.
    /// Also fails if the folder cannot be written to disk after the file has its final name.
    pub fn write_atomic(&self, name: &Path, bytes: &[u8]) -> io::Result<()> {
        self.prepare(name, |file| file.write_all(bytes))?.rename_to_final()
    }

    /// Writes a file under a temporary name by `write`. [`Prepared::rename_to_final`] then gives it the name `name`.
    pub fn prepare(
        &self,
        name: &Path,
        write: impl FnOnce(&mut fs::File) -> io::Result<()>,
    ) -> io::Result<Prepared> {
        let (folder, name) = self.parent_of(name, Self::enter_or_create)?;
        if let Ok(about) = folder.0.metadata(name)
            && !about.is_symlink()
        {
            reading::expect_ordinary(about.is_file())?;
        }
        let (mut file, partial) = folder.create_partial(name)?;
        let prepared = Prepared { folder, partial, name: name.to_owned() };
        write(&mut file)?;
        file.sync_all()?;
        Ok(prepared)
    }

    fn create_partial(&self, name: &OsStr) -> io::Result<(fs::File, OsString)> {
        static COUNTER: AtomicU64 = AtomicU64::new(0);
        let mut tries = TRIES;
        loop {
            tries -= 1;
            let count = COUNTER.fetch_add(1, Ordering::Relaxed);
            let mut partial = OsString::from(".");
            partial.push(name);
            partial.push(format!(".{}-{count}.part", process_id()));
            match self.0.create_file(&partial) {
                Ok(file) => {
                    // The file remains unlocked on a file system without locks, where no temporary file counts as abandoned.
                    let _ = file.try_lock();
                    return Ok((file, partial));
                }
                Err(error) if error.kind() == ErrorKind::AlreadyExists && tries > 0 => (),
                Err(error) => return Err(error),
            }
        }
    }

    pub fn remove_abandoned(&self, name: &Path) {
        let Ok((folder, _)) = self.parent_of(name, Self::enter) else { return };
        for entry in folder.entries().unwrap_or_default() {
            let is_old = || {
                let age = entry.changed.and_then(|changed| changed.elapsed().ok());
                age.is_some_and(|age| age > ABANDONED)
            };
            let name = Path::new(&entry.name);
            if is_partial(&entry.name) && is_old() && folder.is_unlocked(name).unwrap_or(false) {
                // The error is ignored, because another process may have removed the file already.
                let _ = folder.remove(name);
            }
        }
    }

    pub fn keep_as(&self, name: &Path, free: impl Fn(usize) -> PathBuf) -> io::Result<PathBuf> {
        let (folder, own) = self.parent_of(name, Self::enter)?;
        for number in 1..TRIES * TRIES {
            let new = free(number);
            let Some(kept) = new.file_name() else { break };
            // An empty file reserves the new name, so that no other file is replaced.
            match folder.0.create_file(kept) {
                Ok(_) => {
                    folder.0.rename(own, kept)?;
                    folder.sync()?;
                    return Ok(new);
                }
                Err(error) if error.kind() == ErrorKind::AlreadyExists => (),
                Err(error) => return Err(error),
            }
        }
        Err(io::Error::new(ErrorKind::AlreadyExists, "no unused file name was found for the copy"))
    }

    pub fn restore_name(&self, kept: &Path, name: &Path) -> io::Result<()> {
        let (folder, own) = self.parent_of(name, Self::enter)?;
        let (_, kept) = self.parent_of(kept, Self::enter)?;
        match folder.0.metadata(own) {
            Ok(_) => Err(ErrorKind::AlreadyExists.into()),
            Err(_) => folder.0.rename(kept, own),
        }
    }
}

fn process_id() -> u32 {
    if cfg!(target_family = "wasm") { 0 } else { std::process::id() }
}

/// Returns true if `name` is the name of a temporary file: `.NAME.PROCESS-COUNT.part`.
fn is_partial(name: &OsStr) -> bool {
    let middle = || name.to_str()?.strip_prefix('.')?.strip_suffix(".part")?.rsplit_once('.');
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let numbers = middle().and_then(|(_, numbers)| numbers.split_once('-'));
    numbers.is_some_and(|(process, count)| is_number(process) && is_number(count))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::SystemTime;

    #[test]
    fn dropped_prepared_file_leaves_the_folder_unchanged() {
        let home = tempfile::tempdir().unwrap();
        let folder = Folder::open(home.path()).unwrap();
        folder.write_atomic(Path::new("a"), b"old").unwrap();
        drop(folder.prepare(Path::new("a"), |file| file.write_all(b"new")).unwrap());
        let full = |_: &mut fs::File| Err(ErrorKind::StorageFull.into());
        assert!(folder.prepare(Path::new("a"), full).is_err());
        assert_eq!(folder.entries().unwrap().len(), 1);
        assert_eq!(fs::read(home.path().join("a")).unwrap(), b"old");
        folder
            .prepare(Path::new("a"), |file| file.write_all(b"new"))
            .unwrap()
            .rename_to_final()
            .unwrap();
        assert_eq!(fs::read(home.path().join("a")).unwrap(), b"new");
    }

    #[test]
    fn only_abandoned_partial_files_are_removed() {
        let home = tempfile::tempdir().unwrap();
        let folder = Folder::open(home.path()).unwrap();
        let long_ago = SystemTime::now() - 2 * ABANDONED;
        let lay = |name: &str, changed| {
            let file = fs::File::create(home.path().join(name)).unwrap();
            file.set_modified(changed).unwrap();
            file
        };
        let held = lay(".b.csv.17-1.part", long_ago);
        held.lock().unwrap();
        for name in [".a.csv.17-0.part", "a.csv", ".a.part", "sw.1-of-4.part", ".sw.1-of-4.part"] {
            lay(name, long_ago);
        }
        lay(".c.csv.17-2.part", SystemTime::now());
        folder.remove_abandoned(Path::new("a.csv"));
        let left: Vec<_> = folder.entries().unwrap().into_iter().map(|entry| entry.name).collect();
        let others = [
            ".a.part",
            ".b.csv.17-1.part",
            ".c.csv.17-2.part",
            ".sw.1-of-4.part",
            "a.csv",
            "sw.1-of-4.part",
        ];
        assert_eq!(left, others);
    }

    #[test]
    fn kept_file_regains_its_name_unless_it_is_in_use() {
        let home = tempfile::tempdir().unwrap();
        let folder = Folder::open(home.path()).unwrap();
        folder.write_atomic(Path::new("a"), b"theirs").unwrap();
        let kept = folder.keep_as(Path::new("a"), |number| format!("a.{number}").into()).unwrap();
        folder.restore_name(&kept, Path::new("a")).unwrap();
        assert_eq!(fs::read(home.path().join("a")).unwrap(), b"theirs");
        let kept = folder.keep_as(Path::new("a"), |number| format!("a.{number}").into()).unwrap();
        folder.write_atomic(Path::new("a"), b"new").unwrap();
        assert!(folder.restore_name(&kept, Path::new("a")).is_err());
        assert_eq!(fs::read(home.path().join("a")).unwrap(), b"new");
    }
}

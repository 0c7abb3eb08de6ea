//! Files are written whole or not at all.
//!
//! The bytes go to a hidden file beside the target, which takes the target's name only when it is complete. A reader
//! never sees half a file, and a failure leaves an older file as it was.

use std::{
    fs, io,
    path::{Path, PathBuf},
    sync::atomic::{AtomicU64, Ordering},
};

use super::OutputError;

/// Writes `bytes` to `path`, making missing folders on the way.
pub fn write_whole(path: impl AsRef<Path>, bytes: &[u8]) -> Result<(), OutputError> {
    let path = path.as_ref();
    if path.is_dir() {
        return Err(OutputError::NotAFile { path: path.into() });
    }
    let partial = partial_name(path)?;
    make_folder_of(path)?;

    fs::write(&partial, bytes).and_then(|()| fs::rename(&partial, path)).map_err(|source| {
        forget(&partial);
        OutputError::Write { path: path.into(), source }
    })
}

/// A hidden name in the folder of `path` that no other writer uses.
fn partial_name(path: &Path) -> Result<PathBuf, OutputError> {
    static COUNTER: AtomicU64 = AtomicU64::new(0);
    let name = path.file_name().ok_or_else(|| OutputError::NotAFile { path: path.into() })?;
    let count = COUNTER.fetch_add(1, Ordering::Relaxed);
    Ok(path.with_file_name(format!(
        ".{}.{}-{count}.part",
        name.to_string_lossy(),
        std::process::id()
    )))
}

fn make_folder_of(path: &Path) -> Result<(), OutputError> {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => {
            fs::create_dir_all(folder).map_err(|source| OutputError::Folder {
                folder: folder.into(),
                path: path.into(),
                source,
            })
        }
        _ => Ok(()),
    }
}

/// Removes what is left of a failed write. Its own failure is no news: there may be nothing to remove.
fn forget(partial: &Path) {
    let _: io::Result<()> = fs::remove_file(partial);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn makes_folders_and_replaces() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("a/b/c.txt");
        write_whole(&path, b"old").unwrap();
        write_whole(&path, b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(
            fs::read_dir(path.parent().unwrap()).unwrap().count(),
            1,
            "no partial file is left"
        );
    }

    #[test]
    fn a_file_where_a_folder_should_be_is_named() {
        let home = tempfile::tempdir().unwrap();
        let blocker = home.path().join("blocker");
        write_whole(&blocker, b"").unwrap();
        let message = write_whole(blocker.join("x.csv"), b"").unwrap_err().to_string();
        assert!(message.contains("blocker") && message.contains("choose a folder"), "{message}");
    }

    #[test]
    fn a_folder_is_not_a_file() {
        let home = tempfile::tempdir().unwrap();
        let error = write_whole(home.path(), b"").unwrap_err();
        assert!(matches!(error, OutputError::NotAFile { .. }), "{error}");
        assert!(matches!(write_whole("", b"").unwrap_err(), OutputError::NotAFile { .. }));
    }

    #[test]
    fn a_failed_write_leaves_nothing_behind() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("n".repeat(400));
        let error = write_whole(&path, b"x").unwrap_err();
        assert!(matches!(error, OutputError::Write { .. }), "{error}");
        assert_eq!(fs::read_dir(home.path()).unwrap().count(), 0);
    }
}

//! Atomic writing of files.
//!
//! A file is first written under a hidden name to the disk, and then renamed. It is never visible while it is incomplete.

use std::{fs, path::Path};

use super::OutputError;
use crate::sandbox_fs::Folder;

/// Writes `bytes` to a file at a path given by the user. Missing folders are created, and an existing file or link is replaced.
pub fn write_atomic(path: impl AsRef<Path>, bytes: &[u8]) -> Result<(), OutputError> {
    let path = path.as_ref();
    let not_a_file = || OutputError::NotAFile { path: path.into() };
    let name = path.file_name().ok_or_else(not_a_file)?;
    if fs::symlink_metadata(path).is_ok_and(|about| !about.is_file() && !about.is_symlink()) {
        return Err(not_a_file());
    }
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let opened = fs::create_dir_all(folder).and_then(|()| Folder::open(folder));
    let opened = opened.map_err(|source| OutputError::Folder {
        folder: folder.into(),
        path: path.into(),
        source,
    })?;
    opened
        .write_atomic(Path::new(name), bytes)
        .map_err(|source| OutputError::Write { path: path.into(), source })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn atomic_write_creates_folders_and_replaces_files() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("a/b/c.txt");
        write_atomic(&path, b"old").unwrap();
        write_atomic(&path, b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(
            fs::read_dir(path.parent().unwrap()).unwrap().count(),
            1,
            "no partial file is left"
        );
    }

    #[test]
    fn file_in_place_of_a_folder_is_reported_by_name() {
        let home = tempfile::tempdir().unwrap();
        let blocker = home.path().join("blocker");
        write_atomic(&blocker, b"").unwrap();
        let message = write_atomic(blocker.join("x.csv"), b"").unwrap_err().to_string();
        assert!(
            message.contains("blocker") && message.contains("choose a writable folder"),
            "{message}"
        );
    }

    #[test]
    fn writing_to_a_folder_path_is_rejected() {
        let home = tempfile::tempdir().unwrap();
        let error = write_atomic(home.path(), b"").unwrap_err();
        assert!(matches!(error, OutputError::NotAFile { .. }), "{error}");
        assert!(matches!(write_atomic("", b"").unwrap_err(), OutputError::NotAFile { .. }));
    }

    #[test]
    fn failed_write_leaves_no_partial_file() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("n".repeat(400));
        let error = write_atomic(&path, b"x").unwrap_err();
        assert!(matches!(error, OutputError::Write { .. }), "{error}");
        assert_eq!(fs::read_dir(home.path()).unwrap().count(), 0);
    }
}

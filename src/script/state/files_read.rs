//! Record of the files that a run has read, for the detection of later changes.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::SystemTime;

/// Files that a run has read or searched, with their states at that time. Clones, also in other threads, share the record.
#[derive(Clone, Debug, Default)]
pub struct FilesRead(Arc<Mutex<BTreeMap<PathBuf, FileState>>>);

/// Time of the last change and size of a file; `None` if there is no such file, or if the system does not provide them.
type FileState = Option<(SystemTime, u64)>;

fn state_of(path: &Path) -> FileState {
    let data = path.metadata().ok()?;
    Some((data.modified().ok()?, data.len()))
}

impl FilesRead {
    /// Records the state of a file before its first reading.
    pub fn record(&self, path: PathBuf) {
        let state = state_of(&path);
        self.lock().entry(path).or_insert(state);
    }

    /// Removes files from the record, for example those that the run has written.
    pub fn remove(&self, paths: &[PathBuf]) {
        self.lock().retain(|path, _| !paths.contains(path));
    }

    /// First file, in alphabetical order, that has changed since its recording.
    pub fn changed(&self) -> Option<PathBuf> {
        let files = self.lock();
        let changed = files.iter().find(|(path, state)| state_of(path) != **state);
        changed.map(|(path, _)| path.clone())
    }

    fn lock(&self) -> MutexGuard<'_, BTreeMap<PathBuf, FileState>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn changes_of_read_files_are_reported() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let [there, missing] = ["there", "missing"].map(|name| folder.path().join(name));
        fs::write(&there, "one").expect("a file");
        let record = || {
            let files = FilesRead::default();
            [&there, &missing].into_iter().for_each(|path| files.record(path.clone()));
            files
        };
        let files = record();
        assert_eq!(files.changed(), None);
        fs::write(&there, "longer").expect("a file");
        files.record(there.clone());
        assert_eq!(files.changed(), Some(there.clone()), "the first state counts");
        files.remove(std::slice::from_ref(&there));
        assert_eq!(files.changed(), None);
        fs::write(&missing, "new").expect("a file");
        assert_eq!(files.changed(), Some(missing.clone()));
        let files = record();
        fs::remove_file(&there).expect("a file");
        assert_eq!(files.changed(), Some(there));
    }
}

//! Reads the files of attempts, which may have any content.

use std::io::ErrorKind;
use std::path::Path;

use crate::sandbox_fs::Folder;
use crate::script::diagnose::Diagnostic;
use crate::script::source::program::Program;

/// Maximum size of the file of an attempt [bytes].
pub const LARGEST: u64 = 1 << 20;

/// Reads an attempt from a file in the given folder.
pub fn load(path: &Path, folder: &Path) -> Result<Program, Diagnostic> {
    let refused = |why: &str| {
        let message = format!("cannot read the attempt '{}': {why}", path.display());
        Diagnostic::general(message).with_hint("an attempt must be a regular text file")
    };
    let below = path.strip_prefix(folder).unwrap_or(path);
    let content = Folder::open(folder).and_then(|folder| folder.read(below, LARGEST));
    let content = content.map_err(|error| match error.kind() {
        ErrorKind::NotFound => refused("the file does not exist"),
        _ => refused(&error.to_string()),
    });
    Ok(Program::from_bytes(path, content?)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn attempts_are_read_only_from_regular_files_of_limited_size() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str| folder.path().join(name);
        fs::write(file("mine.rhai"), "let a = 1;").unwrap();
        assert!(load(&file("mine.rhai"), folder.path()).is_ok());
        fs::write(file("large.rhai"), vec![b' '; 2 << 20]).unwrap();
        fs::create_dir(file("folder.rhai")).unwrap();
        for name in ["large.rhai", "folder.rhai", "none.rhai"] {
            assert!(load(&file(name), folder.path()).is_err(), "{name}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn attempts_that_are_symbolic_links_are_rejected() {
        use std::os::unix::fs::symlink;
        let (folder, other) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        let theirs = other.path().join("theirs.rhai");
        fs::write(&theirs, "let a = 1;").unwrap();
        for (name, target) in
            [("link.rhai", theirs.as_path()), ("zero.rhai", Path::new("/dev/zero"))]
        {
            let link = folder.path().join(name);
            symlink(target, &link).unwrap();
            assert!(load(&link, folder.path()).is_err(), "{name}");
        }
    }
}

//! Files that a script writes: inside the output folder only, each whole or not at all.

use std::cell::RefCell;
use std::path::{Component, Path, PathBuf};

use super::context::Mode;
use super::error::ScriptError;
use crate::output::{OutputError, write_whole};

/// The folder that a script may write into. It is made when the first file is written.
pub struct OutputFolder {
    folder: PathBuf,
    mode: Mode,
    written: RefCell<Vec<PathBuf>>,
}

impl OutputFolder {
    pub(super) fn new(folder: PathBuf, mode: Mode) -> Self {
        Self { folder, mode, written: RefCell::default() }
    }

    /// Writes the file `name` of the output folder and gives its path. A dry build only checks the name.
    pub fn write(&self, name: &str, content: &[u8]) -> Result<PathBuf, ScriptError> {
        let path = self.path_of(name)?;
        if self.mode == Mode::DryBuild {
            return Ok(path);
        }
        write_whole(&path, content).map_err(|error| self.refused(error))?;
        let mut written = self.written.borrow_mut();
        if !written.contains(&path) {
            written.push(path.clone());
        }
        Ok(path)
    }

    /// The files written so far.
    pub fn written(&self) -> Vec<PathBuf> {
        self.written.borrow().clone()
    }

    fn path_of(&self, name: &str) -> Result<PathBuf, ScriptError> {
        let inside = Path::new(name).components().all(|part| matches!(part, Component::Normal(_)));
        if name.is_empty() || !inside {
            return Err(ScriptError::new(format!(
                "\"{name}\" is not the name of a file in the output folder"
            ))
            .hint("give a plain name such as \"motion.svg\"; --out chooses the folder"));
        }
        Ok(self.folder.join(name))
    }

    fn refused(&self, error: OutputError) -> ScriptError {
        ScriptError::new(format!(
            "cannot write into the output folder '{}': {error}",
            self.folder.display()
        ))
        .hint("choose another one with --out DIR")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn only_names_inside_the_folder_are_written() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let output = OutputFolder::new(folder.path().join("out"), Mode::Run);
        for name in ["", "/etc/motion.svg", "../motion.svg", "a/../../b"] {
            assert!(output.write(name, b"x").is_err(), "{name}");
        }
        assert!(!folder.path().join("out").exists());
        let path = output.write("plots/motion.svg", b"x").expect("a plain name");
        assert_eq!(fs::read(&path).expect("the file"), b"x");
        assert_eq!(output.written(), [path]);
    }

    #[test]
    fn a_folder_that_cannot_be_made_is_named() {
        let file = tempfile::NamedTempFile::new().expect("a temporary file");
        let output = OutputFolder::new(file.path().join("out"), Mode::Run);
        let Err(ScriptError::Failure(failure)) = output.write("a.csv", b"") else {
            panic!("must be refused")
        };
        assert!(failure.message.contains("output folder"), "{}", failure.message);
    }
}

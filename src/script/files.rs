//! Files of a script: written inside the output folder only, each whole or not at all; read there or beside the script.

use std::cell::RefCell;
use std::collections::HashMap;
use std::fs;
use std::path::{Component, Path, PathBuf};

use super::context::Mode;
use super::error::ScriptError;
use crate::output::{OutputError, write_whole};

/// Most bytes of a file that a script reads.
const LARGEST_INPUT: u64 = 1 << 30;

/// The folder that a script may write into. It is made when the first file is written.
pub struct OutputFolder {
    folder: PathBuf,
    /// The folder of the script, where it may read.
    beside: PathBuf,
    mode: Mode,
    written: RefCell<Vec<PathBuf>>,
    /// What a dry build would have written to read it again.
    pretended: RefCell<HashMap<PathBuf, Vec<u8>>>,
}

impl OutputFolder {
    pub(super) fn new(folder: PathBuf, beside: PathBuf, mode: Mode) -> Self {
        Self { folder, beside, mode, written: RefCell::default(), pretended: RefCell::default() }
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

    /// Writes a file that the script may [`read`](Self::read) again, which a dry build then can too.
    pub fn write_to_read(&self, name: &str, content: Vec<u8>) -> Result<PathBuf, ScriptError> {
        let path = self.write(name, &content)?;
        if self.mode == Mode::DryBuild {
            self.pretended.borrow_mut().insert(path.clone(), content);
        }
        Ok(path)
    }

    /// Reads the file `name` of the output folder or, where there is none, of the folder of the script.
    pub fn read(&self, name: &str) -> Result<Vec<u8>, ScriptError> {
        let path = self.path_of(name)?;
        if let Some(content) = self.pretended.borrow().get(&path) {
            return Ok(content.clone());
        }
        for folder in [&self.folder, &self.beside] {
            if let Some(content) = read_inside(folder, name)? {
                return Ok(content);
            }
        }
        let (out, beside) = (self.folder.display(), self.beside.display());
        let told = format!(
            "there is no file \"{name}\" in the output folder '{out}' or beside the script in '{beside}'"
        );
        Err(ScriptError::new(told).hint(match self.mode {
            Mode::Run => "check the name; --out chooses the output folder",
            Mode::DryBuild => "run the script that writes it first; a check writes nothing",
        }))
    }

    /// The files written so far.
    pub fn written(&self) -> Vec<PathBuf> {
        self.written.borrow().clone()
    }

    /// The path of a file that may be written or read by a plain name.
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

/// The content of a file that is in a folder, also after links were followed; none when there is no such file.
fn read_inside(folder: &Path, name: &str) -> Result<Option<Vec<u8>>, ScriptError> {
    let (Ok(folder), Ok(path)) = (folder.canonicalize(), folder.join(name).canonicalize()) else {
        return Ok(None);
    };
    let refused = |why: String| ScriptError::new(format!("cannot read \"{name}\": {why}"));
    if !path.starts_with(&folder) {
        return Err(refused(format!("it is a link that leads out of '{}'", folder.display()))
            .hint("copy the file to there"));
    }
    let about = fs::metadata(&path).map_err(|error| refused(error.to_string()))?;
    if !about.is_file() {
        return Err(refused("it is not a file".to_owned()));
    }
    if about.len() > LARGEST_INPUT {
        return Err(refused(format!(
            "it has {} bytes, and at most {LARGEST_INPUT} are read",
            about.len()
        )));
    }
    fs::read(&path).map(Some).map_err(|error| refused(error.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_names_inside_the_folder_are_written() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let output = OutputFolder::new(folder.path().join("out"), ".".into(), Mode::Run);
        for name in ["", "/etc/motion.svg", "../motion.svg", "a/../../b"] {
            assert!(output.write(name, b"x").is_err(), "{name}");
            assert!(output.read(name).is_err(), "{name}");
        }
        assert!(!folder.path().join("out").exists());
        let path = output.write("plots/motion.svg", b"x").expect("a plain name");
        assert_eq!(fs::read(&path).expect("the file"), b"x");
        assert_eq!(output.written(), [path]);
    }

    #[test]
    fn a_folder_that_cannot_be_made_is_named() {
        let file = tempfile::NamedTempFile::new().expect("a temporary file");
        let output = OutputFolder::new(file.path().join("out"), ".".into(), Mode::Run);
        let Err(ScriptError::Failure(failure)) = output.write("a.csv", b"") else {
            panic!("must be refused")
        };
        assert!(failure.message.contains("output folder"), "{}", failure.message);
    }

    fn message(refused: Result<Vec<u8>, ScriptError>) -> String {
        match refused {
            Err(ScriptError::Failure(failure)) => failure.message,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn files_are_read_from_the_output_folder_then_from_beside_the_script() {
        let home = tempfile::tempdir().expect("a temporary folder");
        let (out, beside) = (home.path().join("out"), home.path().join("scripts"));
        fs::create_dir(&beside).expect("a folder");
        fs::write(beside.join("run"), b"beside").expect("a file");
        let output = OutputFolder::new(out.clone(), beside.clone(), Mode::Run);
        assert_eq!(output.read("run").expect("the file beside"), b"beside");
        output.write("run", b"in out").expect("a file");
        assert_eq!(output.read("run").expect("the file in the folder"), b"in out");
        assert!(message(output.read("walk")).contains("no file \"walk\""));
        fs::create_dir(out.join("folder")).expect("a folder");
        assert!(message(output.read("folder")).contains("not a file"));
    }

    #[cfg(unix)]
    #[test]
    fn links_that_lead_out_are_not_followed() {
        let home = tempfile::tempdir().expect("a temporary folder");
        let out = home.path().join("out");
        fs::create_dir(&out).expect("a folder");
        fs::write(home.path().join("secret"), b"secret").expect("a file");
        std::os::unix::fs::symlink(home.path().join("secret"), out.join("link")).expect("a link");
        std::os::unix::fs::symlink(home.path(), out.join("up")).expect("a link");
        let output = OutputFolder::new(out, home.path().join("scripts"), Mode::Run);
        for name in ["link", "up/secret"] {
            assert!(message(output.read(name)).contains("leads out"), "{name}");
        }
    }

    #[test]
    fn a_dry_build_reads_what_it_would_have_written() {
        let home = tempfile::tempdir().expect("a temporary folder");
        let output = OutputFolder::new(home.path().join("out"), home.path().into(), Mode::DryBuild);
        output.write_to_read("run", b"pretended".to_vec()).expect("a plain name");
        assert_eq!(output.read("run").expect("what was pretended"), b"pretended");
        assert!(!home.path().join("out").exists());
        assert!(message(output.read("walk")).contains("no file"));
    }
}

//! Files of a script. It reads below its own folder and the output folder, and writes below the output folder, each
//! file whole or not at all. Symbolic links do not lead out.

use std::cell::RefCell;
use std::collections::HashMap;
use std::path::{Component, Path, PathBuf};
use std::{fs, io};

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
        if let Some(content) = self.pretended.borrow().get(&self.folder.join(name)) {
            return Ok(content.clone());
        }
        let folders =
            [("output folder", self.folder.clone()), ("script's own folder", self.beside.clone())];
        let path = InputFolders::new(folders).find(name).map_err(|error| match self.mode {
            Mode::Run => error,
            Mode::DryBuild => {
                error.hint("run the script that writes it first; a check writes nothing")
            }
        })?;
        let refused = |why: String| ScriptError::new(format!("cannot read \"{name}\": {why}"));
        let about = fs::metadata(&path).map_err(|error| refused(error.to_string()))?;
        match about.len() {
            _ if !about.is_file() => Err(refused("it is not a file".to_owned())),
            bytes if bytes > LARGEST_INPUT => {
                Err(refused(format!("it has {bytes} bytes, and at most {LARGEST_INPUT} are read")))
            }
            _ => fs::read(&path).map_err(|error| refused(error.to_string())),
        }
    }

    /// The files written so far.
    pub fn written(&self) -> Vec<PathBuf> {
        self.written.borrow().clone()
    }

    /// The folder itself, which need not exist yet.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// The path of the file `name` of the output folder.
    ///
    /// # Errors
    /// When the name leads out of the folder.
    pub fn path_of(&self, name: &str) -> Result<PathBuf, ScriptError> {
        let path = self.folder.join(name);
        if !is_plain(name) || !self.stays_inside(&path) {
            return Err(ScriptError::new(format!(
                "\"{name}\" is not the name of a file in the output folder"
            ))
            .hint("give a plain name such as \"motion.svg\"; --out chooses the folder"));
        }
        Ok(path)
    }

    /// Whether the folder of `path`, as far as it exists, really lies in this one. A link in the place of the file
    /// itself does no harm: it is replaced, not followed.
    fn stays_inside(&self, path: &Path) -> bool {
        let above = path.ancestors().skip(1).take_while(|folder| folder.starts_with(&self.folder));
        match above.map(Path::canonicalize).find(|real| !is_missing(real)) {
            Some(Ok(real)) => self.folder.canonicalize().is_ok_and(|own| real.starts_with(own)),
            Some(Err(_)) => false,
            None => true,
        }
    }

    fn refused(&self, error: OutputError) -> ScriptError {
        ScriptError::new(format!(
            "cannot write into the output folder '{}': {error}",
            self.folder.display()
        ))
        .hint("choose another one with --out DIR")
    }
}

/// Whether a folder or file does not exist; a link that leads nowhere is no folder.
fn is_missing(real: &io::Result<PathBuf>) -> bool {
    real.as_ref().is_err_and(|error| error.kind() == io::ErrorKind::NotFound)
}

/// Whether `name` goes down only: no root, no `..`.
fn is_plain(name: &str) -> bool {
    let mut parts = Path::new(name).components();
    !name.is_empty() && parts.all(|part| matches!(part, Component::Normal(_)))
}

/// The folders that a script may read from, each with a word for it.
pub struct InputFolders(Vec<(&'static str, PathBuf)>);

impl InputFolders {
    /// Folders in the order in which a file is looked for.
    pub fn new(folders: impl IntoIterator<Item = (&'static str, PathBuf)>) -> Self {
        Self(folders.into_iter().collect())
    }

    /// The real path of the file `name`, from the first folder that has it.
    ///
    /// # Errors
    /// When no folder has it, or a link or the name itself leads out of the folders.
    pub fn find(&self, name: &str) -> Result<PathBuf, ScriptError> {
        let words: Vec<_> =
            self.0.iter().map(|(word, path)| format!("the {word} '{}'", path.display())).collect();
        let allowed = words.join(" and ");
        if !is_plain(name) {
            return Err(ScriptError::new(format!("\"{name}\" leads out of {allowed}"))
                .hint("give a name without .. and without a / at its beginning"));
        }
        for (_, folder) in &self.0 {
            let (Ok(real), Ok(own)) = (folder.join(name).canonicalize(), folder.canonicalize())
            else {
                continue;
            };
            return match real.starts_with(own) {
                true => Ok(real),
                false => Err(ScriptError::new(format!("\"{name}\" is a link out of {allowed}"))
                    .hint("put the file itself there")),
            };
        }
        Err(ScriptError::new(format!("there is no file \"{name}\" in {allowed}"))
            .hint("check the name, which is relative to these folders"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    #[test]
    fn links_do_not_lead_out() {
        use std::os::unix::fs::symlink;
        let home = tempfile::tempdir().expect("a temporary folder");
        let (own, other) = (home.path().join("own"), home.path().join("other"));
        fs::create_dir_all(&own).expect("a folder");
        fs::create_dir_all(&other).expect("a folder");
        fs::write(other.join("secret.txt"), "secret").expect("a file");
        symlink(&other, own.join("way")).expect("a link");
        symlink(other.join("secret.txt"), own.join("file.txt")).expect("a link");
        symlink(other.join("new.txt"), own.join("nowhere.txt")).expect("a link");

        let inputs = InputFolders::new([("script's own folder", own.clone())]);
        for name in ["way/secret.txt", "file.txt"] {
            assert!(inputs.find(name).is_err(), "{name}");
        }
        let output = OutputFolder::new(own.clone(), PathBuf::from("."), Mode::Run);
        assert!(output.write("way/a.txt", b"x").is_err());
        assert!(output.write("way/deep/a.txt", b"x").is_err());
        output.write("nowhere.txt", b"x").expect("the link is replaced");
        assert!(!other.join("new.txt").exists() && !other.join("a.txt").exists());
    }

    #[test]
    fn files_are_found_in_the_first_folder_that_has_them() {
        let home = tempfile::tempdir().expect("a temporary folder");
        let (own, out) = (home.path().join("own"), home.path().join("out"));
        fs::create_dir_all(own.join("below")).expect("a folder");
        fs::create_dir_all(&out).expect("a folder");
        for file in [own.join("below/a"), out.join("b"), home.path().join("c")] {
            fs::write(file, "").expect("a file");
        }
        let inputs =
            InputFolders::new([("script's own folder", own.clone()), ("output folder", out)]);
        let real = own.canonicalize().expect("the folder");
        assert_eq!(inputs.find("below/a").expect("a file"), real.join("below/a"));
        assert!(inputs.find("b").is_ok());
        for name in ["c", "../c", "below/../../c", "/etc/passwd", "", "below/./../../c"] {
            let Err(ScriptError::Failure(failure)) = inputs.find(name) else {
                panic!("{name} must be refused")
            };
            assert!(failure.message.contains("script's own folder"), "{}", failure.message);
        }
    }

    #[test]
    fn only_names_inside_the_folder_are_written() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let output = OutputFolder::new(folder.path().join("out"), PathBuf::from("."), Mode::Run);
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
        let output = OutputFolder::new(file.path().join("out"), PathBuf::from("."), Mode::Run);
        let Err(ScriptError::Failure(failure)) = output.write("a.csv", b"") else {
            panic!("must be refused")
        };
        assert!(failure.message.contains("output folder"), "{}", failure.message);
    }
}

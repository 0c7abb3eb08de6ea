//! File access of scripts: reading in the folder of the script and in the output folder, writing in the output folder only.

use std::cell::{OnceCell, RefCell};
use std::collections::{HashMap, HashSet};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use super::files_read::FilesRead;
use super::settings::RunMode;
use crate::output::OutputError;
use crate::sandbox_fs::{ChecksumWriter, Folder, WrittenFiles, is_plain};
use crate::script::messages::error::ScriptError;

/// Maximum size of a file that a script reads [bytes].
const LARGEST_INPUT: u64 = 1 << 30;

/// Folder into which a script may write, created with the first file.
pub struct OutputFolder {
    folder: PathBuf,
    beside: PathBuf,
    mode: RunMode,
    written: RefCell<Vec<PathBuf>>,
    record: OnceCell<RefCell<WrittenFiles>>,
    tidied: RefCell<HashSet<Option<PathBuf>>>,
    pretended: RefCell<HashMap<PathBuf, Vec<u8>>>,
    read: FilesRead,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrittenFile {
    pub path: PathBuf,
    /// New path of an older file with the same name, written or changed by others; `None` if there was no such file.
    pub kept: Option<PathBuf>,
}

impl OutputFolder {
    pub(super) fn new(folder: PathBuf, beside: PathBuf, mode: RunMode) -> Self {
        Self {
            folder,
            beside,
            mode,
            written: RefCell::default(),
            record: OnceCell::new(),
            tidied: RefCell::default(),
            pretended: RefCell::default(),
            read: FilesRead::default(),
        }
    }

    pub(super) fn recording(self, read: FilesRead) -> Self {
        Self { read, ..self }
    }

    /// Writes the file `name` in the output folder. A dry run only checks the name.
    pub fn write(&self, name: &str, content: &[u8]) -> Result<WrittenFile, ScriptError> {
        self.write_by(name, |file| file.write_all(content))
    }

    /// Writes the file `name` in the output folder by `write`, which receives the writer. A dry run only checks the name.
    pub fn write_by(
        &self,
        name: &str,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<WrittenFile, ScriptError> {
        let path = self.path_of(name)?;
        if self.mode == RunMode::DryRun {
            return Ok(WrittenFile { path, kept: None });
        }
        let kept = self.open_folder(name, write).map_err(|source| {
            self.refused(match source.kind() {
                ErrorKind::InvalidInput => OutputError::NotAFile { path: path.clone() },
                _ => OutputError::Write { path: path.clone(), source },
            })
        })?;
        let mut written = self.written.borrow_mut();
        if !written.contains(&path) {
            written.push(path.clone());
        }
        Ok(WrittenFile { path, kept })
    }

    /// Writes a file after opening the output folder, which is opened again for each file, because it may be moved during a session.
    /// Returns the new path of an older file of others with the same name; `None` if there was no such file.
    fn open_folder(
        &self,
        name: &str,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> io::Result<Option<PathBuf>> {
        let folder = Folder::open_or_create(&self.folder)?;
        let record = self.record.get_or_init(|| RefCell::new(WrittenFiles::of(&folder)));
        let mut record = record.borrow_mut();
        let path = Path::new(name);
        if self.tidied.borrow_mut().insert(path.parent().map(Path::to_owned)) {
            folder.remove_abandoned(path);
        }
        let mut written = None;
        let prepared = folder.prepare(path, |file| {
            let mut file = ChecksumWriter::new(BufWriter::new(file));
            write(&mut file)?;
            file.flush()?;
            written = Some(file.checksum());
            Ok(())
        })?;
        let is_ours = record.may_replace(&folder, name);
        written.map_or(Ok(()), |written| record.record(&folder, name, written))?;
        let kept = if is_ours {
            None
        } else {
            Some(folder.keep_as(path, |number| kept_name(path, number))?)
        };
        if let Err(error) = prepared.rename_to_final() {
            return Err(match &kept {
                Some(kept) if folder.restore_name(kept, path).is_err() => {
                    let kept = self.folder.join(kept);
                    let message =
                        format!("{error}; what was there is kept as '{}'", kept.display());
                    io::Error::new(error.kind(), message)
                }
                _ => error,
            });
        }
        Ok(kept.map(|kept| self.folder.join(kept)))
    }

    /// Writes a file that the script may [`read`](Self::read) later, also in a dry run.
    pub fn write_to_read(&self, name: &str, content: Vec<u8>) -> Result<WrittenFile, ScriptError> {
        let written = self.write(name, &content)?;
        if self.mode == RunMode::DryRun {
            self.pretended.borrow_mut().insert(written.path.clone(), content);
        }
        Ok(written)
    }

    /// Reads the file `name` of at most `most` bytes in the output folder or, if it is not there, in the folder of the script.
    ///
    /// # Errors
    /// Fails if the name leads out of these folders, or if the file does not exist, is too large, or is not a regular file.
    pub fn read(&self, name: &str, most: Option<u64>) -> Result<Vec<u8>, ScriptError> {
        if let Some(content) = self.pretended.borrow().get(&self.folder.join(name)) {
            return Ok(content.clone());
        }
        let folders = [
            InputFolder { word: "output folder", path: self.folder.clone(), open: Folder::find },
            InputFolder::in_folder_of(&self.beside),
        ];
        let most = most.unwrap_or(LARGEST_INPUT).min(LARGEST_INPUT);
        InputFolders::new(folders).recording(self.read.clone()).read(name, most).map_err(|error| {
            match self.mode {
                RunMode::Run => error,
                RunMode::DryRun => {
                    error.hint("first run the script that writes it; a check writes no files")
                }
            }
        })
    }

    pub fn written(&self) -> Vec<PathBuf> {
        self.written.borrow().clone()
    }

    /// Path of the output folder. The folder need not exist yet.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    pub fn path_of(&self, name: &str) -> Result<PathBuf, ScriptError> {
        if !is_plain(Path::new(name)) {
            return Err(ScriptError::new(format!(
                "\"{name}\" is not the name of a file in the output folder"
            ))
            .hint("give a plain name such as \"motion.svg\"; --out sets the folder"));
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

fn kept_name(path: &Path, number: usize) -> PathBuf {
    let mut kept = path.as_os_str().to_owned();
    kept.push(match number {
        1 => ".kept".to_owned(),
        _ => format!(".kept-{number}"),
    });
    kept.into()
}

pub struct InputFolder {
    pub word: &'static str,
    pub path: PathBuf,
    pub open: fn(&Path) -> io::Result<Folder>,
}

impl InputFolder {
    pub fn in_folder_of(path: &Path) -> Self {
        Self { word: "script's own folder", path: path.to_owned(), open: Folder::open }
    }
}

pub struct InputFolders {
    folders: Vec<InputFolder>,
    read: FilesRead,
}

impl InputFolders {
    pub fn new(folders: impl IntoIterator<Item = InputFolder>) -> Self {
        Self { folders: folders.into_iter().collect(), read: FilesRead::default() }
    }

    pub fn recording(self, read: FilesRead) -> Self {
        Self { read, ..self }
    }

    /// Content of the file `name`, of at most `most` bytes, in the first folder that contains it.
    ///
    /// # Errors
    /// Fails if no folder contains the file, if the name or a link leads out of the folder, or if the file is too large or not regular.
    pub fn read(&self, name: &str, most: u64) -> Result<Vec<u8>, ScriptError> {
        let words = self
            .folders
            .iter()
            .map(|InputFolder { word, path, .. }| format!("the {word} '{}'", path.display()));
        let allowed = words.collect::<Vec<_>>().join(" and ");
        let path = Path::new(name);
        if !is_plain(path) {
            return Err(ScriptError::new(format!("\"{name}\" is outside of {allowed}"))
                .hint("give a name without .. and without a leading /"));
        }
        for folder in &self.folders {
            self.read.record(folder.path.join(path));
            match (folder.open)(&folder.path).and_then(|folder| folder.read(path, most)) {
                Ok(content) => return Ok(content),
                Err(error) if is_missing(&error) => (),
                Err(error) => {
                    return Err(ScriptError::new(format!(
                        "cannot read \"{name}\" from the {} '{}': {error}",
                        folder.word,
                        folder.path.display()
                    ))
                    .hint("the name must be that of an ordinary file"));
                }
            }
        }
        Err(ScriptError::new(format!("there is no file \"{name}\" in {allowed}"))
            .hint("check the name, which is relative to these folders"))
    }
}

fn is_missing(error: &io::Error) -> bool {
    matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[cfg(unix)]
    #[test]
    fn links_do_not_lead_outside_the_folders() {
        use std::os::unix::fs::symlink;
        let home = tempfile::tempdir().expect("a temporary folder");
        let (own, other) = (home.path().join("own"), home.path().join("other"));
        fs::create_dir_all(&own).expect("a folder");
        fs::create_dir_all(&other).expect("a folder");
        fs::write(other.join("secret.txt"), "secret").expect("a file");
        symlink(&other, own.join("way")).expect("a link");
        symlink(other.join("secret.txt"), own.join("file.txt")).expect("a link");
        symlink(other.join("new.txt"), own.join("nowhere.txt")).expect("a link");

        let inputs = InputFolders::new([InputFolder::in_folder_of(&own)]);
        for name in ["way/secret.txt", "file.txt"] {
            assert!(inputs.read(name, 100).is_err(), "{name}");
        }
        let output = OutputFolder::new(own.clone(), PathBuf::from("."), RunMode::Run);
        assert!(output.write("way/a.txt", b"x").is_err());
        assert!(output.write("way/deep/a.txt", b"x").is_err());
        let written = output.write("nowhere.txt", b"x").expect("the link is put aside");
        assert_eq!(written.kept, Some(own.join("nowhere.txt.kept")));
        assert!(!other.join("new.txt").exists() && !other.join("a.txt").exists());
    }

    #[test]
    fn files_are_found_in_the_first_folder_that_has_them() {
        let home = tempfile::tempdir().expect("a temporary folder");
        let (own, out) = (home.path().join("own"), home.path().join("out"));
        fs::create_dir_all(own.join("below")).expect("a folder");
        fs::create_dir_all(&out).expect("a folder");
        for file in [own.join("below/a"), out.join("b"), home.path().join("c")] {
            fs::write(file, "found").expect("a file");
        }
        let out = InputFolder { word: "output folder", path: out, open: Folder::find };
        let inputs = InputFolders::new([InputFolder::in_folder_of(&own), out]);
        assert_eq!(inputs.read("below/a", 10).expect("a file"), b"found");
        assert!(inputs.read("b", 10).is_ok());
        for name in ["c", "../c", "below/../../c", "/etc/passwd", "", "below/./../../c"] {
            let Err(ScriptError::Failure(failure)) = inputs.read(name, 10) else {
                panic!("{name} must be refused")
            };
            assert!(failure.message.contains("script's own folder"), "{}", failure.message);
        }
    }

    #[test]
    fn only_paths_inside_the_output_folder_are_written() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let output = OutputFolder::new(folder.path().join("out"), PathBuf::from("."), RunMode::Run);
        for name in ["", "/etc/motion.svg", "../motion.svg", "a/../../b"] {
            assert!(output.write(name, b"x").is_err(), "{name}");
        }
        assert!(!folder.path().join("out").exists());
        let path = output.write("plots/motion.svg", b"x").expect("a plain name").path;
        assert_eq!(fs::read(&path).expect("the file"), b"x");
        assert_eq!(output.written(), [path]);
    }

    #[test]
    fn output_folder_that_cannot_be_created_is_reported() {
        let file = tempfile::NamedTempFile::new().expect("a temporary file");
        let output = OutputFolder::new(file.path().join("out"), PathBuf::from("."), RunMode::Run);
        let Err(ScriptError::Failure(failure)) = output.write("a.csv", b"") else {
            panic!("must be refused")
        };
        assert!(failure.message.contains("output folder"), "{}", failure.message);
    }

    #[test]
    fn foreign_files_are_kept_and_own_files_are_replaced() {
        let out = tempfile::tempdir().expect("a temporary folder");
        let file = out.path().join("a.svg");
        fs::write(&file, "theirs").expect("a file");
        let run = || OutputFolder::new(out.path().into(), PathBuf::from("."), RunMode::Run);
        let kept = |content: &[u8]| run().write("a.svg", content).expect("a plain name").kept;
        assert_eq!(kept(b"one"), Some(out.path().join("a.svg.kept")));
        assert_eq!(kept(b"two"), None, "it was ours");
        fs::write(&file, "changed").expect("a file");
        assert_eq!(kept(b"three"), Some(out.path().join("a.svg.kept-2")));
        let content = |name: &str| fs::read_to_string(out.path().join(name)).expect("a file");
        assert_eq!(
            ["a.svg", "a.svg.kept", "a.svg.kept-2"].map(content),
            ["three", "theirs", "changed"]
        );
    }

    #[test]
    fn foreign_file_keeps_its_name_if_writing_fails() {
        let out = tempfile::tempdir().expect("a temporary folder");
        let file = out.path().join("a.csv");
        fs::write(&file, "theirs").expect("a file");
        let output = OutputFolder::new(out.path().into(), PathBuf::from("."), RunMode::Run);
        let full = |_: &mut dyn Write| Err(ErrorKind::StorageFull.into());
        assert!(output.write_by("a.csv", full).is_err());
        assert_eq!(fs::read_to_string(&file).expect("the file"), "theirs");
        assert_eq!(fs::read_dir(out.path()).expect("the folder").count(), 1);
    }

    #[cfg(unix)]
    #[test]
    fn output_folder_that_is_a_link_is_rejected() {
        let home = tempfile::tempdir().expect("a temporary folder");
        let (out, other) = (home.path().join("out"), home.path().join("other"));
        fs::create_dir(&other).expect("a folder");
        fs::write(other.join("secret"), "x").expect("a file");
        std::os::unix::fs::symlink(&other, &out).expect("a link");
        let output = OutputFolder::new(out, home.path().join("own"), RunMode::Run);
        for refused in
            [output.write("a.csv", b"x").map(drop), output.read("secret", None).map(drop)]
        {
            let Err(ScriptError::Failure(failure)) = refused else { panic!("must be refused") };
            assert!(failure.message.contains("'out' is a link"), "{}", failure.message);
        }
        assert_eq!(fs::read_dir(&other).expect("the folder").count(), 1);
    }
}

//! The text of a script and where it came from.

use std::path::{Path, PathBuf};

use super::text::Source;
use crate::sandbox_fs::read_file;

/// The largest script, or file that one imports [bytes]: more is data, and takes a lot of memory to be read as a script.
pub const LARGEST_SCRIPT: u64 = 16 << 20;

/// A script to be run: its name in messages, its text, and the folder that `import` looks in.
#[derive(Clone, Debug)]
pub struct Program {
    /// The name of the script in messages.
    pub name: String,
    /// The text of the script.
    pub text: Source,
    /// The folder in which the script's imports are found.
    pub folder: PathBuf,
}

/// Why a script cannot be read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{told}")]
pub struct Unreadable {
    /// What is wrong with which file, in words.
    pub told: String,
    /// What to do about a script that cannot be read.
    pub hint: String,
}

impl Program {
    /// A script that is not in a file.
    pub fn named(name: &str, text: &str) -> Self {
        Self { name: name.into(), text: text.into(), folder: PathBuf::from(".") }
    }

    /// Reads a script from a file.
    pub fn load(path: &Path) -> Result<Self, Unreadable> {
        let name = path.display().to_string();
        let refused = |why: String, hint: &str| Unreadable {
            told: format!("cannot read the script '{name}': {why}"),
            hint: hint.into(),
        };
        if path.is_dir() {
            return Err(refused("it is a folder".into(), "name a file that ends in .rhai"));
        }
        let bytes = read_file(path, LARGEST_SCRIPT).map_err(|error| {
            let why = match error.kind() {
                std::io::ErrorKind::NotFound => "there is no such file".into(),
                _ => error.to_string(),
            };
            refused(why, "check the path, relative to the folder you are in")
        })?;
        Self::from_bytes(path, bytes)
    }

    /// The script that a file holds, from its bytes.
    ///
    /// # Errors
    /// When it is not UTF-8.
    pub fn from_bytes(path: &Path, bytes: Vec<u8>) -> Result<Self, Unreadable> {
        let name = path.display().to_string();
        let text = String::from_utf8(bytes).map_err(|error| {
            let line = error.as_bytes()[..error.utf8_error().valid_up_to()]
                .split(|byte| *byte == b'\n')
                .count();
            let told = format!("cannot read the script '{name}': line {line} is not UTF-8 text");
            Unreadable { told, hint: "save the file as UTF-8".into() }
        })?;
        let folder =
            path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
        // A mark of byte order is no text, and a line for the shell is a comment here.
        let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
        let text =
            text.strip_prefix("#!").map_or_else(|| text.to_owned(), |rest| format!("// {rest}"));
        Ok(Self { name, text: text.into(), folder: folder.into() })
    }

    /// The byte offset of a line and column of the script, both from 1 and columns in characters.
    pub fn offset(&self, line: usize, column: usize) -> usize {
        self.text.offset(line, column)
    }
}

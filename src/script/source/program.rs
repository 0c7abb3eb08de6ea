//! Text of a script, with its name and folder.

use std::path::{Path, PathBuf};

use super::text::Source;
use crate::sandbox_fs::read_file;

/// Maximum size of a script or imported file [bytes]. Larger files are usually data, which would need much memory to parse.
pub const LARGEST_SCRIPT: u64 = 16 << 20;

/// Script: its name in messages, its text, and the folder of its imports.
#[derive(Clone, Debug)]
pub struct Program {
    /// Name of the script in messages.
    pub name: String,
    /// Text of the script.
    pub text: Source,
    /// Folder for imports.
    pub folder: PathBuf,
}

/// Error in reading a script.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{message}")]
pub struct Unreadable {
    /// Message that names the file.
    pub message: String,
    /// Suggestion for the user.
    pub hint: String,
}

impl Program {
    /// Creates a script that is not in a file.
    pub fn named(name: &str, text: &str) -> Self {
        Self { name: name.into(), text: text.into(), folder: PathBuf::from(".") }
    }

    /// Reads a script from a file.
    pub fn load(path: &Path) -> Result<Self, Unreadable> {
        let name = path.display().to_string();
        let refused = |why: String, hint: &str| Unreadable {
            message: format!("cannot read the script '{name}': {why}"),
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
            refused(why, "check the path, relative to the current folder")
        })?;
        Self::from_bytes(path, bytes)
    }

    /// Creates a script from the bytes of a file.
    ///
    /// # Errors
    /// Fails if the bytes are not UTF-8.
    pub fn from_bytes(path: &Path, bytes: Vec<u8>) -> Result<Self, Unreadable> {
        let name = path.display().to_string();
        let text = String::from_utf8(bytes).map_err(|error| {
            let line = error.as_bytes()[..error.utf8_error().valid_up_to()]
                .split(|byte| *byte == b'\n')
                .count();
            let message = format!("cannot read the script '{name}': line {line} is not UTF-8 text");
            Unreadable { message, hint: "save the file as UTF-8".into() }
        })?;
        Ok(Self::from_text(path, &text))
    }

    /// Creates a script from the text of a file.
    pub fn from_text(path: &Path, text: &str) -> Self {
        let name = path.display().to_string();
        let folder =
            path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
        // A first line `#!…` becomes a comment of the same length, so that columns are unchanged.
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let text = match text.strip_prefix("#!") {
            Some(rest) => match rest.strip_prefix(['/', '!']) {
                Some(rest) => format!("// {rest}"),
                None => format!("//{rest}"),
            },
            None => text.to_owned(),
        };
        Self { name, text: text.into(), folder: folder.into() }
    }

    /// Byte offset of a line and column, both counted from 1. Columns are counted in characters.
    pub fn offset(&self, line: usize, column: usize) -> usize {
        self.text.offset(line, column)
    }
}

//! Where the lines of earlier sessions are kept.

use std::ffi::OsString;
use std::path::PathBuf;

/// The variable of the environment that names the file of the history; empty for none.
pub const VARIABLE: &str = "WITHY_HISTORY";

/// The number of entries of the history that are kept.
pub const MOST_ENTRIES: usize = 5000;

/// The length of the longest entry of the history that is kept [bytes]: what is longer was pasted, and belongs into a file.
pub const LONGEST_ENTRY: usize = 64 << 10;

/// The file of the history: what `setting` names, nothing if it is empty, and without it a file in the user's folder for
/// the state of programs.
pub fn file(setting: Option<OsString>) -> Option<PathBuf> {
    match setting {
        Some(name) if name.is_empty() => None,
        Some(name) => Some(PathBuf::from(name)),
        None => {
            let folder = dirs::state_dir().or_else(dirs::data_local_dir)?;
            Some(folder.join("withy").join("history"))
        }
    }
}

/// Whether an entry is worth keeping in the history.
pub fn is_kept(entry: &str) -> bool {
    !entry.trim().is_empty() && entry.len() <= LONGEST_ENTRY
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_environment_chooses_the_file() {
        assert_eq!(file(Some("".into())), None);
        assert_eq!(file(Some("lines".into())), Some(PathBuf::from("lines")));
        assert!(file(None).is_none_or(|path| path.ends_with("withy/history")));
    }

    #[test]
    fn blank_and_enormous_entries_are_not_kept() {
        assert!(is_kept("let a = 1;"));
        assert!(!is_kept(" \n "));
        assert!(!is_kept(&"x".repeat(LONGEST_ENTRY + 1)));
    }
}

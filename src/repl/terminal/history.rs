//! File with the history of inputs.

use std::ffi::OsString;
use std::path::PathBuf;

/// Environment variable with the name of the history file. If it is empty, no history is stored.
pub const VARIABLE: &str = "WITHY_HISTORY";

pub const MOST_ENTRIES: usize = 5000;

/// Maximum length of a stored entry [bytes]. Longer inputs are usually pasted.
pub const LONGEST_ENTRY: usize = 64 << 10;

/// Path of the history file, by default in the user's state folder; `None` if `setting`, the value of
/// the environment variable, is empty, or if there is no such folder.
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

pub fn should_store(entry: &str) -> bool {
    !entry.trim().is_empty() && entry.len() <= LONGEST_ENTRY
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn history_file_is_set_by_the_environment() {
        assert_eq!(file(Some("".into())), None);
        assert_eq!(file(Some("lines".into())), Some(PathBuf::from("lines")));
        assert!(file(None).is_none_or(|path| path.ends_with("withy/history")));
    }

    #[test]
    fn blank_and_huge_history_entries_are_not_stored() {
        assert!(should_store("let a = 1;"));
        assert!(!should_store(" \n "));
        assert!(!should_store(&"x".repeat(LONGEST_ENTRY + 1)));
    }
}

//! Errors that concern the folder of a student or of a class.

use std::io;
use std::path::PathBuf;

use crate::output::OutputError;

#[derive(Debug, thiserror::Error)]
pub enum ExerciseError {
    #[error("there is no exercise '{name}'; {}", meant(.nearest.as_deref()))]
    Unknown { name: String, nearest: Option<String> },
    #[error(transparent)]
    Write(#[from] OutputError),
    #[error("cannot read '{}': {source}; check that you may read it", path.display())]
    Read { path: PathBuf, source: io::Error },
    #[error("cannot write the marks to '{}': {source}; give --marks the name of a writable file", path.display())]
    Marks { path: PathBuf, source: io::Error },
    #[error(
        "cannot use this terminal: {0}; 'withy learn watch | cat' prints the same as plain lines"
    )]
    Terminal(io::Error),
    #[error(
        "cannot create a folder for the output of attempts: {0}; set TMPDIR to a writable folder"
    )]
    Scratch(io::Error),
    #[error("cannot copy '{}' to '{}': {source}; nothing was changed", from.display(), to.display())]
    Keep { from: PathBuf, to: PathBuf, source: io::Error },
    #[error("'{}' is damaged ({why}); move it away to restart the record of progress; your attempts are kept", path.display())]
    Progress { path: PathBuf, why: serde_json::Error },
    #[error("'{}' has no submissions; it must contain a folder for each student, with folders such as '{track}'", path.display())]
    NoSubmissions { path: PathBuf, track: &'static str },
}

fn meant(nearest: Option<&str>) -> String {
    match nearest {
        Some(nearest) => {
            format!("did you mean '{nearest}'? 'withy learn list' lists all exercises")
        }
        None => "'withy learn list' shows all".into(),
    }
}

//! What can go wrong with the folder of a student or of a class.

use std::io;
use std::path::PathBuf;

use crate::output::OutputError;

/// Why a folder of exercises cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum ExerciseError {
    /// No exercise has this name.
    #[error("there is no exercise '{name}'; {}", meant(.nearest.as_deref()))]
    Unknown {
        /// What was asked for.
        name: String,
        /// The one that was probably meant.
        nearest: Option<String>,
    },
    /// A file could not be written.
    #[error(transparent)]
    Write(#[from] OutputError),
    /// A file could not be read.
    #[error("cannot read '{}': {source}; check that you may read it", path.display())]
    Read {
        /// The file or folder.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The file of the marks could not be written.
    #[error("cannot write the marks into '{}': {source}; --marks takes the name of a file that may be written", path.display())]
    Marks {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The terminal cannot be drawn on.
    #[error(
        "cannot go on with this terminal: {0}; 'withy learn watch | cat' tells the same in lines"
    )]
    Terminal(io::Error),
    /// There is no folder for what attempts write.
    #[error("cannot make a folder for what attempts write: {0}; TMPDIR says where it goes")]
    Scratch(io::Error),
    /// A file could not be renamed.
    #[error("cannot keep '{}' as '{}': {source}; nothing was changed", from.display(), to.display())]
    Keep {
        /// The file.
        from: PathBuf,
        /// The name that it was to get.
        to: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The file of the progress does not hold what this program wrote.
    #[error("'{}' is damaged ({why}); move it away to begin counting anew: your attempts stay", path.display())]
    Progress {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        why: serde_json::Error,
    },
    /// There is nothing to grade.
    #[error("'{}' holds no submissions; it should have one folder for each student, with folders such as '{track}' in it", path.display())]
    NoSubmissions {
        /// The folder.
        path: PathBuf,
        /// The name of a track.
        track: &'static str,
    },
}

fn meant(nearest: Option<&str>) -> String {
    match nearest {
        Some(nearest) => format!("did you mean '{nearest}'? 'withy learn list' shows all"),
        None => "'withy learn list' shows all".into(),
    }
}

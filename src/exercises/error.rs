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
        /// The name of an exercise that was asked for.
        name: String,
        /// The name of the exercise that was probably meant.
        nearest: Option<String>,
    },
    /// A file of the exercises could not be written.
    #[error(transparent)]
    Write(#[from] OutputError),
    /// A file of the exercises could not be read.
    #[error("cannot read '{}': {source}; check that you may read it", path.display())]
    Read {
        /// The file or folder that could not be read.
        path: PathBuf,
        /// The system's reason for not reading the file or folder.
        source: io::Error,
    },
    /// The file of the marks could not be written.
    #[error("cannot write the marks into '{}': {source}; --marks takes the name of a file that may be written", path.display())]
    Marks {
        /// The file of the marks.
        path: PathBuf,
        /// The system's reason for not writing the marks.
        source: io::Error,
    },
    /// The terminal cannot be drawn on.
    #[error(
        "cannot go on with this terminal: {0}; 'withy learn watch | cat' tells the same in lines"
    )]
    Terminal(io::Error),
    /// There is no folder for what attempts at exercises write.
    #[error("cannot make a folder for what attempts write: {0}; TMPDIR says where it goes")]
    Scratch(io::Error),
    /// The file of an attempt could not be renamed, to keep it.
    #[error("cannot keep '{}' as '{}': {source}; nothing was changed", from.display(), to.display())]
    Keep {
        /// The file that could not be renamed.
        from: PathBuf,
        /// The name that the file was to get.
        to: PathBuf,
        /// The system's reason for not renaming the file.
        source: io::Error,
    },
    /// The file of the progress does not hold what this program wrote.
    #[error("'{}' is damaged ({why}); move it away to begin counting anew: your attempts stay", path.display())]
    Progress {
        /// The file of the progress.
        path: PathBuf,
        /// What is wrong with the content of the file of the progress.
        why: serde_json::Error,
    },
    /// A folder in which there is nothing to grade.
    #[error("'{}' holds no submissions; it should have one folder for each student, with folders such as '{track}' in it", path.display())]
    NoSubmissions {
        /// The folder in which there is nothing to grade.
        path: PathBuf,
        /// The name of a track, whose folder it should have.
        track: &'static str,
    },
}

fn meant(nearest: Option<&str>) -> String {
    match nearest {
        Some(nearest) => format!("did you mean '{nearest}'? 'withy learn list' shows all"),
        None => "'withy learn list' shows all".into(),
    }
}

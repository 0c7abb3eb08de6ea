//! What can go wrong between a result and its file.

use std::{io, path::PathBuf};

/// A table or picture could not be written. Every message names the file, the reason and the next action.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The folder of the file is missing and could not be made.
    #[error("cannot make the folder '{}' for '{}': {source}; choose a folder you may write to", folder.display(), path.display())]
    Folder {
        /// The folder that could not be made.
        folder: PathBuf,
        /// The file that was to go into the folder.
        path: PathBuf,
        /// The system's reason for not making the folder.
        source: io::Error,
    },
    /// The file could not be written; an older file of that name is untouched.
    #[error("cannot write '{}': {source}; check that its folder may be written to and has room", path.display())]
    Write {
        /// The file that could not be written.
        path: PathBuf,
        /// The system's reason for not writing the file.
        source: io::Error,
    },
    /// The path has no file name, or a folder stands where the file should go.
    #[error("cannot write '{}': it is not the name of a file; give one such as 'results/energy.csv'", path.display())]
    NotAFile {
        /// The path that names no file.
        path: PathBuf,
    },
    /// The ending of a picture file names no known kind of picture.
    #[error("picture '{}': its ending is {ending}; use '.svg' (sharp at every size) or '.png' (pixels)", path.display())]
    PictureKind {
        /// The file whose ending names no picture.
        path: PathBuf,
        /// The ending of the file, in words.
        ending: String,
    },
    /// The columns of a table are not all equally long.
    #[error(
        "column '{name}' has {length} values but column '{first}' has {expected}; give every column one value per row"
    )]
    RaggedColumns {
        /// The name of the column that differs in length.
        name: String,
        /// The number of values of the column that differs.
        length: usize,
        /// The name of the first column, which sets the number of rows.
        first: String,
        /// The number of values of the first column.
        expected: usize,
    },
    /// A table of numbers could not be turned into text.
    #[error("cannot form the table: {0}; check its column names")]
    Csv(#[from] ::csv::Error),
    /// A picture is too small or too large to be painted.
    #[error(
        "a picture of {width} by {height} pixels cannot be painted; use 100 to 8000 pixels each way"
    )]
    PictureSize {
        /// The width asked for, of a picture that cannot be painted [pixels].
        width: f64,
        /// The height asked for, of a picture that cannot be painted [pixels].
        height: f64,
    },
    /// An animation has more pixels than it should.
    #[error(
        "{frames} frames of {width} by {height} pixels are too many for an animation; make fewer frames, or smaller ones"
    )]
    ManyPixels {
        /// How many frames.
        frames: usize,
        /// The width of each.
        width: u32,
        /// The height of each.
        height: u32,
    },
    /// The drawing library refused a picture.
    #[error("cannot paint the picture: {reason}; try the other kind ('.svg' or '.png')")]
    Paint {
        /// The drawing library's reason for refusing the picture.
        reason: String,
    },
}

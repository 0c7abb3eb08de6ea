//! Errors of writing tables and pictures.

use std::{io, path::PathBuf};

/// A table or picture could not be written. Every message names the file, the reason and the next action.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The folder of the file is missing and could not be created.
    #[error("cannot make the folder '{}' for '{}': {source}; choose a folder you may write to", folder.display(), path.display())]
    Folder {
        /// Folder that could not be created.
        folder: PathBuf,
        /// File to be written into the folder.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The file could not be written; an older file of that name is untouched.
    #[error("cannot write '{}': {source}; check that its folder may be written to and has room", path.display())]
    Write {
        /// The file that could not be written.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The path has no file name, or a folder stands where the file should go.
    #[error("cannot write '{}': it is not the name of a file; give one such as 'results/energy.csv'", path.display())]
    NotAFile {
        /// The path that names no file.
        path: PathBuf,
    },
    /// The extension of a picture file is not a known format.
    #[error("picture '{}': its ending is {ending}; use '.svg' (sharp at every size) or '.png' (pixels)", path.display())]
    PictureKind {
        /// File with the unknown extension.
        path: PathBuf,
        /// Extension of the file, as text.
        ending: String,
    },
    /// The columns of a table differ in length.
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
    /// A table could not be written as CSV.
    #[error("cannot form the table: {0}; check its column names")]
    Csv(#[from] ::csv::Error),
    /// Arrays could not be written into one archive.
    #[error("cannot form the archive of arrays: {0}; check that no two things have one name")]
    Archive(#[from] zip::result::ZipError),
    /// A table could not be written as Parquet.
    #[cfg(feature = "parquet")]
    #[error("cannot form the table: {reason}; check that no two columns have one name")]
    Parquet {
        /// Reason given by the Parquet library.
        reason: String,
    },
    /// A picture is too small or too large.
    #[error(
        "a picture of {width} by {height} pixels cannot be painted; use 100 to 8000 pixels each way"
    )]
    PictureSize {
        /// Requested width [pixels].
        width: f64,
        /// Requested height [pixels].
        height: f64,
    },
    /// An animation has too many pixels.
    #[error(
        "{frames} frames of {width} by {height} pixels are too many for an animation; make fewer frames, or smaller ones"
    )]
    ManyPixels {
        /// Number of frames.
        frames: usize,
        /// Width of a frame [pixels].
        width: u32,
        /// Height of a frame [pixels].
        height: u32,
    },
    /// The drawing library failed.
    #[error("cannot paint the picture: {reason}; try the other kind ('.svg' or '.png')")]
    Paint {
        /// Reason given by the drawing library.
        reason: String,
    },
}

//! Errors of writing tables and pictures.

use std::{io, path::PathBuf};

/// A table or picture could not be written. Every message names the file, the reason and the next action.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The folder of the file is missing and could not be created.
    #[error("cannot create the folder '{}' for '{}': {source}; choose a writable folder", folder.display(), path.display())]
    Folder {
        /// Folder that could not be created.
        folder: PathBuf,
        /// File to be written into the folder.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The file could not be written; an older file of that name is untouched.
    #[error("cannot write '{}': {source}; check that the folder is writable and the disk has space", path.display())]
    Write {
        /// The file that could not be written.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The path has no file name, or a folder stands where the file should go.
    #[error("cannot write '{}': this is not a file name; give one such as 'results/energy.csv'", path.display())]
    NotAFile {
        /// The path that names no file.
        path: PathBuf,
    },
    /// The extension of a picture file is not a known format.
    #[error("picture '{}': the file extension is {ending}; use '.svg' (vector graphics) or '.png' (pixels)", path.display())]
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
    #[error("cannot create the table: {0}; check its column names")]
    Csv(#[from] ::csv::Error),
    /// Arrays could not be written into one archive.
    #[error("cannot create the archive of arrays: {0}; check that all names are different")]
    Archive(#[from] zip::result::ZipError),
    /// A table could not be written as Parquet.
    #[cfg(feature = "parquet")]
    #[error("cannot create the table: {reason}; check that all column names are different")]
    Parquet {
        /// Reason given by the Parquet library.
        reason: String,
    },
    /// A picture is too small or too large.
    #[error("a picture cannot have {width} by {height} pixels; use 100 to 8000 in each direction")]
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
    TooManyPixels {
        /// Number of frames.
        frames: usize,
        /// Width of a frame [pixels].
        width: u32,
        /// Height of a frame [pixels].
        height: u32,
    },
    /// The drawing library failed.
    #[error("cannot draw the picture: {reason}; try the other format ('.svg' or '.png')")]
    Paint {
        /// Reason given by the drawing library.
        reason: String,
    },
}

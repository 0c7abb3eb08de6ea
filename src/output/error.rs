//! Errors in writing tables and pictures.

use std::{io, path::PathBuf};

#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    #[error("cannot create the folder '{}' for '{}': {source}; choose a writable folder", folder.display(), path.display())]
    Folder { folder: PathBuf, path: PathBuf, source: io::Error },
    #[error("cannot write '{}': {source}; check that the folder is writable and the disk has space", path.display())]
    Write { path: PathBuf, source: io::Error },
    #[error("cannot write '{}': this is not a file name; give one such as 'results/energy.csv'", path.display())]
    NotAFile { path: PathBuf },
    #[error("picture '{}': the file extension is {ending}; use '.svg' (vector graphics) or '.png' (pixels)", path.display())]
    PictureKind { path: PathBuf, ending: String },
    #[error(
        "column '{name}' has {length} values but column '{first}' has {expected}; give every column one value per row"
    )]
    RaggedColumns { name: String, length: usize, first: String, expected: usize },
    #[error("cannot create the table: {0}; check its column names")]
    Csv(#[from] ::csv::Error),
    #[error("cannot create the archive of arrays: {0}; check that all names are different")]
    Archive(#[from] zip::result::ZipError),
    #[cfg(feature = "parquet")]
    #[error("cannot create the table: {reason}; check that all column names are different")]
    Parquet { reason: String },
    #[error("a picture cannot have {width} by {height} pixels; use 100 to 8000 in each direction")]
    PictureSize {
        /// Requested width [pixels].
        width: f64,
        /// Requested height [pixels].
        height: f64,
    },
    #[error(
        "{frames} frames of {width} by {height} pixels are too many for an animation; make fewer frames, or smaller ones"
    )]
    TooManyPixels { frames: usize, width: u32, height: u32 },
    #[error("cannot draw the picture: {reason}; try the other format ('.svg' or '.png')")]
    Paint { reason: String },
}

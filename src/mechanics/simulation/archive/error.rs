//! Errors of stored simulations.

use crate::simulation::SimulationError;

/// Error for a simulation that cannot be stored, or for bytes that are not a valid file.
#[expect(missing_docs, reason = "the messages describe the variants and their fields")]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ArchiveError {
    #[error("{load} uses {function}, and functions of a script cannot be stored in a restart file")]
    Function { load: String, function: String },
    #[error(
        "the column '{column}' is computed by a function, and functions cannot be stored in a restart file"
    )]
    Sensor { column: String },
    #[error("'{name}' is released by a function, and functions cannot be stored in a restart file")]
    Release { name: String },
    #[error("this is not a restart file: it does not begin with the header of one")]
    Foreign,
    #[error("the file is truncated: it has {found} of {needed} bytes; use another copy")]
    Truncated {
        /// Actual length of the file [bytes].
        found: usize,
        /// Length of the file according to its header [bytes], as far as the header could be read.
        needed: u64,
    },
    #[error(
        "it was written by withy {program} in format {format}, but this is withy {this_program}, which reads format {supported}; install a newer withy"
    )]
    Newer { program: String, format: u16, this_program: &'static str, supported: u16 },
    #[error(
        "it was written by withy {program} in format {format}, but this withy reads only format {supported}; load it with withy {program}"
    )]
    Older { program: String, format: u16, supported: u16 },
    #[error(
        "the file is damaged: its checksum is {found:08x}, but should be {right:08x}; use another copy"
    )]
    Damaged { found: u32, right: u32 },
    #[error("the file is damaged: {trailing_bytes} bytes follow its end; use another copy")]
    TrailingBytes { trailing_bytes: u64 },
    #[error("its content is not a valid simulation: {reason}")]
    Content { reason: String },
    #[error("its scene cannot be built: {0}")]
    Scene(#[from] SimulationError),
}
